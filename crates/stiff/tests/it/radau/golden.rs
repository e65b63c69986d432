//! Stiff problems with published ends.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{Field, State, Tolerance};
use piola_stiff::{Differentiable, ExactJacobian, RadauIia, RadauOrder, RadauReport};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, assert_each_close};

use crate::problems::{kepler, kepler_at};

use super::problems::{Hires, Oregonator, Robertson, SpringPendulum, VanDerPol};

struct Case {
    start: Vec<f64>,
    end: f64,
    values: Vec<f64>,
}

fn case(name: &str) -> Case {
    let golden = golden::load("stiff");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    Case { start: vector(&case["start"]), end: number(&case["end"]), values: vector(&case["values"]) }
}

fn run<F>(field: F, case: &Case, mut method: RadauIia) -> (Vec<f64>, RadauReport)
where
    F: Field<Error = Infallible> + Field<Differentiable, Error = Infallible>,
{
    let mut state = State::new(0.0, case.start.clone()).unwrap();
    let report = method.integrate_to(&mut ExactJacobian::new(field), &mut state, case.end).unwrap();
    assert_eq!(state.time.to_bits(), case.end.to_bits());
    (state.values, report)
}

fn method(relative: f64, absolute: f64) -> RadauIia {
    RadauIia::new(Tolerance::new(relative, absolute * relative).unwrap())
}

/// The error of each component at the end is within `factor` of the tolerance, with each order and with the order left to
/// the method; at most so many steps are taken at 1e-6.
fn check<F>(name: &str, field: F, absolute: f64, factor: f64, most_steps: u64)
where
    F: Field<Error = Infallible> + Field<Differentiable, Error = Infallible> + Copy,
{
    let case = case(name);
    let factor = Tol::stated(factor, "the sensitivity of the end of the run to errors before");
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13] {
        let (values, report) = run(field, &case, method(tolerance, absolute));
        assert_each_close(&format!("{name} at {tolerance:e}"), &values, &case.values, factor.times(tolerance));
        let counts = tolerance.to_bits() == 1e-6_f64.to_bits();
        assert!(!counts || report.run.steps <= most_steps, "{tolerance:e}: {report:?}");
    }
    for order in [RadauOrder::Five, RadauOrder::Nine] {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let (values, _) = run(field, &case, method(tolerance, absolute).with_orders(order, order));
            assert_each_close(&format!("{name}, {order:?}"), &values, &case.values, factor.times(tolerance));
        }
    }
}

#[test]
fn van_der_pol_ends_where_published() {
    check("van der Pol", VanDerPol, 1e-3, 5.0, 180);
}

#[test]
fn robertson_ends_where_published() {
    check("Robertson", Robertson, 1e-8, 2.0, 105);
    check("Robertson to 40", Robertson, 1e-8, 10.0, 40);
}

#[test]
fn hires_ends_where_published() {
    // The run ends in a fast change at the end of a long quiet: in a step whose error no later step damps.
    check("HIRES", Hires, 1e-4, 20.0, 45);
}

/// Concentrations that follow others within far less than a step have the order of the error estimate, and no later step
/// damps the error at the end of the run.
#[test]
fn every_step_of_hires_keeps_the_tolerance() {
    let case = case("HIRES");
    for tolerance in [1e-6, 1e-9] {
        let (mut state, mut steps) = (State::new(0.0, case.start.clone()).unwrap(), 0);
        method(tolerance, 1e-4)
            .integrate(&mut ExactJacobian::new(Hires), &mut state, case.end, |step| {
                let mut exact = State::new(step.start(), step.start_values().to_vec()).unwrap();
                method(1e-13, 1e-4).integrate_to(&mut ExactJacobian::new(Hires), &mut exact, step.time()).unwrap();
                // The scarcest concentrations rise from zero at first.
                if 1.0 < step.start() {
                    let tol = Tol::stated(20.0, "eight components share one norm").times(tolerance);
                    assert_each_close("step", step.values(), &exact.values, tol);
                    steps += 1;
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        assert!(15 < steps);
    }
}

#[test]
fn oregonator_ends_where_published() {
    check("Oregonator", Oregonator, 1e-6, 100.0, 235);
}

#[test]
fn stiff_spring_pendulum_ends_at_the_reference() {
    check("spring pendulum", SpringPendulum, 0.0, 100.0, 220);
}

#[test]
fn concentrations_keep_their_sum() {
    let case = case("Robertson");
    let (values, _) = run(Robertson, &case, method(1e-4, 1e-8));
    assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-14, "{values:?}");
}

#[test]
fn estimate_of_a_second_run_tells_the_error() {
    let case = case("Oregonator");
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let mut state = State::new(0.0, case.start.clone()).unwrap();
        let estimate = method(tolerance, 1e-6)
            .integrate_and_estimate(&mut ExactJacobian::new(Oregonator), &mut state, case.end)
            .unwrap();
        for ((error, y), exact) in estimate.errors.iter().zip(&state.values).zip(&case.values) {
            let ratio = error / (y - exact).abs();
            assert!(0.3 < ratio && ratio < 3.0, "{tolerance:e}: {ratio}");
        }
        assert!(estimate.run.evaluations < estimate.finer_run.evaluations);
    }
    // With a fixed step, by half of it.
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let mut method = RadauIia::with_step(RadauOrder::Five, 0.05).unwrap();
    let estimate = method.integrate_and_estimate(&mut ExactJacobian::new(kepler()), &mut state, 1.0).unwrap();
    assert_eq!((estimate.run.steps, estimate.finer_run.steps), (20, 40));
    // The finer run has a 32nd of the error.
    let ratio = estimate.errors[0] / (state.values[0] - kepler_at(0.3, 1.0)[0]).abs();
    assert!(0.9 < ratio && ratio < 1.0, "{ratio}");
}
