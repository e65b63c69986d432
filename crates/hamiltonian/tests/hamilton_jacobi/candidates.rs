//! The residual of the Hamilton–Jacobi equation: for functions that solve it, and by hand for those that do not.

use piola_hamiltonian::hamilton_jacobi::{Candidate, PrincipalFunction, StationaryCandidate};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_each_close};
use proptest::prelude::*;

use super::systems::{FromPlace, OscillatorAction, Particle, ShakenPendulum};

/// U = ¾ x² − ½ x y + 2 y t + ¼ t².
struct Polynomial;

impl PrincipalFunction for Polynomial {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        let (x, y) = (q[0], q[1]);
        T::lit(0.75) * x * x - T::lit(0.5) * x * y + T::lit(2.0) * y * t + T::lit(0.25) * t * t
    }
}

/// W(11.19) by hand: H = |p|²/4 + r²/4 + 6 y at (x, y, t) = (1, 2, ½), with
///
/// ```text
/// p = (3/2 x − ½ y, −½ x + 2 t) = (½, ½)      ∂U/∂t = 2 y + ½ t = 17/4      H = ⅛ + 5/4 + 12 = 107/8      r = 141/8
/// ```
#[test]
fn residual_of_a_polynomial_equals_that_by_hand() {
    let system = Particle { mass: 2.0, omega: 0.5, gravity: vec![0.0, -3.0] };
    // Numbers of a few binary digits: nothing rounds.
    let exact = Tol::ulps(0.0);
    let mut candidate = Candidate::new(&system, Polynomial);
    let found = candidate.residual(&[1.0, 2.0], 0.5).unwrap();
    assert_each_close("r", &[found.value, found.time_derivative, found.energy], &[17.625, 4.25, 13.375], exact);
    assert_each_close("p", candidate.momenta(), &[0.5, 0.5], exact);
    assert_each_close("U", &[candidate.value()], &[1.8125], exact);
    // The same without time, at t = 0: p = (½, −½), and H − E with E = 3.
    let mut candidate = StationaryCandidate::new(&system, Polynomial, 3.0);
    let found = candidate.residual(&[1.0, 2.0]).unwrap();
    assert_each_close("r", &[found.value, found.time_derivative, found.energy], &[10.375, -3.0, 13.375], exact);
    assert_each_close("p", candidate.momenta(), &[0.5, -0.5], exact);
}

/// U = b q.
struct Plane(f64);

impl PrincipalFunction for Plane {
    fn value<T: Real>(&self, q: &[T], _t: T) -> T {
        T::lit(self.0) * q[0]
    }
}

/// U + c q t of a function U.
struct Tilted<'a, U>(&'a U, f64);

impl<U: PrincipalFunction> PrincipalFunction for Tilted<'_, U> {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        self.0.value(q, t) + T::lit(self.1) * q[0] * t
    }
}

/// −U, the action of the motion backwards with the sign of a generating function.
struct Negative<'a, U>(&'a U);

impl<U: PrincipalFunction> PrincipalFunction for Negative<'_, U> {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        -self.0.value(q, t)
    }
}

proptest! {
    /// H = ½ p² − (4 + cos 3t) cos q: the time of the event enters H.
    #[test]
    fn residual_of_a_plane_equals_the_energy_of_its_slope(b in -2.0..2.0_f64, q in -3.0..3.0_f64, t in -2.0..2.0_f64) {
        let pendulum = ShakenPendulum { amplitude: 1.0 };
        let found = Candidate::new(&pendulum, Plane(b)).residual(&[q], t).unwrap();
        let expected = 0.5 * b * b - (4.0 + (3.0 * t).cos()) * q.cos();
        assert_close_at_scale("r", &[found.value, found.energy], &[expected; 2], 7.0, Tol::ulps(4.0));
        assert_close("∂U/∂t", &[found.time_derivative], &[0.0], Tol::ulps(0.0));
    }

    /// The action of an oscillator from a place solves, r = 0; −U has r = 2 H, and U + c q t has
    /// r = c q + ((p + c t)² − p²)/(2m), with p = m ω (q cos ωt − Q)/sin ωt.
    #[test]
    fn residual_of_an_action_vanishes_and_that_of_a_disturbed_one_is_what_disturbs(
        place in -1.0..1.0_f64, q in -1.0..1.0_f64, t in 0.2..1.0_f64, c in 0.1..1.0_f64,
    ) {
        let (mass, omega) = (1.5, 1.25);
        let system = Particle::oscillator(mass, omega, 1);
        let solution = FromPlace { action: OscillatorAction { mass, omega }, place: vec![place] };
        let (s, cosine) = (omega * t).sin_cos();
        let p = mass * omega * (q * cosine - place) / s;
        let energy = 0.5 * p * p / mass + 0.5 * mass * omega * omega * q * q;
        // Terms of ∂U/∂t and of H: both have this size, and cancel down to H.
        let terms = mass * (omega * (q.abs() + place.abs()) / s).powi(2);
        let few = Tol::ulps(8.0);
        let close = |what: &str, actual: f64, expected: f64| assert_close_at_scale(what, &[actual], &[expected], terms, few);
        let mut candidate = Candidate::new(&system, &solution);
        let found = candidate.residual(&[q], t).unwrap();
        close("r", found.value, 0.0);
        close("H", found.energy, energy);
        close("∂U/∂t = −H", found.time_derivative, -energy);
        let momentum = mass * omega * (q.abs() + place.abs()) / s;
        assert_close_at_scale("p", candidate.momenta(), &[p], momentum, few);
        let reversed = Candidate::new(&system, Negative(&solution)).residual(&[q], t).unwrap();
        close("r of −U", reversed.value, 2.0 * energy);
        let tilted = Candidate::new(&system, Tilted(&solution, c)).residual(&[q], t).unwrap();
        let expected = c * q + 0.5 * c * t * (2.0 * p + c * t) / mass;
        assert_close_at_scale("r of U + c q t", &[tilted.value], &[expected], terms + 2.0, few);
        // Without time: S = U at a fixed t has r = H − E.
        let stationary = StationaryCandidate::new(&system, Plane(p), 0.25).residual(&[q]).unwrap();
        close("r of S", stationary.value, energy - 0.25);
    }
}
