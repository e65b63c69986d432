//! Checkpoints: a continued run is the whole run, to the last bit.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{IntegratorsError, State, Tolerance};
use piola_stiff::{ExactJacobian, RadauCheckpoint, RadauIia, RadauOrder, StiffField};

use super::problems::{Hires, Robertson, SpringPendulum, VanDerPol};

/// Continues a run from the checkpoints of every `stride`th step; how many there were.
fn continue_from_all<F: StiffField<Error = Infallible>>(
    method: &RadauIia,
    system: impl Fn() -> F,
    start: &[f64],
    end: f64,
    stride: u64,
) -> usize {
    let (mut whole, mut kept) = (State::new(0.25, start.to_vec()).unwrap(), Vec::new());
    let report = method
        .clone()
        .integrate(&mut system(), &mut whole, end, |step| {
            if step.number().is_multiple_of(stride) {
                kept.push(step.checkpoint());
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    for checkpoint in &kept {
        let checkpoint = written(checkpoint);
        let mut state = State::new(0.0, Vec::new()).unwrap();
        let again = method
            .clone()
            .resume(&mut system(), &checkpoint, &mut state, end, |_step| ControlFlow::Continue(()))
            .unwrap();
        assert_eq!((&state, again), (&whole, report), "from {}", checkpoint.state().time);
    }
    kept.len()
}

#[cfg(feature = "serde")]
fn written(checkpoint: &RadauCheckpoint) -> RadauCheckpoint {
    let read = serde_json::from_str(&serde_json::to_string(checkpoint).unwrap()).unwrap();
    assert_eq!(checkpoint, &read);
    read
}

#[cfg(not(feature = "serde"))]
fn written(checkpoint: &RadauCheckpoint) -> RadauCheckpoint {
    checkpoint.clone()
}

fn adaptive(tolerance: f64) -> RadauIia {
    RadauIia::new(Tolerance::new(tolerance, 1e-3 * tolerance).unwrap())
}

#[test]
fn continued_runs_are_whole_runs_to_the_last_bit() {
    let mut compared = 0;
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let method = adaptive(tolerance);
        compared += continue_from_all(&method, || ExactJacobian::new(VanDerPol), &[2.0, 0.0], 1.5, 7);
        let hires = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057];
        compared += continue_from_all(&method, || ExactJacobian::new(Hires), &hires, 321.8122, 5);
        compared += continue_from_all(&method, || ExactJacobian::new(Robertson), &[1.0, 0.0, 0.0], 1e4, 5);
    }
    assert!(100 < compared, "{compared}");
}

#[test]
fn equal_steps_go_on_as_they_were() {
    for order in RadauOrder::ALL {
        let method = RadauIia::with_step(order, 0.01).unwrap();
        let compared =
            continue_from_all(&method, || ExactJacobian::new(SpringPendulum), &[1.0, 0.0, 0.0, 0.25], 1.0, 20);
        assert_eq!(compared, 3);
    }
}

#[cfg(feature = "sparse")]
#[test]
fn sparse_runs_go_on_too() {
    use piola_stiff::{SparseJacobian, Sparsity};
    let diffusion = super::large::Diffusion { side: 6, rows: 6 };
    let start = diffusion.start();
    let system = || {
        let sparsity = Sparsity::of_field(&mut { diffusion }, 0.0, &start).unwrap();
        SparseJacobian::new(diffusion, sparsity).unwrap()
    };
    assert!(2 < continue_from_all(&adaptive(1e-6), system, &start, 1.0, 3));
}

#[test]
fn checkpoints_of_other_systems_are_refused() {
    let (mut state, mut kept) = (State::new(0.0, vec![2.0, 0.0]).unwrap(), None);
    let observer = |step: &piola_stiff::RadauIiaStep<'_>| {
        kept = Some(step.checkpoint());
        ControlFlow::Break(())
    };
    adaptive(1e-8).integrate(&mut ExactJacobian::new(VanDerPol), &mut state, 2.0, observer).unwrap();
    let kept = kept.unwrap();
    assert_eq!(kept.report().run.steps, 1);
    let refused = adaptive(1e-8)
        .resume(&mut ExactJacobian::new(Robertson), &kept, &mut state, 2.0, |_| ControlFlow::Continue(()));
    assert!(matches!(refused, Err(IntegratorsError::WrongLength { expected: 3, found: 2, .. })), "{refused:?}");
}

/// Equal steps to another end, or of another length, are other steps.
#[test]
fn equal_steps_to_another_end_are_refused() {
    let (mut state, mut kept) = (State::new(0.0, vec![1.0, 0.0, 0.0, 0.25]).unwrap(), None);
    let method = |step: f64| RadauIia::with_step(RadauOrder::Nine, step).unwrap();
    let observer = |step: &piola_stiff::RadauIiaStep<'_>| {
        if step.number() == 5 {
            kept = Some(step.checkpoint());
        }
        ControlFlow::Continue(())
    };
    method(0.01).integrate(&mut ExactJacobian::new(SpringPendulum), &mut state, 1.0, observer).unwrap();
    let kept = kept.unwrap();
    for (step, end) in [(0.01, 0.055), (0.01, 0.03), (0.02, 1.0)] {
        let mut state = State::new(0.0, Vec::new()).unwrap();
        let mut system = ExactJacobian::new(SpringPendulum);
        let refused = method(step).resume(&mut system, &kept, &mut state, end, |_| ControlFlow::Continue(()));
        assert!(matches!(refused, Err(IntegratorsError::InvalidStep { .. })), "{step} {end}: {refused:?}");
    }
}

/// A checkpoint of an order above those of the method has no room; one whose steps are zero is none.
#[cfg(feature = "serde")]
#[test]
fn changed_checkpoints_are_refused() {
    let (mut state, mut kept) = (State::new(0.0, vec![2.0, 0.0]).unwrap(), None);
    let observer = |step: &piola_stiff::RadauIiaStep<'_>| {
        kept = Some(step.checkpoint());
        ControlFlow::Break(())
    };
    let method = || adaptive(1e-4).with_orders(RadauOrder::Five, RadauOrder::Five);
    method().integrate(&mut ExactJacobian::new(VanDerPol), &mut state, 2.0, observer).unwrap();
    let written = serde_json::to_value(kept.unwrap()).unwrap();
    let resume = |value: serde_json::Value| {
        let checkpoint: RadauCheckpoint = serde_json::from_value(value).unwrap();
        let mut state = State::new(0.0, Vec::new()).unwrap();
        method().resume(&mut ExactJacobian::new(VanDerPol), &checkpoint, &mut state, 2.0, |_| ControlFlow::Continue(()))
    };
    assert!(resume(written.clone()).is_ok());
    let mut higher = written.clone();
    higher["memory"]["last"][0] = "Thirteen".into();
    assert!(matches!(resume(higher), Err(IntegratorsError::WrongLength { quantity: "checkpoint.stages", .. })));
    let mut still = written;
    still["memory"]["last"][1] = 0.0.into();
    assert!(matches!(resume(still), Err(IntegratorsError::NotPositive { quantity: "checkpoint.numbers", .. })));
}
