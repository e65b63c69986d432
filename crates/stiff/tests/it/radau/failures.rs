//! Runs that fail say why and keep the last good state.

use core::convert::Infallible;

use piola_integrators::{Field, IntegratorsError, State, Tolerance, field};
use piola_stiff::{DifferenceJacobian, ExactJacobian, GivenJacobian, RadauIia, RadauOrder, StiffField, WithMass};
use piola_testkit::{Tol, assert_close, assert_each_close};

use super::problems::Robertson;

fn method(tolerance: f64) -> RadauIia {
    RadauIia::new(Tolerance::relative(tolerance).unwrap())
}

#[test]
fn singular_matrix_is_refused_by_its_pivot() {
    // 0 = f(y₁) does not determine y₂.
    let undetermined = field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[-y[0], y[0] - 1.0]));
    let mut system = WithMass::new(DifferenceJacobian::new(undetermined), vec![1.0, 0.0, 0.0, 0.0]).unwrap();
    let mut state = State::new(0.0, vec![1.0, 1.0]).unwrap();
    let error = method(1e-6).integrate_to(&mut system, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::SingularMatrix { pivot: 1, .. }), "{error:?}");
    assert_eq!((state.time, &state.values[..]), (0.0, &[1.0, 1.0][..]));
    let error =
        RadauIia::with_step(RadauOrder::Five, 0.1).unwrap().integrate_to(&mut system, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::SingularMatrix { pivot: 1, .. }), "{error:?}");
}

#[test]
fn rate_that_is_not_finite_at_the_start_is_refused_by_name() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut system = DifferenceJacobian::new(field(2, move |_t, _y: &[f64], rate: &mut [f64]| {
            rate.copy_from_slice(&[1.0, bad]);
        }));
        let mut state = State::new(0.0, vec![1.0, 1.0]).unwrap();
        let error = method(1e-6).integrate_to(&mut system, &mut state, 1.0).unwrap_err();
        assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 1, .. }), "{error:?}");
    }
}

#[test]
fn jacobian_that_is_not_finite_is_refused_by_name() {
    let decay = field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[-y[0], -y[1]]));
    let mut system = GivenJacobian::new(decay, |_t, _y: &[f64], jacobian: &mut [f64]| jacobian[3] = f64::NAN);
    let mut state = State::new(0.0, vec![1.0, 1.0]).unwrap();
    let error = method(1e-6).integrate_to(&mut system, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "jacobian", index: 3, .. }), "{error:?}");
}

#[test]
fn state_that_does_not_fit_or_is_not_finite_is_refused_by_name() {
    let mut system = DifferenceJacobian::new(field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(y)));
    let error = method(1e-6).integrate_to(&mut system, &mut State::new(0.0, vec![1.0]).unwrap(), 1.0).unwrap_err();
    assert_eq!(error, IntegratorsError::WrongLength { quantity: "state", expected: 2, found: 1 });
    let mut state = State::new(0.0, vec![1.0, 1.0]).unwrap();
    state.values[1] = f64::NAN;
    let error = method(1e-6).integrate_to(&mut system, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "state", index: 1, .. }), "{error:?}");
    state.values[1] = 1.0;
    let error = method(1e-6).integrate_to(&mut system, &mut state, f64::INFINITY).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "end", .. }), "{error:?}");
}

#[test]
fn explosion_stops_before_its_time() {
    // ẏ = y² from 1 is infinite at t = 1.
    let mut explosion = DifferenceJacobian::new(field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = y[0] * y[0]));
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let error = method(1e-8).integrate_to(&mut explosion, &mut state, 2.0).unwrap_err();
    let known = matches!(
        error,
        IntegratorsError::StepTooSmall { .. }
            | IntegratorsError::StagesDiverged { .. }
            | IntegratorsError::NotFinite { .. }
    );
    assert!(known, "{error:?}");
    assert!((state.time - 1.0).abs() < 1e-7 && 1e7 < state.values[0], "{state:?}");
}

/// A field that refuses positions beyond one.
struct Walled;
#[derive(Debug, PartialEq)]
struct Wall;
impl Field for Walled {
    type Error = Wall;
    fn dimension(&self) -> usize {
        1
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Wall> {
        rate[0] = 1.0;
        if y[0] <= 1.0 { Ok(()) } else { Err(Wall) }
    }
}
impl StiffField for Walled {
    fn jacobian(&mut self, _t: f64, _y: &[f64], jacobian: &mut [f64]) -> Result<(), Wall> {
        jacobian[0] = 0.0;
        Ok(())
    }
}

#[test]
fn refusal_of_the_field_is_returned_with_the_state_before_it() {
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    let error = method(1e-6).integrate_to(&mut Walled, &mut state, 3.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::Field { source: Wall, .. }), "{error:?}");
    assert!(state.values[0] <= 1.0 && 0.999_999 < state.values[0], "{state:?}");
}

#[test]
fn limit_on_steps_is_kept() {
    let mut decay = DifferenceJacobian::new(field(1, |t: f64, y: &[f64], rate: &mut [f64]| rate[0] = t.sin() - y[0]));
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let error = method(1e-8).with_most_steps(5).integrate_to(&mut decay, &mut state, 1e3).unwrap_err();
    assert!(matches!(error, IntegratorsError::TooManySteps { steps: 5, .. }), "{error:?}");
    assert!(0.0 < state.time && state.time < 1e3);
}

#[test]
fn fixed_step_beyond_convergence_says_so() {
    // ẏ = y³ from 10: at this step the stages have no solution.
    let mut explosion = DifferenceJacobian::new(field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = y[0].powi(3)));
    let mut state = State::new(0.0, vec![10.0]).unwrap();
    let error =
        RadauIia::with_step(RadauOrder::Five, 1.0).unwrap().integrate_to(&mut explosion, &mut state, 1.0).unwrap_err();
    let known = matches!(error, IntegratorsError::StagesDiverged { .. } | IntegratorsError::NotFinite { .. });
    assert!(known, "{error:?}");
    assert_eq!((state.time, state.values[0]), (0.0, 10.0));
}

#[test]
fn steps_that_are_not_positive_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(RadauIia::with_step(RadauOrder::Five, bad), Err(IntegratorsError::InvalidStep { .. })));
        assert!(matches!(method(1e-6).with_first_step(bad), Err(IntegratorsError::InvalidStep { .. })));
    }
    assert!(matches!(method(1e-6).with_longest_step(0.0), Err(IntegratorsError::InvalidStep { .. })));
    assert!(method(1e-6).with_longest_step(f64::INFINITY).is_ok());
}

/// A pendulum of length 1 in Cartesian coordinates (x, y, u, v, λ) with the constraint on positions: index 3.
#[test]
fn constraint_of_index_three_stops_with_the_state_on_the_motion() {
    let pendulum = field(5, |_t, y: &[f64], rate: &mut [f64]| {
        rate.copy_from_slice(&[y[2], y[3], -y[4] * y[0], -y[4] * y[1] - 1.0, y[0] * y[0] + y[1] * y[1] - 1.0]);
    });
    let mass = (0..4).map(|k| (k, k, 1.0)).collect();
    let mut system = WithMass::from_entries(DifferenceJacobian::new(pendulum), mass).unwrap();
    let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
    let error =
        RadauIia::new(Tolerance::new(1e-8, 1e-8).unwrap()).integrate_to(&mut system, &mut state, 5.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::IndexTooHigh { component: 4, index: 3, .. }), "{error:?}");
    // Before it stopped the mass fell: y = −t²/2, v = −t.
    let t = state.time;
    let expected = [1.0, -0.5 * t * t, 0.0, -t];
    assert!(0.0 < t && t < 0.1);
    assert_close("fall", &state.values[..4], &expected, Tol::stated(1e-8, "tolerance 1e-8"));
}

/// J has the wrong sign: Newton's iteration leads away, unless the step is so short that J does not matter.
#[test]
fn iteration_that_a_wrong_jacobian_leads_astray_says_so() {
    let decay = field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = -1e6 * y[0]);
    let mut system = GivenJacobian::new(decay, |_t, _y: &[f64], jacobian: &mut [f64]| jacobian[0] = 1e6);
    let start = State::new(0.0, vec![1.0]).unwrap();
    let mut state = start.clone();
    let error =
        RadauIia::with_step(RadauOrder::Nine, 1.0).unwrap().integrate_to(&mut system, &mut state, 1.0).unwrap_err();
    let known = matches!(error, IntegratorsError::StagesDiverged { .. } | IntegratorsError::NotFinite { .. });
    assert!(known, "{error:?}");
    assert_eq!(state, start);
    let mut adaptive = method(1e-8).with_most_steps(100);
    let error = adaptive.integrate_to(&mut system, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::TooManySteps { steps: 100, .. }), "{error:?}");
    let exact = (-1e6 * state.time).exp();
    assert_close("decay", &state.values, &[exact], Tol::stated(1e-6, "tolerance 1e-8 over a hundred steps"));
}

/// A field whose mass matrix has the wrong length.
struct Misfit(Vec<f64>);
impl Field for Misfit {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        rate.copy_from_slice(y);
        Ok(())
    }
}
impl StiffField for Misfit {
    fn jacobian(&mut self, _t: f64, _y: &[f64], jacobian: &mut [f64]) -> Result<(), Self::Error> {
        jacobian.copy_from_slice(&[1.0, 0.0, 0.0, 1.0]);
        Ok(())
    }
    fn mass(&self) -> Option<&[f64]> {
        Some(&self.0)
    }
}

#[test]
fn mass_matrix_of_a_field_that_does_not_fit_is_refused_by_name() {
    let start = State::new(0.0, vec![1.0, 1.0]).unwrap();
    let mut state = start.clone();
    let error = method(1e-6).integrate_to(&mut Misfit(vec![1.0; 3]), &mut state, 1.0).unwrap_err();
    assert_eq!(error, IntegratorsError::WrongLength { quantity: "mass", expected: 4, found: 3 });
    let infinite = vec![1.0, 0.0, f64::INFINITY, 1.0];
    let error = method(1e-6).integrate_to(&mut Misfit(infinite), &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "mass", index: 2, .. }), "{error:?}");
    assert_eq!(state, start);
}

/// The first of the equal steps ends a fast decay: its polynomial continued is no start for the second.
#[test]
fn equal_steps_go_on_after_a_fast_decay() {
    let mut robertson = ExactJacobian::new(Robertson);
    let start = State::new(0.0, vec![1.0, 3.65e-5, 1e-3]).unwrap();
    let mut exact = start.clone();
    RadauIia::new(Tolerance::new(1e-12, 1e-20).unwrap()).integrate_to(&mut robertson, &mut exact, 1.0).unwrap();
    for order in RadauOrder::ALL {
        let mut state = start.clone();
        RadauIia::with_step(order, 0.05).unwrap().integrate_to(&mut robertson, &mut state, 1.0).unwrap();
        // Within the first step alone is the motion faster than the steps.
        assert_each_close("end", &state.values, &exact.values, Tol::stated(1e-6, "steps of 0.05"));
    }
}

/// A component that says itself that its index is three is refused before anything is computed.
#[test]
fn declared_index_three_is_refused_by_name() {
    struct Declared;
    impl Field for Declared {
        type Error = Infallible;
        fn dimension(&self) -> usize {
            2
        }
        fn rate(&mut self, _t: f64, _y: &[f64], _rate: &mut [f64]) -> Result<(), Infallible> {
            unreachable!("nothing is computed")
        }
    }
    impl StiffField for Declared {
        fn jacobian(&mut self, _t: f64, _y: &[f64], _jacobian: &mut [f64]) -> Result<(), Infallible> {
            unreachable!("nothing is computed")
        }
        fn index(&self, component: usize) -> u32 {
            if component == 1 { 3 } else { 1 }
        }
    }
    let mut state = State::new(0.5, vec![1.0, 2.0]).unwrap();
    let error = method(1e-6).integrate_to(&mut Declared, &mut state, 1.0).unwrap_err();
    assert_eq!(error, IntegratorsError::IndexTooHigh { component: 1, index: 3, t: 0.5 });
}

/// Tolerances below rounding are those at rounding, to the last bit.
#[test]
fn tolerances_below_rounding_are_raised() {
    let run = |tolerance: f64| {
        let mut decay = DifferenceJacobian::new(field(1, |t: f64, y: &[f64], rate: &mut [f64]| {
            rate[0] = -1000.0 * (y[0] - t.cos());
        }));
        let mut state = State::new(0.0, vec![1.0]).unwrap();
        let report = method(tolerance).integrate_to(&mut decay, &mut state, 1.0).unwrap();
        (report, state)
    };
    assert_eq!(run(1e-20), run(1e-14));
}
