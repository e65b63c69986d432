//! The action and its variations.

use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_lagrangian::{Lagrangian, Path, SampledMotion, Varied};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close_at_scale};
use std::ops::ControlFlow::Continue;

use crate::systems::*;

/// Any path of three coordinates.
pub(crate) struct Wander;
impl Path for Wander {
    fn freedom(&self) -> usize {
        3
    }
    fn at<T: Real>(&self, t: T, q: &mut [T]) {
        let (s, c) = t.sin_cos();
        q[0] = T::lit(0.5) * s;
        q[1] = T::lit(0.25) * t - c * s;
        q[2] = t * t * T::lit(0.125);
    }
}

/// Any variation; it does not vanish at the ends.
struct Bump;
impl Path for Bump {
    fn freedom(&self) -> usize {
        3
    }
    fn at<T: Real>(&self, t: T, eta: &mut [T]) {
        let (s, c) = (t + t).sin_cos();
        (eta[0], eta[1], eta[2]) = (c, T::one() - t, s * t);
    }
}

#[test]
fn first_variation_equals_interior_and_end_point_terms() {
    let tolerance = Tolerance::relative(1e-13).unwrap();
    for shifts in [[0.0, 0.0], [0.5, -0.25]] {
        let variation = everything().first_variation(&Wander, &Bump, 0.0..1.5, shifts, tolerance).unwrap();
        let sum = variation.interior + variation.end_points;
        let tol = Tol::stated(1e-12, "ten times the tolerance of the integrals");
        assert_close_at_scale("δI", &[variation.value], &[sum], 10.0, tol);
        assert!(1e-3 < variation.interior.abs() && 1e-3 < variation.end_points.abs(), "{variation:?}");
    }
}

#[test]
fn first_variation_equals_slope_of_the_action() {
    let tolerance = Tolerance::relative(1e-13).unwrap();
    let system = everything();
    let action = |amount: f64| {
        let varied = Varied { path: &Wander, variation: &Bump, amount };
        system.action(&varied, 0.0..1.5, tolerance).unwrap().value
    };
    let slope = piola_testkit::difference_quotient(|amount| vec![action(amount[0])], &[0.0], &[1.0]);
    let variation = system.first_variation(&Wander, &Bump, 0.0..1.5, [0.0; 2], tolerance).unwrap();
    let tol = Tol::stated(1e-8, "sixth-order differences of integrals");
    assert_close_at_scale("δI", &[variation.value], &slope, 10.0, tol);
}

/// The harmonic oscillator: q = cos t obeys q̈ = −q.
pub(crate) struct Oscillator;
impl piola_lagrangian::LagrangianFunction for Oscillator {
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        T::lit(0.5) * (v[0] * v[0] - q[0] * q[0])
    }
}

struct Cosine;
impl Path for Cosine {
    fn freedom(&self) -> usize {
        1
    }
    fn at<T: Real>(&self, t: T, q: &mut [T]) {
        q[0] = t.cos();
    }
}

/// η = sin(π t/2), zero at the ends 0 and 2.
struct HalfWave;
impl Path for HalfWave {
    fn freedom(&self) -> usize {
        1
    }
    fn at<T: Real>(&self, t: T, eta: &mut [T]) {
        eta[0] = (T::lit(std::f64::consts::FRAC_PI_2) * t).sin();
    }
}

#[test]
fn action_is_stationary_at_the_motion_and_grows_by_the_square() {
    let oscillator = Lagrangian::from_function(Oscillator);
    let tolerance = Tolerance::relative(1e-14).unwrap();
    let variation = oscillator.first_variation(&Cosine, &HalfWave, 0.0..2.0, [0.0; 2], tolerance).unwrap();
    let values = [variation.value, variation.interior, variation.end_points];
    assert_close_at_scale("δI", &values, &[0.0; 3], 1.0, Tol::ulps(16.0));
    let action = |amount: f64| {
        let varied = Varied { path: &Cosine, variation: &HalfWave, amount };
        oscillator.action(&varied, 0.0..2.0, tolerance).unwrap().value
    };
    // I(0) = −½ ∫ cos 2t dt, and the second variation is exact: ½ ε² ∫ (η̇² − η²) dt = ½ ε² (π²/4 − 1).
    assert_close_at_scale("I", &[action(0.0)], &[-0.25 * 4.0_f64.sin()], 1.0, Tol::ulps(16.0));
    for amount in [0.5, 0.25, -0.125] {
        let expected = 0.5 * amount * amount * (std::f64::consts::PI.powi(2) / 4.0 - 1.0);
        assert_close_at_scale("growth", &[action(amount) - action(0.0)], &[expected], 1.0, Tol::ulps(16.0));
    }
}

/// Samples of the driven arm, at an even spacing.
pub(crate) fn samples(system: &Everything, steps: u32) -> SampledMotion {
    let (q, v) = ([0.25, 0.5, -0.75], [1.0, -0.5, 0.25]);
    let mut state = State::new(0.0, [q, v].concat()).unwrap();
    let (mut times, mut coordinates, mut velocities) = (vec![0.0], q.to_vec(), v.to_vec());
    let mut method = DormandPrince853::new(Tolerance::relative(1e-13).unwrap());
    for step in 1..=steps {
        let time = f64::from(step) / f64::from(steps);
        method.integrate(&mut system.motion(3), &mut state, time, |_| Continue(())).unwrap();
        times.push(time);
        coordinates.extend_from_slice(&state.values[..3]);
        velocities.extend_from_slice(&state.values[3..]);
    }
    SampledMotion::new(3, times, coordinates, velocities).unwrap()
}

#[test]
fn action_of_samples_of_a_path_equals_its_integral_within_the_error_stated() {
    let system = everything();
    let count = 33;
    let times: Vec<f64> = (0..count).map(|i| f64::from(i) / 16.0).collect();
    let (mut coordinates, mut velocities) = (Vec::new(), Vec::new());
    for &time in &times {
        let mut jets = [piola_numerics::Dual::constant(0.0); 3];
        Wander.at(piola_numerics::Dual::variable(time), &mut jets);
        coordinates.extend(jets.map(|x| x.value));
        velocities.extend(jets.map(|x| x.tangent));
    }
    let samples = SampledMotion::new(3, times, coordinates, velocities).unwrap();
    let action = system.action_of_samples(&samples).unwrap();
    let exact = system.action(&Wander, 0.0..2.0, Tolerance::relative(1e-13).unwrap()).unwrap();
    let error = (action.value - exact.value).abs();
    // Cubic interpolation over sixteenths: h⁴ is 1.5e-5, and the error found 1.8e-5.
    assert!(error <= action.error && action.error < 1e-4, "{error:e} {action:?} {exact:?}");
}
