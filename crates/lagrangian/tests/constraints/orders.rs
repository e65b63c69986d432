//! RATTLE: its order, and what it keeps.

use core::ops::ControlFlow;

use piola_integrators::{State, Tolerance};
use piola_lagrangian::constraints::{Constrained, Rattle};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_order};

use crate::four_bar::{GRAVITY, RATE, state};
use crate::systems::{Drive, Mechanism, Spring, System, Ties, mechanism};

type Tied = Constrained<System, Spring, Drive, Ties>;

fn four_bar() -> Tied {
    mechanism(System::FourBar, GRAVITY, 0.0).with_constraints(Ties::FourBar)
}

/// Momenta belong to velocities: every coordinate must have inertia.
fn bricard() -> Tied {
    mechanism(System::Bricard { sixth: true }, crate::bricard::GRAVITY, 0.0).with_constraints(Ties::Bricard)
}

/// Energy from positions and momenta.
fn energy(lagrangian: &Mechanism, y: &[f64]) -> f64 {
    let (q, p) = y.split_at(y.len() / 2);
    let mut v = vec![0.0; q.len()];
    lagrangian.velocities_into(&mut piola_lagrangian::Workspace::default(), q, p, 0.0, &mut v).unwrap();
    lagrangian.energies(q, &v, 0.0).unwrap().total()
}

#[test]
fn error_of_rattle_falls_with_the_second_and_of_its_composition_with_the_fourth_power_of_the_step() {
    let linkage = four_bar();
    let (q, v) = state(0.5, RATE);
    let start = linkage.canonical_state(&q, &v, 0.0).unwrap();
    let exact = linkage.integrate(&q, &v, 0.0..0.25, Tolerance::relative(1e-13).unwrap()).unwrap();
    let exact = exact.last().0.to_vec();
    let error = |mut rattle: Rattle| {
        let mut state = start.clone();
        rattle.integrate_to(&linkage, &mut state, 0.25).unwrap();
        state.values[..3].iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let steps = [0.25 / 128.0, 0.25 / 256.0, 0.25 / 512.0, 0.25 / 1024.0];
    let second = steps.map(|h| error(Rattle::new(h).unwrap()));
    let long_steps = steps.map(|h| 4.0 * h);
    let fourth = long_steps.map(|h| error(Rattle::new(h).unwrap().of_order_four()));
    assert_order("RATTLE", &steps, &second, 2.0, 0.1);
    assert_order("RATTLE, composed", &long_steps, &fourth, 4.0, 0.2);
}

#[test]
fn rattle_run_backwards_returns_to_its_start() {
    let (q, v) = state(0.5, RATE);
    let (psi, rate) = (0.6, 4.0);
    let (loop_q, loop_v) = crate::bricard::state(psi, rate);
    for (system, q, v, step) in [(four_bar(), &q[..], &v[..], 0.002), (bricard(), &loop_q[..], &loop_v[..], 0.01)] {
        let start = system.canonical_state(q, v, 0.0).unwrap();
        let mut state = start.clone();
        Rattle::new(step).unwrap().integrate_to(&system, &mut state, 1.0).unwrap();
        let travelled = (state.values[0] - start.values[0]).abs();
        assert!(0.5 < travelled, "{travelled}");
        Rattle::new(step).unwrap().integrate_to(&system, &mut state, 0.0).unwrap();
        let n = q.len();
        let tol = Tol::stated(1e-11, "some hundred steps, each rounded, on a motion that does not damp");
        assert_close_at_scale("q", &state.values[..n], &start.values[..n], 1.0, tol);
        assert_close_at_scale("p", &state.values[n..], &start.values[n..], 1.0, tol);
    }
}

#[test]
fn energy_of_rattle_does_not_drift_and_loops_stay_closed() {
    let (loop_q, loop_v) = crate::bricard::state(0.6, 4.0);
    let (q, v) = state(0.5, RATE);
    // Six seconds and, of the loop with six angles, four turns.
    for (system, q, v, step, steps) in
        [(four_bar(), &q[..], &v[..], 0.002, 3_000.0), (bricard(), &loop_q[..], &loop_v[..], 0.01, 600.0)]
    {
        let mut state = system.canonical_state(q, v, 0.0).unwrap();
        let before = energy(system.unconstrained(), &state.values);
        let (mut first, mut second, mut open, mut slip) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        let end = steps * step;
        let mut rattle = Rattle::new(step).unwrap();
        let n = q.len();
        rattle
            .integrate(&system, &mut state, end, |step| {
                let change = (energy(system.unconstrained(), step.values) - before).abs() / before.abs();
                if step.time < 0.5 * end {
                    first = first.max(change);
                } else {
                    second = second.max(change);
                }
                let q = &step.values[..n];
                open = system.residuals(q, step.time).iter().fold(open, |m, r| m.max(r.abs()));
                slip = slip.max(q.iter().fold(0.0, |m: f64, q| m.max(q.abs())));
                ControlFlow::Continue(())
            })
            .unwrap();
        assert!(second < 1.05 * first, "energy drifts: {first:e} then {second:e}");
        // Angles grow by many turns; a rounding of them opens the loops.
        assert_close_at_scale("loops", &[open], &[0.0], slip.max(1.0), Tol::ulps(8.0));
    }
}

/// Where nothing moves, a step ends after one sweep: its two evaluations, and one of the force at the end.
#[test]
fn steps_of_rattle_at_rest_cost_three_evaluations_each() {
    let free = mechanism(System::Particles { last_has_mass: true }, [0.0; 3], 0.0);
    let held = free.with_constraints(Ties::Linear(vec![vec![0.0, 0.0, 1.0, 2.0, -1.0]]));
    let mut state = held.canonical_state(&[0.0; 3], &[0.0; 3], 0.0).unwrap();
    let report = Rattle::new(0.125).unwrap().integrate_to(&held, &mut state, 1.0).unwrap();
    assert_eq!((report.steps, report.evaluations), (8, 24));
    assert_close("state", &state.values, &[0.0; 6], Tol::ulps(0.0));
}

/// The step maps the states on the constraint to each other; in the coordinates (θ, p) of a system with one degree of
/// freedom its Jacobian has the determinant one.
#[test]
fn step_of_rattle_preserves_the_area_of_phase_space() {
    let linkage = four_bar();
    let step = |crank: f64, rate: f64| -> [f64; 2] {
        let (q, v) = state(crank, rate);
        let mut y = linkage.canonical_state(&q, &v, 0.0).unwrap();
        Rattle::new(0.02).unwrap().integrate_to(&linkage, &mut y, 0.02).unwrap();
        [y.values[0], reduced_momentum(&linkage, &y)]
    };
    // By the crank's angle and its momentum; the start is in its rate, p = g(θ) θ̇.
    let (crank, rate) = (0.5, RATE);
    let momentum = |crank: f64, rate: f64| {
        let (q, v) = state(crank, rate);
        reduced_momentum(&linkage, &linkage.canonical_state(&q, &v, 0.0).unwrap())
    };
    let (h, k) = (1e-3, 1e-2);
    let central = |f: &dyn Fn(f64) -> f64, h: f64| (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
    let partial = |i: usize| [central(&|h| step(crank + h, rate)[i], h), central(&|k| step(crank, rate + k)[i], k)];
    let ([a, b], [c, d]) = (partial(0), partial(1));
    let by_rate = central(&|k| momentum(crank, rate + k), k);
    // The area element of the start is ∂p/∂θ̇ dθ dθ̇.
    let determinant = (a * d - b * c) / by_rate;
    let tol = Tol::stated(1e-7, "differences of the fourth order of steps of a thousandth");
    assert_close_at_scale("determinant", &[determinant], &[1.0], 1.0, tol);
}

/// Σ p ∂q/∂θ: the momentum of the crank's angle.
fn reduced_momentum(_linkage: &Tied, y: &State) -> f64 {
    let (_, tangent) = state(y.values[0], 1.0);
    y.values[3..].iter().zip(tangent).map(|(p, q)| p * q).sum()
}
