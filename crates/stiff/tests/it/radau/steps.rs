//! Orders of convergence, dense output, events.

use core::ops::ControlFlow;

use piola_integrators::{Crossing, Ending, Event, EventAction, IntegratorsError, State, Tolerance, field};
use piola_stiff::{DifferenceJacobian, ExactJacobian, GivenJacobian, RadauIia, RadauOrder};
use piola_testkit::{Tol, assert_close, assert_order};

use crate::problems::{kepler, kepler_at};

const E: f64 = 0.3;

fn start() -> State {
    State::new(0.0, kepler_at(E, 0.0).to_vec()).unwrap()
}

fn error(y: &[f64], exact: &[f64]) -> f64 {
    y.iter().zip(exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Steps over which errors fall by two decades or more, above rounding.
fn steps_for(order: RadauOrder) -> Vec<f64> {
    let (longest, ratio, count) = match order {
        RadauOrder::Five => (0.02_f64, 0.7_f64, 5),
        RadauOrder::Nine => (0.3, 0.85, 5),
        RadauOrder::Thirteen => (0.6, 0.9, 5),
    };
    // Whole parts of the run.
    (0..count).map(|k| 5.0 / (5.0 / (longest * ratio.powi(k))).round()).collect()
}

#[test]
fn error_falls_with_the_order() {
    for order in RadauOrder::ALL {
        let steps = steps_for(order);
        let errors: Vec<f64> = steps
            .iter()
            .map(|&h| {
                let mut state = start();
                let mut method = RadauIia::with_step(order, h).unwrap();
                method.integrate_to(&mut ExactJacobian::new(kepler()), &mut state, 5.0).unwrap();
                error(&state.values, &kepler_at(E, 5.0))
            })
            .collect();
        assert!(1e2 < errors[0] / errors[errors.len() - 1], "{errors:?}");
        assert_order(&format!("{order:?}"), &steps, &errors, f64::from(order.value()), 0.2);
    }
}

/// q̈ = −q over a hundred radians, over two decades within a tenth: on the imaginary axis the next power of the error is at right angles
/// to the first.
#[test]
fn phase_error_falls_with_the_order_over_two_decades() {
    for (order, counts) in [
        (RadauOrder::Five, [500, 800, 1250, 1600]),
        (RadauOrder::Nine, [160, 200, 240, 300]),
        (RadauOrder::Thirteen, [60, 68, 76, 86]),
    ] {
        let steps = counts.map(|count: u32| 100.0 / f64::from(count));
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
            let mut oscillator = GivenJacobian::new(
                field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[y[1], -y[0]])),
                |_t, _y: &[f64], jacobian: &mut [f64]| jacobian.copy_from_slice(&[0.0, -1.0, 1.0, 0.0]),
            );
            RadauIia::with_step(order, h).unwrap().integrate_to(&mut oscillator, &mut state, 100.0).unwrap();
            (state.values[0] - 100.0_f64.cos()).hypot(state.values[1] + 100.0_f64.sin())
        });
        assert!(1e2 < errors[0] / errors[3], "{order:?}: {errors:?}");
        assert_order(&format!("{order:?}"), &steps, &errors, f64::from(order.value()), 0.1);
    }
}

#[test]
fn dense_output_error_of_one_step_falls_with_order_s_plus_one() {
    for (order, steps) in [
        (RadauOrder::Five, [0.02, 0.01, 0.005]),
        (RadauOrder::Nine, [0.1, 0.0625, 0.04]),
        (RadauOrder::Thirteen, [0.2, 0.15, 0.11]),
    ] {
        let errors = steps.map(|h| {
            let (mut state, mut largest) = (start(), 0.0_f64);
            RadauIia::with_step(order, h)
                .unwrap()
                .integrate(&mut ExactJacobian::new(kepler()), &mut state, h, |step| {
                    let mut y = [0.0; 4];
                    for part in 1..16 {
                        let t = h * f64::from(part) / 16.0;
                        step.at(t, &mut y).unwrap();
                        largest = largest.max(error(&y, &kepler_at(E, t)));
                    }
                    ControlFlow::Continue(())
                })
                .unwrap();
            largest
        });
        let expected = f64::from(order.value()).mul_add(0.5, 1.5);
        assert!(1e2 < errors[0] / errors[2], "{errors:?}");
        assert_order("dense output", &steps, &errors, expected, 0.1);
    }
}

#[test]
fn dense_output_at_step_ends_equals_the_steps() {
    for end in [10.0, -10.0] {
        let mut state = start();
        let mut previous = kepler_at(E, 0.0).to_vec();
        RadauIia::new(Tolerance::relative(1e-9).unwrap())
            .integrate(&mut ExactJacobian::new(kepler()), &mut state, end, |step| {
                let mut y = [0.0; 4];
                step.at(step.start(), &mut y).unwrap();
                assert_eq!(&y[..], step.start_values());
                assert_eq!(&y[..], &previous[..]);
                step.at(step.time(), &mut y).unwrap();
                assert_eq!(&y[..], step.values());
                previous.copy_from_slice(&y);
                // It never extrapolates.
                let beyond = step.time() + (step.time() - step.start());
                assert!(matches!(step.at(beyond, &mut y), Err(IntegratorsError::OutsideStep { .. })));
                assert!(matches!(step.at(step.time(), &mut []), Err(IntegratorsError::WrongLength { .. })));
                ControlFlow::Continue(())
            })
            .unwrap();
        assert_eq!(previous, state.values);
    }
}

/// ẏ = −1e6 (y − cos t) − sin t: y = cos t attracts everything within a microsecond.
#[test]
fn steps_over_a_fast_decay_follow_the_slow_motion() {
    let rate = |t: f64, y: &[f64], rate: &mut [f64]| rate[0] = -1e6 * (y[0] - t.cos()) - t.sin();
    let jacobian = |_t: f64, _y: &[f64], jacobian: &mut [f64]| jacobian[0] = -1e6;
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let mut state = State::new(0.0, vec![0.0]).unwrap();
        let mut decay = GivenJacobian::new(field(1, rate), jacobian);
        let mut method = RadauIia::new(Tolerance::new(tolerance, tolerance).unwrap());
        let report = method.integrate_to(&mut decay, &mut state, 10.0).unwrap();
        let tol = Tol::stated(100.0, "order reduction").times(tolerance);
        assert_close(&format!("{tolerance:e}"), &state.values, &[10.0_f64.cos()], tol);
        assert!(report.run.steps < 250, "{report:?}");
    }
}

#[test]
fn linear_system_with_rates_from_one_to_a_million_ends_at_its_exponential() {
    // Coordinates (a, b, c) decay with 1, 1e3, 1e6 and are mixed by a rotation.
    let mixing = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    let rates = [1.0, 1e3, 1e6];
    let mix = move |y: &[f64], k: usize| mixing[k][0] * y[0] + mixing[k][1] * y[1] + mixing[k][2] * y[2];
    let mut linear = DifferenceJacobian::new(field(3, move |_t, y: &[f64], out: &mut [f64]| {
        out.fill(0.0);
        for k in 0..3 {
            let decay = -rates[k] * mix(y, k);
            for (out, mixing) in out.iter_mut().zip(mixing[k]) {
                *out += mixing * decay;
            }
        }
    }));
    let mut state = State::new(0.0, vec![1.0, 2.0, -1.0]).unwrap();
    let first = mix(&state.values, 0);
    RadauIia::new(Tolerance::new(1e-10, 1e-10).unwrap()).integrate_to(&mut linear, &mut state, 2.0).unwrap();
    let left = first * (-2.0_f64).exp();
    let exact: Vec<f64> = mixing[0].iter().map(|m| m * left).collect();
    assert_close("slow part", &state.values, &exact, Tol::stated(1e-8, "tolerance 1e-10"));
}

#[test]
fn event_within_a_step_stops_the_run_there() {
    let mut oscillator = ExactJacobian::new(kepler());
    let mut state = start();
    let mut crossing = [Event::new(Crossing::Falling, EventAction::Stop, |_t, y| y[1])];
    let report = RadauIia::new(Tolerance::relative(1e-12).unwrap())
        .integrate_with_events(
            &mut oscillator,
            &mut state,
            10.0,
            &mut crossing,
            |_| ControlFlow::Continue(()),
            |_| ControlFlow::Continue(()),
        )
        .unwrap();
    assert_eq!(report.run.ending, Ending::Event(0));
    // Half a revolution: the apocentre.
    let tol = Tol::stated(1e-6, "dense output of order 6 in steps at a tolerance of 1e-12");
    assert_close("time", &[state.time], &[core::f64::consts::PI], tol);
    assert_close("state", &state.values[..1], &[-1.0 - E], tol);
}

/// Heat in a rod of forty intervals, u̇ᵢ = N² (uᵢ₋₁ − 2uᵢ + uᵢ₊₁): rates from 10 to 6400.
#[test]
fn heat_in_a_rod_decays_like_its_eigenfunction() {
    const N: usize = 40;
    let mut rod = DifferenceJacobian::new(field(N - 1, |_t, u: &[f64], rate: &mut [f64]| {
        for i in 0..N - 1 {
            let left = if i == 0 { 0.0 } else { u[i - 1] };
            let right = if i + 2 == N { 0.0 } else { u[i + 1] };
            rate[i] = (N * N) as f64 * (left - 2.0 * u[i] + right);
        }
    }));
    let angle = core::f64::consts::PI / N as f64;
    let start: Vec<f64> = (1..N).map(|i| (angle * i as f64).sin()).collect();
    let decay = (-4.0 * (N * N) as f64 * (0.5 * angle).sin().powi(2) * 0.5).exp();
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let mut state = State::new(0.0, start.clone()).unwrap();
        let mut method = RadauIia::new(Tolerance::relative(tolerance).unwrap());
        let report = method.integrate_to(&mut rod, &mut state, 0.5).unwrap();
        let exact: Vec<f64> = start.iter().map(|u| u * decay).collect();
        assert_close("rod", &state.values, &exact, Tol::stated(10.0, "the solution decays by e⁻⁵").times(tolerance));
        // The problem is linear: differences at the start serve for the whole run.
        assert!(report.jacobians <= 3 && report.run.steps < 60, "{report:?}");
    }
}
