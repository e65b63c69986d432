//! Mass matrices, regular and singular.

use core::convert::Infallible;

use piola_integrators::{DormandPrince853, Field, IntegratorsError, State, Tolerance, field};
use piola_numerics::Real;
use piola_stiff::{DifferenceJacobian, ExactJacobian, RadauIia, WithMass};
use piola_testkit::golden::{self, text, vector};
use piola_testkit::{Tol, assert_close, assert_each_close};

#[test]
fn regular_mass_matrix_equals_the_solved_system() {
    // M = (2 1; 1 3), f = (y₂, −y₁ − y₂³).
    let f = |y: &[f64]| [y[1], -y[0] - y[1].powi(3)];
    let massive = field(2, move |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&f(y)));
    let mut solved = field(2, move |_t, y: &[f64], rate: &mut [f64]| {
        let [a, b] = f(y);
        rate.copy_from_slice(&[(3.0 * a - b) / 5.0, (2.0 * b - a) / 5.0]);
    });
    let mut massive = WithMass::new(DifferenceJacobian::new(massive), vec![2.0, 1.0, 1.0, 3.0]).unwrap();
    let (mut one, mut other) = (State::new(0.0, vec![1.0, 0.5]).unwrap(), State::new(0.0, vec![1.0, 0.5]).unwrap());
    RadauIia::new(Tolerance::relative(1e-11).unwrap()).integrate_to(&mut massive, &mut one, 10.0).unwrap();
    DormandPrince853::new(Tolerance::relative(1e-13).unwrap()).integrate_to(&mut solved, &mut other, 10.0).unwrap();
    assert_close("state", &one.values, &other.values, Tol::stated(1e-10, "tolerance 1e-11"));
}

/// Robertson's reaction with the conservation of mass instead of its third equation: index 1.
struct ConservedRobertson;
impl<T: Real> Field<T> for ConservedRobertson {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        3
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let (slow, back) = (T::lit(0.04) * y[0], T::lit(1e4) * y[1] * y[2]);
        rate[0] = back - slow;
        rate[1] = slow - back - T::lit(3e7) * y[1] * y[1];
        rate[2] = y[0] + y[1] + y[2] - T::one();
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        for (magnitude, y) in magnitudes.iter_mut().zip(y) {
            *magnitude = y.primal(0).abs();
        }
    }
}

#[test]
fn constraint_of_index_one_equals_the_differential_equation() {
    let golden = golden::load("stiff");
    for (name, end) in [("Robertson to 40", 40.0), ("Robertson", 1e11)] {
        let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
        let mass = vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
        let mut system = WithMass::new(ExactJacobian::new(ConservedRobertson), mass).unwrap();
        let mut state = State::new(0.0, vec![1.0, 0.0, 0.0]).unwrap();
        let mut method = RadauIia::new(Tolerance::new(1e-9, 1e-17).unwrap());
        let report = method.integrate_to(&mut system, &mut state, end).unwrap();
        let tol = Tol::stated(2e-8, "tolerance 1e-9");
        assert_each_close(name, &state.values, &vector(&case["values"]), tol);
        assert!(report.run.steps < 250, "{report:?}");
    }
}

/// A pendulum of length 1 in Cartesian coordinates (x, y, u, v, λ) with the constraint x u + y v = 0 on velocities: index 2.
struct Pendulum;
impl<T: Real> Field<T> for Pendulum {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        5
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -y[4] * y[0];
        rate[3] = -y[4] * y[1] - T::one();
        rate[4] = y[0] * y[2] + y[1] * y[3];
        Ok(())
    }
}

#[test]
fn constraint_of_index_two_equals_the_pendulum_in_its_angle() {
    let mut mass = vec![0.0; 25];
    (0..4).for_each(|k| mass[6 * k] = 1.0);
    let mut system = WithMass::new(ExactJacobian::new(Pendulum), mass).unwrap().with_index_two_from(4);
    for tolerance in [1e-6, 1e-9] {
        let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
        let mut method = RadauIia::new(Tolerance::new(tolerance, tolerance).unwrap());
        let report = method.integrate_to(&mut system, &mut state, 5.0).unwrap();
        // From the horizontal: φ̈ = −sin φ from φ = π/2; (x, y) = (sin φ, −cos φ).
        let mut angle = field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[y[1], -y[0].sin()]));
        let mut exact = State::new(0.0, vec![core::f64::consts::FRAC_PI_2, 0.0]).unwrap();
        DormandPrince853::new(Tolerance::relative(1e-13).unwrap()).integrate_to(&mut angle, &mut exact, 5.0).unwrap();
        let (sine, cosine) = exact.values[0].sin_cos();
        let omega = exact.values[1];
        let expected = [sine, -cosine, omega * cosine, omega * sine];
        let tol = Tol::stated(20.0, "growth over a period").times(tolerance);
        assert_close("motion", &state.values[..4], &expected, tol);
        // The reaction: λ = ω² + cos φ.
        let tol = Tol::stated(2000.0, "index 2: the reaction has lower order").times(tolerance);
        assert_close("reaction", &state.values[4..], &[omega * omega + cosine], tol);
        assert!(report.run.steps < 120, "{report:?}");
    }
}

#[test]
fn constraints_hold_at_the_end_of_every_step() {
    let mass = vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    let mut system = WithMass::new(ExactJacobian::new(ConservedRobertson), mass).unwrap();
    let mut state = State::new(0.0, vec![1.0, 0.0, 0.0]).unwrap();
    let mut steps = 0;
    RadauIia::new(Tolerance::new(1e-4, 1e-12).unwrap())
        .integrate(&mut system, &mut state, 1e5, |step| {
            assert!((step.values().iter().sum::<f64>() - 1.0).abs() < 4.0 * f64::EPSILON, "{:?}", step.values());
            steps += 1;
            core::ops::ControlFlow::Continue(())
        })
        .unwrap();
    assert!(10 < steps);
}

#[test]
fn mass_matrix_of_the_wrong_length_or_not_finite_is_refused_by_name() {
    let decay = || DifferenceJacobian::new(field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(y)));
    let error = WithMass::new(decay(), vec![1.0; 3]).err();
    assert_eq!(error, Some(IntegratorsError::WrongLength { quantity: "mass", expected: 4, found: 3 }));
    let error = WithMass::new(decay(), vec![1.0, 0.0, f64::NAN, 1.0]).err();
    assert!(matches!(error, Some(IntegratorsError::NotFinite { quantity: "mass", index: 2, .. })), "{error:?}");
}
