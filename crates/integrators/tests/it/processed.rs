//! The processed splitting: its conditions, its order, what it keeps, checkpoints, failures.

use core::ops::ControlFlow;

use piola_integrators::{IntegratorsError, ProcessedSplitting, Report, State, separable};
use piola_testkit::{allocations_in, assert_order, relative_error};

use crate::continuing::{assert_refused, elsewhere, growing, until, written_and_read};
use crate::problems::{FIGURE_EIGHT, kepler, kepler_at, three_bodies};
use crate::splittings::assert_conditions;

fn start(e: f64) -> State {
    State::new(0.0, kepler_at(e, 0.0).to_vec()).unwrap()
}

fn method(step: f64) -> ProcessedSplitting {
    ProcessedSplitting::new(step).unwrap()
}

/// Processor, kernel and inverse processor as one splitting, whose steps are not symmetric.
#[test]
fn the_processed_splitting_obeys_all_conditions() {
    assert_conditions("processed", ProcessedSplitting::<f64>::stages().into_iter().flatten(), 6, 2e-15);
}

/// Over two decades and more, within a tenth: the phase of an oscillator, and a force with a time, which the processor too must meet at
/// its moment.
#[test]
fn errors_fall_with_the_sixth_power() {
    let mut oscillator = separable(1, |_t, q: &[f64], force: &mut [f64]| force[0] = -q[0]);
    let steps = [400, 500, 640, 800, 1000].map(|count: u32| 100.0 / f64::from(count));
    let errors = steps.map(|h| {
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        method(h).integrate_to(&mut oscillator, &mut state, 100.0).unwrap();
        (state.values[0] - 100.0_f64.cos()).hypot(state.values[1] + 100.0_f64.sin())
    });
    assert!(100.0 * errors[4] < errors[0], "{errors:?}");
    assert_order("oscillator", &steps, &errors, 6.0, 0.1);
    // q̈ = −q + cos 2t: q = cos t + (cos t − cos 2t)/3 from q = 1, q̇ = 0.
    let mut driven = separable(1, |t: f64, q: &[f64], force: &mut [f64]| force[0] = -q[0] + (2.0 * t).cos());
    let ((s1, c1), (s2, c2)) = (6.0_f64.sin_cos(), 12.0_f64.sin_cos());
    let exact = [c1 + (c1 - c2) / 3.0, -s1 + (2.0 * s2 - s1) / 3.0];
    let steps = [60, 80, 100, 120, 150].map(|count: u32| 6.0 / f64::from(count));
    let errors = steps.map(|h| {
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        method(h).integrate_to(&mut driven, &mut state, 6.0).unwrap();
        (state.values[0] - exact[0]).abs().max((state.values[1] - exact[1]).abs())
    });
    assert!(100.0 * errors[4] < errors[0], "{errors:?}");
    assert_order("driven", &steps, &errors, 6.0, 0.1);
}

/// On an ellipse, where all conditions count; the eighth power, of the other sign, is not small yet.
#[test]
fn errors_on_an_ellipse_fall_with_the_sixth_power() {
    let steps = [125, 160, 200, 250].map(|count: u32| 5.0 / f64::from(count));
    let errors = steps.map(|h| {
        let mut state = start(0.3);
        method(h).integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
        relative_error(&state.values, &kepler_at(0.3, 5.0))
    });
    assert_order("ellipse", &steps, &errors, 6.0, 0.5);
}

/// What is shown does not change the run, and costs the processor's eleven forces.
#[test]
fn shown_states_are_those_of_runs_that_end_there() {
    let (mut seen, mut state) = (Vec::new(), start(0.3));
    let report = method(0.125)
        .integrate(&mut kepler(), &mut state, 10.0, 8, |step| {
            seen.push((step.number, step.values.to_vec()));
            ControlFlow::Continue(())
        })
        .unwrap();
    // One force begins the kernel's first step, and eleven each go to the start and to ten states.
    assert_eq!((report.steps, report.evaluations, seen.len()), (80, 80 * 7 + 1 + 11 + 10 * 11, 10));
    for (number, values) in &seen {
        let mut other = start(0.3);
        method(0.125).integrate_to(&mut kepler(), &mut other, 0.125 * *number as f64).unwrap();
        assert_eq!(&other.values, values, "{number}");
    }
}

#[test]
fn energy_does_not_drift_and_angular_momentum_is_kept() {
    let energy = |y: &[f64]| 0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / y[0].hypot(y[1]);
    let momentum = |y: &[f64]| y[0] * y[3] - y[1] * y[2];
    let mut state = start(0.3);
    let (before, spin) = (energy(&state.values), momentum(&state.values));
    let (mut first, mut last) = (0.0_f64, 0.0_f64);
    method(0.125)
        .integrate(&mut kepler(), &mut state, 6000.0, 5, |step| {
            let error = (energy(step.values) - before).abs();
            let worst = if step.time < 600.0 { &mut first } else { &mut last };
            *worst = worst.max(error);
            assert!((momentum(step.values) - spin).abs() < 1e-13);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(0.0 < first && last < 1.05 * first, "{first:e}, {last:e}");
}

#[test]
fn a_run_continued_from_a_checkpoint_is_the_whole_run() {
    let mut whole = start(0.2);
    let steps =
        method(0.07).integrate(&mut growing(), &mut whole, 7.0, 1, |_| ControlFlow::Continue(())).unwrap().steps;
    for stop in [1, 2, 40, steps - 1] {
        let (mut state, mut stopping) = (start(0.2), method(0.07));
        let stopped = stopping.integrate(&mut growing(), &mut state, 7.0, 1, until(stop)).unwrap();
        let kept = written_and_read(&stopping.checkpoint(&state, stopped));
        let mut continued = elsewhere(4);
        let refused =
            method(0.07).resume(&mut growing(), &kept, &mut continued, f64::NAN, 1, |_step| ControlFlow::Continue(()));
        assert_refused(&refused, &continued);
        let report = method(0.07)
            .resume(&mut growing(), &kept, &mut continued, 7.0, 1, |_step| ControlFlow::Continue(()))
            .unwrap();
        assert_eq!((&continued, report.steps), (&whole, steps), "{stop}");
    }
    let mut state = start(0.2);
    let unused = method(0.07).checkpoint(&state, Report::begin());
    let run = method(0.07).resume(&mut growing(), &unused, &mut state, 7.0, 1, |_step| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::WrongLength { quantity: "checkpoint.memory", expected: 8, found: 0 }));
    assert_eq!(state, start(0.2));
}

/// The kernel's coordinates depend on the length of the step: where another end changes it, the run is that from the shown state.
#[test]
fn a_run_continued_to_another_end_is_one_from_the_shown_state() {
    let (mut state, mut stopping) = (start(0.2), method(0.07));
    let stopped = stopping.integrate(&mut growing(), &mut state, 7.0, 1, until(40)).unwrap();
    let kept = written_and_read(&stopping.checkpoint(&state, stopped));
    for end in [3.0, 6.0, 9.0, 2.0] {
        let (mut continued, mut anew) = (elsewhere(4), state.clone());
        let report = method(0.07)
            .resume(&mut growing(), &kept, &mut continued, end, 0, |_step| ControlFlow::Continue(()))
            .unwrap();
        let other = method(0.07).integrate_to(&mut growing(), &mut anew, end).unwrap();
        assert_eq!((&continued, report), (&anew, stopped.then(other)), "to {end}");
    }
}

/// A processor that fails where the run ends: the kernel is ahead of the state, and nothing can be continued.
#[test]
fn a_checkpoint_after_the_processor_has_failed_is_empty() {
    let mut forces = 0;
    let mut failing = separable(1, |_t, q: &[f64], force: &mut [f64]| {
        // Eleven of the processor, three steps of seven, and one that begins the first.
        force[0] = if forces < 11 + 3 * 7 + 1 { -q[0] } else { f64::NAN };
        forces += 1;
    });
    let (mut state, mut method) = (State::new(0.0, vec![1.0, 0.0]).unwrap(), method(0.125));
    let error = method.integrate_to(&mut failing, &mut state, 0.375).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", .. }), "{error:?}");
    assert_eq!(state, State::new(0.0, vec![1.0, 0.0]).unwrap());
    let kept = method.checkpoint(&state, Report::begin());
    let run = method.resume(&mut failing, &kept, &mut state, 0.375, 0, |_step| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::WrongLength { quantity: "checkpoint.memory", expected: 4, found: 0 }));
}

#[test]
fn a_failed_run_leaves_the_last_complete_step() {
    let mut bounded =
        separable(1, |t: f64, _q: &[f64], force: &mut [f64]| force[0] = if t < 1.0 { 0.0 } else { f64::NAN });
    let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
    let error =
        method(0.125).integrate(&mut bounded, &mut state, 3.0, 1, |_step| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 0, t: Some(_), .. }), "{error:?}");
    assert!(0.5 < state.time && state.time < 1.0 && (state.values[0] - state.time).abs() < 1e-15, "{state:?}");
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(ProcessedSplitting::<f64>::new(step), Err(IntegratorsError::InvalidStep { .. })), "{step}");
    }
}

#[test]
fn steps_allocate_nothing() {
    let mut method = method(0.01);
    let mut state = State::new(0.0, FIGURE_EIGHT.to_vec()).unwrap();
    let [few, many] = [0.1, 2.1].map(|span| {
        let end = state.time + span;
        allocations_in(|| method.integrate_to(&mut three_bodies(), &mut state, end).unwrap()).0
    });
    // A run makes room for its states; the first one for the method's too.
    assert!(many <= few && many < 10, "{few}, {many}");
}
