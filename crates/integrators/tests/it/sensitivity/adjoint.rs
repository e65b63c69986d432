//! Gradients backwards in time: against derivatives forwards, closed forms, and of second order.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    AdjointSensitivity, DormandPrince853, DormandPrincePair, Ending, JacobianProduct, ObjectiveGradient,
    ParametricField, RungeKuttaPair, State, Tolerance, VernerPair,
};
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, allocations_in, assert_each_close, assert_each_close_at_scales};

use super::{
    Counted, Driven, DrivenWithProduct, Kepler, Linear, LotkaVolterra, Mixed, Oscillator, adjoint, coefficients,
    covector_times, forward, method, oscillation, sizes_of_terms,
};

/// The gradient of cᵀy(t₁) both ways.
fn compare<P: RungeKuttaPair>(
    field: &impl ParametricField<Error = Infallible>,
    start: &[f64],
    p: &[f64],
    end: f64,
    scale: impl Fn(Vec<f64>) -> Vec<f64>,
) {
    let c: Vec<f64> = (0..start.len()).map(|i| 1.0 - 0.75 * i as f64).collect();
    let (_, forwards) = forward(method::<P, f64>(1e-11), field, start, p, end);
    let backwards = adjoint(method::<P, f64>(1e-11), 3, field, &Linear(c.clone()), (start, p), end);
    for (actual, matrix) in
        [(&backwards.by_start, forwards.by_start()), (&backwards.by_parameters, forwards.by_parameters())]
    {
        let sizes = scale(sizes_of_terms(&c, matrix));
        assert_each_close_at_scales("gradient", actual, &covector_times(&c, matrix), &sizes, Tol::ulps(64.0));
    }
}

#[test]
fn adjoint_gradient_equals_forward_derivatives_to_rounding() {
    let own = |sizes| sizes;
    compare::<DormandPrincePair>(&Oscillator, &[0.25, -1.5], &[1.75], 6.0, own);
    compare::<VernerPair>(&Oscillator, &[0.25, -1.5], &[1.75], 6.0, own);
    compare::<DormandPrincePair>(&Kepler, &[0.75, 0.25, -0.5, 1.125], &[1.0625], 12.0, own);
    compare::<VernerPair>(&Kepler, &[0.75, 0.25, -0.5, 1.125], &[1.0625], 12.0, own);
    compare::<DormandPrincePair>(&LotkaVolterra, &[1.0, 0.5], &[1.5, 1.0, 3.0, 1.25], 5.0, own);
    compare::<VernerPair>(&LotkaVolterra, &[1.0, 0.5], &[1.5, 1.0, 3.0, 1.25], -2.0, own);
}

#[test]
fn gradient_by_two_hundred_parameters_equals_forward_derivatives_from_rest() {
    let p = coefficients(199);
    let field = Driven { coefficients: 199 };
    // Derivatives by the later coefficients are integrals of fast oscillations, whose terms are of the size of the first ones.
    let largest = |sizes: Vec<f64>| vec![sizes.iter().copied().fold(0.0, f64::max); sizes.len()];
    compare::<DormandPrincePair>(&field, &[0.0, 0.0], &p, 3.0, largest);
    compare::<VernerPair>(&DrivenWithProduct(field), &[0.0, 0.0], &p, 3.0, largest);
}

#[test]
fn a_product_in_closed_form_saves_all_evaluations_with_derivatives() {
    let p = coefficients(19);
    let count = |field: &Counted<_>| {
        adjoint(method::<DormandPrincePair, f64>(1e-9), 100, field, &Linear(vec![1.0, 0.0]), (&[0.0, 0.0], &p), 5.0)
    };
    let default = Counted::new(Driven { coefficients: 19 });
    let gradient = count(&default);
    // 22 directions, four at once, twelve stages.
    assert_eq!(default.differentiated.get() % (6 * 12), 0);
    assert!(0 < default.differentiated.get());
    let driven = DrivenWithProduct(Driven { coefficients: 19 });
    let own = adjoint(
        method::<DormandPrincePair, f64>(1e-9),
        100,
        &Differentiated(&driven),
        &Linear(vec![1.0, 0.0]),
        (&[0.0, 0.0], &p),
        5.0,
    );
    assert_each_close("by parameters", &own.by_parameters, &gradient.by_parameters, Tol::ulps(64.0));
}

/// Refuses numbers with derivatives.
struct Differentiated<'a>(&'a DrivenWithProduct);
impl ParametricField for Differentiated<'_> {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn parameters(&self) -> usize {
        self.0.parameters()
    }
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        assert_eq!(T::ORDER, 0);
        self.0.rate(t, y, p, rate)
    }
    fn vector_jacobian_product<T: Real>(
        &self,
        t: f64,
        y: &[T],
        p: &[T],
        product: &mut JacobianProduct<T>,
    ) -> Result<(), Infallible> {
        self.0.vector_jacobian_product(t, y, p, product)
    }
}

/// A field with the integrand of [`Mixed`] as its last component.
struct WithIntegral<F>(F);
impl<F: ParametricField> ParametricField for WithIntegral<F> {
    type Error = F::Error;
    fn dimension(&self) -> usize {
        self.0.dimension() + 1
    }
    fn parameters(&self) -> usize {
        self.0.parameters()
    }
    fn rate<T: Real>(&self, t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), F::Error> {
        let n = self.0.dimension();
        rate[n] = piola_integrators::Objective::running(&Mixed, t, &y[..n], p);
        self.0.rate(t, &y[..n], p, &mut rate[..n])
    }
}

#[test]
fn integral_of_an_objective_equals_an_additional_component() {
    fn check<P: RungeKuttaPair>(field: impl ParametricField<Error = Infallible>, start: [f64; 2], p: &[f64], end: f64) {
        let run = |step: f64| super::fixed::<P, f64>(step);
        let gradient = adjoint(run(0.25), 2, &field, &Mixed, (&start, p), end);
        let (state, derivatives) = forward(run(0.25), &WithIntegral(field), &[start[0], start[1], 0.0], p, end);
        let y = &state.values;
        let value = y[0] * y[0] + p[0] * y[1] + y[2];
        let c = [2.0 * y[0], p[0], 1.0];
        assert_each_close("value", &[gradient.value], &[value], Tol::ulps(16.0));
        let by_start = covector_times(&c, derivatives.by_start());
        let mut by_parameters = covector_times(&c, derivatives.by_parameters());
        by_parameters[0] += y[1];
        let sizes = sizes_of_terms(&c, derivatives.by_start());
        assert_each_close_at_scales("by start", &gradient.by_start, &by_start[..2], &sizes[..2], Tol::ulps(64.0));
        let sizes = sizes_of_terms(&c, derivatives.by_parameters());
        assert_each_close_at_scales("by parameters", &gradient.by_parameters, &by_parameters, &sizes, Tol::ulps(64.0));
    }
    check::<DormandPrincePair>(Oscillator, [0.25, -1.5], &[1.75], 6.0);
    check::<VernerPair>(LotkaVolterra, [1.0, 0.5], &[1.5, 1.0, 3.0, 1.25], 2.0);
    check::<VernerPair>(Driven { coefficients: 5 }, [0.0, 0.0], &coefficients(5), -3.0);
}

#[test]
fn dual_numbers_carry_a_column_of_the_hessian() {
    // J = x = cos pt from rest: ∂²J/∂p² = −t² cos pt, ∂²J/∂x₀∂p = −t sin pt, ∂²J/∂v₀∂p = t cos(pt)/p − sin(pt)/p².
    let (p, t) = (1.75_f64, 3.0_f64);
    let mut state = State::new(0.0, vec![Dual::lit(1.0), Dual::lit(0.0)]).unwrap();
    let mut method = AdjointSensitivity::new(method::<VernerPair, Dual<f64>>(1e-14), 2);
    method.integrate_to(&Oscillator, &[Dual::variable(p)], &mut state, t).unwrap();
    let mut gradient = ObjectiveGradient::default();
    method.gradient(&Oscillator, &Linear(vec![1.0, 0.0]), &mut gradient).unwrap();
    let (sine, cosine) = (p * t).sin_cos();
    let hessian = [gradient.by_parameters[0], gradient.by_start[0], gradient.by_start[1]].map(|x| x.tangent);
    let expected = [-t * t * cosine, -t * sine, t * cosine / p - sine / (p * p)];
    let tol = Tol::ulps_because(256.0, "truncation at the tolerance 1e-14");
    assert_each_close("Hessian", &hessian, &expected, tol);
    let (end, _, by_parameter) = oscillation([1.0, 0.0], p, t);
    assert_each_close("J", &[gradient.value.value, gradient.value.tangent], &[end[0], by_parameter[0]], tol);
}

#[test]
fn a_run_that_an_observer_stops_is_differentiated_where_it_stopped() {
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut method = AdjointSensitivity::new(DormandPrince853::new(Tolerance::relative(1e-13).unwrap()), 3);
    let report = method
        .integrate(&Oscillator, &[1.0], &mut state, 100.0, |step| {
            if step.time < 4.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })
        .unwrap();
    assert_eq!((report.ending, report.steps), (Ending::Stopped, method.steps() as u64));
    assert!((4.0..6.0).contains(&state.time));
    let mut gradient = ObjectiveGradient::default();
    method.gradient(&Oscillator, &Linear(vec![1.0, 0.0]), &mut gradient).unwrap();
    let (_, by_start, by_parameter) = oscillation([1.0, 0.0], 1.0, state.time);
    let tol = Tol::stated(1e-11, "truncation at the tolerance 1e-13");
    assert_each_close("by start", &gradient.by_start, &by_start[..2], tol);
    assert_each_close("by parameter", &gradient.by_parameters, &by_parameter[..1], tol);
}

#[test]
fn repeated_gradients_are_bit_identical_and_allocate_nothing() {
    let field = Driven { coefficients: 9 };
    let p = coefficients(9);
    let mut method = AdjointSensitivity::new(DormandPrince853::new(Tolerance::relative(1e-10).unwrap()), 5);
    let mut gradient = ObjectiveGradient::default();
    let mut round = |gradient: &mut ObjectiveGradient, state: &mut State| {
        method.integrate_to(&field, &p, state, 20.0).unwrap();
        method.gradient(&field, &Mixed, gradient).unwrap();
    };
    let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
    round(&mut gradient, &mut state);
    let (mut again, mut state) = (gradient.clone(), State::new(0.0, vec![0.0, 0.0]).unwrap());
    again.by_start.fill(f64::NAN);
    let (count, ()) = allocations_in(|| round(&mut again, &mut state));
    assert_eq!(count, 0);
    assert_eq!(again, gradient);
}
