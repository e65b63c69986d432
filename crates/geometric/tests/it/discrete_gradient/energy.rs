//! What is kept, and how well.

use core::ops::ControlFlow;

use piola_geometric::{DiscreteGradient, EnergySystem};
use piola_integrators::{Order, State};
use piola_numerics::Secant;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::{DampedPendulum, FreeBody, HenonHeiles, Kepler, Pendulum, change};

/// The largest |H − H₀| over a run of so many steps, and the last state.
fn largest_change<S: EnergySystem>(system: &S, order: Order, step: f64, steps: u32, start: &[f64]) -> (f64, Vec<f64>) {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let (mut largest, mut seen) = (0.0_f64, 0_u32);
    DiscreteGradient::new(order, step)
        .unwrap()
        .integrate(system, &mut state, step * f64::from(steps), |now| {
            largest = largest.max(change(|y| system.energy(y), start, now.values).abs());
            seen += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(seen, steps);
    (largest, state.values)
}

/// The state is rounded to an ulp, which moves the energy by |∇H| ulp of the state, of order one here.
const KEPT: Tol = Tol::ulps(4.0);

#[test]
fn energy_of_henon_and_heiles_is_kept_to_rounding_over_1e5_steps() {
    // A chaotic orbit: H = 0.15.
    let (largest, _) = largest_change(&HenonHeiles, Order::Two, 0.1, 100_000, &[0.0, 0.1, 0.5379, 0.0]);
    assert_close_at_scale("order 2", &[largest], &[0.0], 0.15, KEPT);
    for order in [Order::Four, Order::Six] {
        let (largest, _) = largest_change(&HenonHeiles, order, 0.1, 5_000, &[0.0, 0.1, 0.5379, 0.0]);
        assert_close_at_scale("higher order", &[largest], &[0.0], 0.15, KEPT);
    }
}

#[test]
fn energy_and_casimir_function_of_a_free_body_are_kept_to_rounding_over_1e5_steps() {
    // Near the unstable axis.
    let start = [0.01, 1.0, 0.02];
    let (largest, end) = largest_change(&FreeBody, Order::Two, 0.1, 100_000, &start);
    assert_close_at_scale("energy", &[largest], &[0.0], 0.25, KEPT);
    let casimir = change(FreeBody::casimir, &start, &end);
    let walk = Tol::ulps_because(128.0, "the roundings of 1e5 steps, which walk at random: √1e5 h ulp and more");
    assert_close_at_scale("Casimir function", &[casimir], &[0.0], 0.5, walk);
}

#[test]
fn energy_of_a_pendulum_is_kept_to_rounding_across_its_separatrix() {
    // H = 1 on the separatrix: below, on and above it, 1e5 steps in all.
    let mut turns = Vec::new();
    for (p, steps) in [(1.999_999_999, 30_000), (2.0, 40_000), (2.000_000_001, 30_000)] {
        let (largest, end) = largest_change(&Pendulum, Order::Two, 0.1, steps, &[0.0, p]);
        // Turning over and over, q grows, and with it its ulp, which moves the energy.
        assert_close_at_scale("energy", &[largest], &[0.0], 2.0_f64.max(end[0].abs()), KEPT);
        turns.push(end[0]);
    }
    assert!(turns[0].abs() < 3.2 && 10.0 < turns[2], "{turns:?}");
}

#[test]
fn energy_of_kepler_is_kept_at_a_step_of_a_twentieth_of_a_revolution() {
    let (largest, _) = largest_change(&Kepler, Order::Two, 0.3, 5_000, &[0.5, 0.0, 0.0, 1.7]);
    assert_close_at_scale("energy", &[largest], &[0.0], 2.0, Tol::ulps(8.0));
}

#[test]
fn energy_is_kept_to_the_rounding_of_single_precision() {
    let start = [0.0_f32, 0.1, 0.5379, 0.0];
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut largest = 0.0_f32;
    DiscreteGradient::<f32>::new(Order::Two, 0.1)
        .unwrap()
        .integrate(&HenonHeiles, &mut state, 1000.0, |step| {
            let secants: Vec<_> = start.iter().zip(step.values).map(|(&a, &b)| Secant::new(a, b - a)).collect();
            largest = largest.max(HenonHeiles.energy(&secants).change.abs());
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_close_at_scale("energy", &[f64::from(largest)], &[0.0], 0.15, Tol::ulps32(4.0));
}

#[test]
fn small_swings_equal_those_of_the_midpoint_rule_to_their_own_rounding() {
    // At 1e-9 the energies H = −1 + 5e-19 cannot be told apart. The linear step turns by 2 atan(h/2).
    let (h, amplitude) = (0.1, 1e-9);
    let mut state = State::new(0.0, vec![amplitude, 0.0]).unwrap();
    DiscreteGradient::new(Order::Two, h).unwrap().integrate_to(&Pendulum, &mut state, 200.0 * h).unwrap();
    let angle = 200.0 * 2.0 * (0.5 * h).atan();
    let expected = [amplitude * angle.cos(), -amplitude * angle.sin()];
    assert_close("swing", &state.values, &expected, Tol::ulps_because(256.0, "two hundred steps"));
}

#[test]
fn rest_stays_rest() {
    for start in [[0.0_f64, 0.0], [5e-324, 0.0], [1e-170, 1e-170]] {
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        DiscreteGradient::new(Order::Four, 0.1).unwrap().integrate_to(&Pendulum, &mut state, 10.0).unwrap();
        let largest = state.values.iter().fold(0.0_f64, |m, &x: &f64| m.max(x.abs()));
        assert!(largest <= 2.0 * start[0], "{:?}", state.values);
    }
}

#[test]
fn damping_lowers_the_energy_in_every_step() {
    let pendulum = DampedPendulum { friction: 0.05 };
    let mut state = State::new(0.0, vec![3.0, 0.0]).unwrap();
    let (mut before, mut falls) = (state.values.clone(), 0);
    DiscreteGradient::new(Order::Two, 0.25)
        .unwrap()
        .integrate(&pendulum, &mut state, 1000.0, |step| {
            let fall = change(|y| pendulum.energy(y), &before, step.values);
            assert!(fall < 0.0, "{}: {fall:e}", step.number);
            before.copy_from_slice(step.values);
            falls += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(falls, 4000);
    // e^{−0.025 · 1000} of the amplitude: far below where energies can be told apart.
    assert!(state.values[0].abs() < 1e-9 && 0.0 < state.values[0].abs());
}

#[test]
fn damped_swings_equal_those_of_the_midpoint_rule() {
    // Of q̇ = p, ṗ = −q − f p the midpoint rule is (1 − hA/2)⁻¹ (1 + hA/2).
    let (h, f, mut expected) = (0.1, 0.2, [1e-9, 0.0]);
    for _ in 0..100 {
        let [q, p] = expected;
        let (right_q, right_p) = (q + 0.5 * h * p, p - 0.5 * h * (q + f * p));
        let determinant = 1.0 + 0.5 * h * f + 0.25 * h * h;
        expected = [
            ((1.0 + 0.5 * h * f) * right_q + 0.5 * h * right_p) / determinant,
            (right_p - 0.5 * h * right_q) / determinant,
        ];
    }
    let mut state = State::new(0.0, vec![1e-9, 0.0]).unwrap();
    let mut method = DiscreteGradient::new(Order::Two, h).unwrap();
    method.integrate_to(&DampedPendulum { friction: f }, &mut state, 10.0).unwrap();
    assert_close("swing", &state.values, &expected, Tol::ulps_because(256.0, "a hundred steps of both"));
}
