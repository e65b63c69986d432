//! Runs: repeatable, continued, backwards, from rest; Jacobians of all kinds; no allocation.

use core::cell::Cell;
use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{Ending, Field, State, Tolerance, field};
use piola_numerics::Real;
use piola_stiff::{DifferenceJacobian, ExactJacobian, GivenJacobian, RadauIia, RadauOrder, RadauReport, StiffField};
use piola_testkit::{Tol, allocations_in, assert_close};

use super::problems::{Hires, VanDerPol};
use crate::problems::{kepler, kepler_at};

fn method(tolerance: f64) -> RadauIia {
    RadauIia::new(Tolerance::new(tolerance, 1e-3 * tolerance).unwrap())
}

fn van_der_pol(system: &mut impl StiffField<Error = Infallible>, tolerance: f64) -> (State, RadauReport) {
    let mut state = State::new(0.0, vec![2.0, 0.0]).unwrap();
    let report = method(tolerance).integrate_to(system, &mut state, 2.0).unwrap();
    (state, report)
}

#[test]
fn runs_repeat_to_the_last_bit() {
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let [one, other] = [(); 2].map(|()| van_der_pol(&mut ExactJacobian::new(VanDerPol), tolerance));
        assert_eq!(one, other);
    }
    // Also by a method that has made another run before.
    let mut used = method(1e-8);
    let mut hires = vec![0.0; 8];
    (hires[0], hires[7]) = (1.0, 0.0057);
    used.integrate_to(&mut ExactJacobian::new(Hires), &mut State::new(0.0, hires).unwrap(), 1.0).unwrap();
    let mut state = State::new(0.0, vec![2.0, 0.0]).unwrap();
    let report = used.integrate_to(&mut ExactJacobian::new(VanDerPol), &mut state, 2.0).unwrap();
    assert_eq!((state, report), van_der_pol(&mut ExactJacobian::new(VanDerPol), 1e-8));
}

#[test]
fn jacobians_of_all_kinds_lead_to_one_end() {
    let rate = |_t: f64, y: &[f64], rate: &mut [f64]| VanDerPol.rate(0.0, y, rate).unwrap_or_default();
    let plain = || field(2, rate).componentwise();
    let (exact, exact_report) = van_der_pol(&mut ExactJacobian::new(VanDerPol), 1e-8);
    let mut given = GivenJacobian::new(plain(), |_t, y: &[f64], jacobian: &mut [f64]| {
        (jacobian[1], jacobian[2], jacobian[3]) = ((-2.0 * y[0] * y[1] - 1.0) * 1e6, 1.0, (1.0 - y[0] * y[0]) * 1e6);
    });
    let (given, given_report) = van_der_pol(&mut given, 1e-8);
    let (differences, difference_report) = van_der_pol(&mut DifferenceJacobian::new(plain()), 1e-8);
    let tol = Tol::stated(1e-8, "tolerance 1e-8");
    assert_close("given", &given.values, &exact.values, tol);
    assert_close("differences", &differences.values, &exact.values, tol);
    // The inexact Jacobian costs few steps, if any.
    assert!(given_report.run.steps.abs_diff(exact_report.run.steps) < 20, "{given_report:?}");
    assert!(difference_report.run.evaluations < 2 * exact_report.run.evaluations, "{difference_report:?}");
}

/// Those for Jacobians apart; also where steps are rejected, and their errors estimated once more.
#[test]
fn evaluations_reported_are_the_calls_of_the_field() {
    let mut rejected = 0;
    for tolerance in [1e-2, 1e-4, 1e-6, 1e-8] {
        let calls = Cell::new(0);
        let counted = field(2, |_t: f64, y: &[f64], rate: &mut [f64]| {
            calls.set(calls.get() + 1);
            VanDerPol.rate(0.0, y, rate).expect("a field without refusals");
        });
        let mut given = GivenJacobian::new(counted, |_t, y: &[f64], jacobian: &mut [f64]| {
            (jacobian[0], jacobian[1]) = (0.0, (-2.0 * y[0] * y[1] - 1.0) * 1e6);
            (jacobian[2], jacobian[3]) = (1.0, (1.0 - y[0] * y[0]) * 1e6);
        });
        let report = van_der_pol(&mut given, tolerance).1;
        assert_eq!(report.run.evaluations, calls.get(), "{report:?}");
        rejected += report.run.rejected;
    }
    assert!(0 < rejected);
}

#[test]
fn exact_jacobian_of_many_components_equals_differences() {
    // Eight components, in two passes of four directions.
    let y = [0.5, 0.2, 0.1, 0.3, 0.4, 0.6, 0.7, 0.8];
    let (mut exact, mut differences) = ([0.0; 64], [0.0; 64]);
    ExactJacobian::new(Hires).jacobian(0.0, &y, &mut exact).unwrap();
    DifferenceJacobian::new(Hires).jacobian(0.0, &y, &mut differences).unwrap();
    assert_close("Jacobian", &differences, &exact, Tol::stated(1e-7, "differences over the root of rounding"));
    // Down the columns: ∂f₆/∂y₈ = −280 y₆.
    assert_close("entry", &[exact[5 + 7 * 8]], &[-280.0 * 0.6], Tol::ulps(2.0));
}

#[test]
fn backward_run_returns_to_the_start() {
    let start = kepler_at(0.5, 0.0);
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut method = RadauIia::new(Tolerance::relative(1e-12).unwrap());
    method.integrate_to(&mut ExactJacobian::new(kepler()), &mut state, 5.0).unwrap();
    let report = method.integrate_to(&mut ExactJacobian::new(kepler()), &mut state, 0.0).unwrap();
    assert_eq!(state.time.to_bits(), 0.0_f64.to_bits());
    assert!(10 < report.run.steps);
    assert_close("start", &state.values, &start, Tol::stated(1e-9, "tolerance 1e-12 times the sensitivity"));
}

#[test]
fn run_of_zero_length_changes_nothing() {
    let start = State::new(2.0, kepler_at(0.3, 2.0).to_vec()).unwrap();
    let mut state = start.clone();
    let report = method(1e-9).integrate_to(&mut ExactJacobian::new(kepler()), &mut state, 2.0).unwrap();
    assert_eq!((report.run.steps, report.run.evaluations, report.jacobians, report.factorisations), (0, 0, 0, 0));
    assert_eq!(state, start);
}

#[test]
fn drive_from_the_zero_state_equals_the_integral() {
    // y = 0 has no magnitude; a purely relative tolerance must still start.
    let mut driven = DifferenceJacobian::new(field(1, |t: f64, _y: &[f64], rate: &mut [f64]| rate[0] = t.cos()));
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    RadauIia::new(Tolerance::relative(1e-12).unwrap()).integrate_to(&mut driven, &mut state, 2.0).unwrap();
    assert_close("sine", &state.values, &[2.0_f64.sin()], Tol::stated(1e-11, "tolerance 1e-12"));
}

#[test]
fn equilibrium_stays_to_the_last_bit() {
    let mut pendulum = DifferenceJacobian::new(field(2, |_t, y: &[f64], rate: &mut [f64]| {
        rate.copy_from_slice(&[y[1], -y[0].sin()]);
    }));
    let start = State::new(0.0, vec![0.0; 2]).unwrap();
    let mut state = start.clone();
    RadauIia::new(Tolerance::relative(1e-9).unwrap()).integrate_to(&mut pendulum, &mut state, 100.0).unwrap();
    assert_eq!(state.values, start.values);
}

#[test]
fn steps_follow_the_unit_of_time() {
    // The same motion in seconds and in microseconds takes the same steps.
    let counts = [1.0, 1e-6].map(|second: f64| {
        let rate = 1.0 / second;
        let mut oscillator = DifferenceJacobian::new(field(2, move |_t, y: &[f64], out: &mut [f64]| {
            out.copy_from_slice(&[rate * y[1], -rate * y[0]]);
        }));
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        method(1e-10).integrate_to(&mut oscillator, &mut state, 20.0 * second).unwrap().run.steps
    });
    assert!(counts[0].abs_diff(counts[1]) <= 1, "{counts:?}");
}

#[test]
fn observers_stop_runs_and_see_the_order() {
    let mut orders = Vec::new();
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let report = RadauIia::new(Tolerance::relative(1e-13).unwrap())
        .integrate(&mut ExactJacobian::new(kepler()), &mut state, 100.0, |step| {
            orders.push(step.order());
            assert_eq!(step.number(), orders.len() as u64);
            if orders.len() == 30 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
    assert_eq!((report.run.steps, report.run.ending), (30, Ending::Stopped));
    assert_eq!((orders[0], orders[29]), (RadauOrder::Nine, RadauOrder::Thirteen), "{orders:?}");
}

/// ẏ = −50 (y − cos t) at a fixed step keeps one Jacobian and one factorisation.
#[test]
fn linear_problem_keeps_jacobian_and_factors() {
    let mut linear = GivenJacobian::new(
        field(1, |t: f64, y: &[f64], rate: &mut [f64]| rate[0] = -50.0 * (y[0] - t.cos())),
        |_t, _y: &[f64], jacobian: &mut [f64]| jacobian[0] = -50.0,
    );
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let mut method = RadauIia::with_step(RadauOrder::Five, 0.125).unwrap();
    let report = method.integrate_to(&mut linear, &mut state, 100.0).unwrap();
    assert_eq!((report.run.steps, report.jacobians, report.factorisations), (800, 1, 1));
}

#[test]
fn runs_of_ten_and_of_ten_thousand_steps_allocate_alike() {
    for order in RadauOrder::ALL {
        let counts = [10_u32, 10_000].map(|steps| {
            let (count, taken) = allocations_in(|| {
                let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
                let mut method = RadauIia::with_step(order, 1.0 / 64.0).unwrap();
                method
                    .integrate(&mut ExactJacobian::new(kepler()), &mut state, f64::from(steps) / 64.0, |step| {
                        let mut y = [0.0; 4];
                        assert!(step.at(0.5 * (step.start() + step.time()), &mut y).is_ok());
                        ControlFlow::Continue(())
                    })
                    .unwrap()
                    .run
                    .steps
            });
            assert_eq!(taken, u64::from(steps));
            count
        });
        assert_eq!(counts[0], counts[1]);
    }
}

#[test]
fn second_run_of_an_adaptive_method_allocates_nothing() {
    let mut method = method(1e-12);
    let mut system = ExactJacobian::new(VanDerPol);
    let mut round = || {
        let mut state = State::new(0.0, vec![2.0, 0.0]).unwrap();
        method.integrate_to(&mut system, &mut state, 2.0).unwrap().run.steps
    };
    // The state's two vectors.
    let (first, _) = allocations_in(&mut round);
    let (second, steps) = allocations_in(&mut round);
    assert!(100 < steps);
    assert_eq!(second, 2);
    assert!(second < first);
}

/// Numbers with derivatives are carried through [`Real`]'s functions.
#[test]
fn exact_jacobian_of_a_pendulum_has_the_cosine() {
    struct Pendulum;
    impl<T: Real> Field<T> for Pendulum {
        type Error = Infallible;
        fn dimension(&self) -> usize {
            2
        }
        fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
            (rate[0], rate[1]) = (y[1], -y[0].sin());
            Ok(())
        }
    }
    let mut jacobian = [0.0; 4];
    ExactJacobian::new(Pendulum).jacobian(0.0, &[0.5, 0.0], &mut jacobian).unwrap();
    assert_close("Jacobian", &jacobian, &[0.0, -(0.5_f64.cos()), 1.0, 0.0], Tol::ulps(1.0));
}
