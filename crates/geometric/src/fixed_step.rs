//! The loop of methods with a fixed step.

use core::ops::ControlFlow;

use piola_integrators::{Ending, IntegratorsError, Report, State, Step};
use piola_numerics::Real;

/// Takes equal steps no longer than `step` to `end`, from a state that has been checked, in a run whose steps so far are in the report
/// `before`. `advance` makes one step of the given length on the state's values, leaves them alone where it fails, and returns the number
/// of evaluations.
pub(crate) fn take_equal_steps<T: Real, E>(
    (before, step): (Report, f64),
    state: &mut State<T>,
    end: f64,
    mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    mut advance: impl FnMut(&mut State<T>, f64) -> Result<u64, IntegratorsError<E>>,
) -> Result<Report, IntegratorsError<E>> {
    let (steps, taken) = state.begin_equal_steps(end, step)?;
    let mut report = before;
    for number in taken + 1..=steps.count {
        report.evaluations += advance(state, steps.length)?;
        state.set_time(steps.time(number));
        report.steps += 1;
        if observer(Step { number: report.steps, time: state.time, values: &state.values }).is_break() {
            report.ending = Ending::Stopped;
            break;
        }
    }
    Ok(report)
}
