//! Momenta of symmetries, the symplectic form, energies.

use core::ops::ControlFlow;

use piola_geometric::{
    Chord, DiscreteEulerLagrange, DiscreteLagrangian, VariationalIntegrator, VariationalSystem, momentum_map,
};
use piola_integrators::State;
use piola_numerics::{Gradient, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::{Kepler, SphericalPendulum, all};
use crate::problems::{kepler_at, kepler_energy};

/// q₁p₂ − q₂p₁, the momentum of rotations.
fn angular_momentum(y: &[f64]) -> f64 {
    momentum_map(&[-y[1], y[0]], &y[2..]).unwrap()
}

/// The largest change of the angular momentum over so many steps.
fn drift<S: VariationalSystem>(system: &S, method: &mut VariationalIntegrator, state: &mut State, steps: u32) -> f64 {
    let (before, mut largest, mut seen) = (angular_momentum(&state.values), 0.0_f64, 0_u32);
    let end = method.step() * f64::from(steps);
    method
        .integrate(system, state, end, |step| {
            largest = largest.max((angular_momentum(step.values) - before).abs());
            seen += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(seen, steps);
    largest
}

const WALK: Tol = Tol::ulps_because(64.0, "the roundings of 2000 steps walk at random");

#[test]
fn angular_momentum_of_keplers_motion_is_kept_to_rounding() {
    for (rule, order) in all() {
        let mut method = VariationalIntegrator::new(rule, order, 0.1).unwrap();
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let drift = drift(&Kepler, &mut method, &mut state, 2000);
        assert_close_at_scale("angular momentum", &[drift], &[0.0], 1.0, WALK);
        // The energy oscillates about its value and does not drift: after 200 s it is within the local error.
        let change = kepler_energy(&state.values) - kepler_energy(&kepler_at(0.3, 0.0));
        assert!(change.abs() < 0.02, "{change:e}");
    }
}

#[test]
fn angular_momentum_of_a_spherical_pendulum_is_kept_to_rounding() {
    for (rule, order) in all() {
        let mut method = VariationalIntegrator::new(rule, order, 0.1).unwrap();
        let mut state = method.start(&SphericalPendulum, 0.0, &[0.5, 0.0], &[0.1, 0.4]).unwrap();
        // p = 4 v/(1 + r²)².
        let p = 4.0 / 1.5625;
        assert_close("momenta", &state.values[2..], &[0.1 * p, 0.4 * p], Tol::ulps(2.0));
        let drift = drift(&SphericalPendulum, &mut method, &mut state, 2000);
        assert_close_at_scale("angular momentum", &[drift], &[0.0], 1.0, WALK);
    }
}

type G = Gradient<f64, 4>;

/// Asserts dᵀ J d = J for d = ∂y/∂y₀, relative to the products that cancel.
fn assert_symplectic(what: &str, y: &[G]) {
    let (mut form, mut expected, mut scale) = ([0.0; 16], [0.0; 16], 1.0_f64);
    for i in 0..4 {
        for j in 0..4 {
            for k in 0..2 {
                let (a, b) = (y[k].partials[i] * y[k + 2].partials[j], y[k + 2].partials[i] * y[k].partials[j]);
                form[4 * i + j] += a - b;
                scale = scale.max(a.abs()).max(b.abs());
            }
        }
    }
    for k in 0..2 {
        expected[4 * k + k + 2] = 1.0;
        expected[4 * (k + 2) + k] = -1.0;
    }
    assert_close_at_scale(what, &form, &expected, scale, Tol::ulps(64.0));
}

#[test]
fn the_derivative_of_a_step_is_symplectic() {
    for (rule, order) in all() {
        // One large step, and ten.
        for end in [0.4, 4.0] {
            let start = [0.5, 0.125, 0.25, 1.0];
            let mut state = State::new(0.0, (0..4).map(|i| G::variable(start[i], i)).collect()).unwrap();
            let mut method = VariationalIntegrator::<G>::new(rule, order, 0.4).unwrap();
            method.integrate_to(&SphericalPendulum, &mut state, end).unwrap();
            assert_symplectic(&format!("{rule:?} {order:?}"), &state.values);
            // The derivative is none of the identity.
            assert!(1e-2 < state.values[0].partials[2].abs());
        }
    }
}

/// A discrete Lagrangian of no quadrature: h [½ |q₁ − q₀|²/h² − ½ |(q₀ + q₁)/2|⁴], with rotations as symmetries.
struct Quartic;
impl DiscreteLagrangian for Quartic {
    fn freedom(&self) -> usize {
        2
    }
    fn discrete_lagrangian<T: Real>(&self, chord: Chord<'_, T>) -> T {
        let (half, h) = (T::lit(0.5), T::lit(chord.step));
        let (mut kinetic, mut square) = (T::zero(), T::zero());
        for i in 0..2 {
            let (v, q) = (chord.change[i] / h, half * (chord.start[i] + chord.end[i]));
            kinetic += half * v * v;
            square += q * q;
        }
        h * (kinetic - half * square * square)
    }
}

#[test]
fn a_given_discrete_lagrangian_keeps_its_momentum_and_the_symplectic_form() {
    let start = [0.75, 0.0, 0.125, 0.5];
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut largest = 0.0_f64;
    DiscreteEulerLagrange::new(0.25)
        .unwrap()
        .integrate(&Quartic, &mut state, 500.0, |step| {
            largest = largest.max((angular_momentum(step.values) - angular_momentum(&start)).abs());
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_close_at_scale("angular momentum", &[largest], &[0.0], 0.375, WALK);
    let mut state = State::new(0.0, (0..4).map(|i| G::variable(start[i], i)).collect()).unwrap();
    DiscreteEulerLagrange::<G>::new(0.25).unwrap().integrate_to(&Quartic, &mut state, 2.5).unwrap();
    assert_symplectic("quartic", &state.values);
}
