//! Runs of equal steps that are written down and continued.

use piola_integrators::internal::equal_steps;
use piola_integrators::{Checkpoint, IntegratorsError, Report, State};
use piola_numerics::Real;

use crate::Gravitation;
use crate::wisdom_holman::check;
use crate::wisdom_holman::run::{Course, EqualSteps, Failure};

/// The numbers that all maps keep: when the steps began, their length, how many are made, and whether the memory continues them.
pub(crate) const OF_STEPS: usize = 4;

/// A checkpoint after `report.steps` of the steps; without a memory the run begins anew from the state.
pub(crate) fn checkpoint<T: Real>(
    method: &'static str,
    steps: &EqualSteps,
    state: &State<T>,
    report: Report,
    memory: Option<Vec<T>>,
    length: usize,
    others: &[f64],
) -> Checkpoint<T> {
    let made = (report.steps - steps.before) as f64;
    let of_steps = [steps.start, steps.length, made, f64::from(u8::from(memory.is_some()))];
    let memory = memory.unwrap_or_else(|| vec![T::zero(); length]);
    Checkpoint::of(method, state.clone(), report, memory, [&of_steps[..], others].concat())
}

/// The steps of a run that goes on to `end`, and its memory if they are those of the checkpoint. The state becomes that of the checkpoint.
pub(crate) fn open<'a, T: Real>(
    checkpoint: &'a Checkpoint<T>,
    method: &'static str,
    [memory, others]: [usize; 2],
    course: Course,
    bodies: &Gravitation,
    state: &mut State<T>,
    end: f64,
) -> Result<(EqualSteps, Option<&'a [T]>), Failure> {
    checkpoint.open(method, [memory, OF_STEPS + others], &[], state, |state| {
        let t = state.time;
        check(bodies, &state.values).map_err(|source| IntegratorsError::Field { t, source })
    })?;
    let (memory, numbers) = checkpoint.memory();
    let report = checkpoint.report();
    let [start, length, made, continues] = [numbers[0], numbers[1], numbers[2], numbers[3]];
    if 0.0 < continues
        && end.is_finite()
        && let Ok((count, h)) = equal_steps::<core::convert::Infallible>(start, end, course.step)
        && h.to_bits() == length.to_bits()
        && made < count as f64
    {
        let before = report.steps.saturating_sub(whole(made));
        return Ok((EqualSteps { start, end, count: before + count, length, before }, Some(memory)));
    }
    let steps = course.begin(bodies, state, end)?;
    let before = report.steps;
    Ok((EqualSteps { count: before + steps.count, before, ..steps }, None))
}

/// The whole number that a count of steps was.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count; what is none saturates")]
pub(crate) fn whole(count: f64) -> u64 {
    count as u64
}

/// The next N numbers.
pub(crate) fn take<T: Copy, const N: usize>(rest: &mut &[T]) -> Option<[T; N]> {
    let (first, others) = rest.split_first_chunk::<N>()?;
    *rest = others;
    Some(*first)
}
