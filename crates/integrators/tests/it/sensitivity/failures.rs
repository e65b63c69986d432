//! Runs of no length, arguments that are refused, and runs that fail.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    AdjointSensitivity, DormandPrincePair, ForwardSensitivity, IntegratorsError, ObjectiveGradient, ParametricField,
    Sensitivities, SensitivityInputs, State, VernerPair,
};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_each_close};

use super::{Linear, LotkaVolterra, Mixed, Oscillator, method};

const BOTH: SensitivityInputs = SensitivityInputs::StartAndParameters;

#[derive(Debug, PartialEq)]
struct Beyond(f64);

/// ẏ = p y, which is not defined after some time; over numbers with derivatives after another.
struct Bounded {
    end: f64,
    differentiable_until: f64,
}
impl ParametricField for Bounded {
    type Error = Beyond;
    fn dimension(&self) -> usize {
        1
    }
    fn parameters(&self) -> usize {
        1
    }
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Beyond> {
        let end = if T::ORDER == 0 { self.end } else { self.differentiable_until };
        if end < t {
            return Err(Beyond(t));
        }
        rate[0] = p[0] * y[0];
        Ok(())
    }
}

/// ẋ = p √s, ṡ = 0: not differentiable at s = 0.
struct Root;
impl ParametricField for Root {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn parameters(&self) -> usize {
        1
    }
    fn rate<T: Real>(&self, _t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        rate[0] = p[0] * y[1].sqrt();
        rate[1] = T::zero();
        Ok(())
    }
}

#[test]
fn a_run_of_no_length_has_the_derivatives_of_the_start() {
    let mut state = State::new(3.0, vec![0.5, 2.0]).unwrap();
    let mut sensitivities = Sensitivities::at_start(2, 1, BOTH);
    let fresh = sensitivities.clone();
    let report = ForwardSensitivity::new(method::<VernerPair, f64>(1e-9))
        .integrate_to(&Oscillator, &[1.0], &mut state, &mut sensitivities, 3.0)
        .unwrap();
    assert_eq!((report.steps, sensitivities), (0, fresh));

    let mut method = AdjointSensitivity::new(method::<VernerPair, f64>(1e-9), 4);
    method.integrate_to(&Oscillator, &[1.5], &mut state, 3.0).unwrap();
    let mut gradient = ObjectiveGradient::default();
    method.gradient(&Oscillator, &Mixed, &mut gradient).unwrap();
    // J = x² + p v.
    let (by_start, by_parameters) = (vec![1.0, 1.5], vec![2.0]);
    assert_eq!(gradient, ObjectiveGradient { value: 3.25, by_start, by_parameters, replayed_steps: 0 });
}

#[test]
fn arguments_that_do_not_fit_or_are_not_finite_are_refused_by_name() {
    let start = State::new(0.0, vec![1.0, 0.5]).unwrap();
    let p = [1.5, 1.0, 3.0, 1.25];
    let run = |p: &[f64], sensitivities: (usize, usize)| {
        let mut state = start.clone();
        let mut sensitivities = Sensitivities::at_start(sensitivities.0, sensitivities.1, BOTH);
        let fresh = sensitivities.clone();
        let forwards = ForwardSensitivity::new(method::<DormandPrincePair, f64>(1e-9))
            .integrate_to(&LotkaVolterra, p, &mut state, &mut sensitivities, 1.0)
            .unwrap_err();
        assert_eq!((&state, sensitivities), (&start, fresh));
        forwards
    };
    let too_long = |quantity, expected, found| IntegratorsError::WrongLength { quantity, expected, found };
    assert_eq!(run(&p[..3], (2, 4)), too_long("parameters", 4, 3));
    assert_eq!(run(&p, (3, 4)), too_long("sensitivities", 2, 3));
    assert_eq!(run(&p, (2, 5)), too_long("sensitivities by parameters", 4, 5));
    let infinite = run(&[1.5, 1.0, f64::INFINITY, 1.25], (2, 4));
    let value = f64::INFINITY;
    assert_eq!(infinite, IntegratorsError::NotFinite { quantity: "parameters", index: 2, value, t: None });
    assert_eq!(infinite.to_string(), "entry 2 of `parameters` is inf, which is not a finite number");

    // A run that is refused leaves the record of the one before.
    let mut method = AdjointSensitivity::new(method::<DormandPrincePair, f64>(1e-9), 4);
    let mut gradient = ObjectiveGradient::default();
    let unrecorded = method.gradient(&LotkaVolterra, &Mixed, &mut gradient);
    assert_eq!(unrecorded, Err(too_long("record", 2, 0)));
    let mut state = start.clone();
    method.integrate_to(&LotkaVolterra, &p, &mut state, 1.0).unwrap();
    method.gradient(&LotkaVolterra, &Mixed, &mut gradient).unwrap();
    let before = gradient.clone();
    let reached = state.clone();
    let refused = method.integrate_to(&LotkaVolterra, &[f64::NAN; 4], &mut state, 2.0).unwrap_err();
    assert!(matches!(refused, IntegratorsError::NotFinite { quantity: "parameters", index: 0, t: None, .. }));
    assert_eq!(state, reached);
    assert_eq!(method.gradient(&Oscillator, &Mixed, &mut gradient), Err(too_long("parameters", 1, 4)));
    method.gradient(&LotkaVolterra, &Mixed, &mut gradient).unwrap();
    assert_eq!(ObjectiveGradient { replayed_steps: before.replayed_steps, ..gradient }, before);
}

#[test]
fn a_run_that_fails_keeps_state_derivatives_and_record() {
    let field = Bounded { end: 1.0, differentiable_until: 10.0 };
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let mut sensitivities = Sensitivities::at_start(1, 1, BOTH);
    let error = ForwardSensitivity::new(method::<DormandPrincePair, f64>(1e-12))
        .integrate_to(&field, &[2.0], &mut state, &mut sensitivities, 3.0)
        .unwrap_err();
    assert!(matches!(error, IntegratorsError::Field { source: Beyond(t), .. } if 1.0 < t), "{error:?}");
    assert!((0.9..=1.0).contains(&state.time));
    let (t, growth) = (state.time, (2.0 * state.time).exp());
    let tol = Tol::stated(1e-11, "truncation at the tolerance 1e-12");
    assert_each_close("∂y/∂y₀", sensitivities.by_start(), &[growth], tol);
    assert_each_close("∂y/∂p", sensitivities.by_parameters(), &[t * growth], tol);

    let mut method = AdjointSensitivity::new(method::<DormandPrincePair, f64>(1e-12), 3);
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    assert_eq!(method.integrate_to(&field, &[2.0], &mut state, 3.0).unwrap_err(), error);
    let mut gradient = ObjectiveGradient::default();
    method.gradient(&field, &Linear(vec![1.0]), &mut gradient).unwrap();
    assert_each_close("gradient", &[gradient.by_start[0], gradient.by_parameters[0]], &[growth, t * growth], tol);
}

#[test]
fn state_goes_back_to_the_last_step_with_derivatives() {
    let field = Bounded { end: 10.0, differentiable_until: 1.0 };
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let mut sensitivities = Sensitivities::at_start(1, 1, BOTH);
    let mut with = ForwardSensitivity::new(method::<VernerPair, f64>(1e-13));
    let mut steps = 0;
    let run = with.integrate(&field, &[2.0], &mut state, &mut sensitivities, 3.0, |step, _| {
        steps = step.number;
        ControlFlow::Continue(())
    });
    assert!(matches!(run, Err(IntegratorsError::Field { source: Beyond(_), .. })));
    assert!(2 < steps);
    // The same as a run that stops there, and with the same compensation of its sums.
    let mut stopped = State::new(0.0, vec![1.0]).unwrap();
    let mut derivatives = Sensitivities::at_start(1, 1, BOTH);
    with.integrate(&field, &[2.0], &mut stopped, &mut derivatives, 3.0, |step, _| {
        if step.number < steps { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    })
    .unwrap();
    assert_eq!((state, sensitivities), (stopped, derivatives));
}

#[test]
fn derivatives_that_do_not_exist_are_refused_by_name() {
    let start = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut state = start.clone();
    let mut sensitivities = Sensitivities::at_start(2, 1, BOTH);
    let fresh = sensitivities.clone();
    let error = ForwardSensitivity::new(method::<VernerPair, f64>(1e-9))
        .integrate_to(&Root, &[1.0], &mut state, &mut sensitivities, 1.0)
        .unwrap_err();
    let name = "sensitivities by start";
    assert!(matches!(error, IntegratorsError::NotFinite { quantity, t: Some(_), .. } if quantity == name), "{error:?}");
    assert_eq!((&state, sensitivities), (&start, fresh));

    let mut method = AdjointSensitivity::new(method::<VernerPair, f64>(1e-9), 3);
    method.integrate_to(&Root, &[1.0], &mut state, 1.0).unwrap();
    let mut gradient = ObjectiveGradient { value: 7.0, ..ObjectiveGradient::default() };
    let before = gradient.clone();
    let error = method.gradient(&Root, &Linear(vec![1.0, 0.0]), &mut gradient).unwrap_err();
    let name = "gradient by start";
    assert!(matches!(error, IntegratorsError::NotFinite { quantity, t: Some(_), .. } if quantity == name), "{error:?}");
    assert_eq!(gradient, before);
    let infinite = method.gradient(&Root, &Linear(vec![f64::INFINITY, 0.0]), &mut gradient).unwrap_err();
    assert!(matches!(infinite, IntegratorsError::NotFinite { quantity: "objective", t: None, .. }), "{infinite:?}");
}
