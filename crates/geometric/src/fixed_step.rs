//! The loop of methods with a fixed step.

use core::ops::ControlFlow;

use piola_integrators::internal::check_run;
use piola_integrators::{Ending, IntegratorsError, Report, State, Step};
use piola_numerics::Real;

/// Takes equal steps no longer than `step` to `end`. `advance` makes one step of the given length on the state's values,
/// leaves them alone where it fails, and returns the number of evaluations.
pub(crate) fn take_equal_steps<T: Real, E>(
    dimension: usize,
    step: f64,
    state: &mut State<T>,
    end: f64,
    observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    advance: impl FnMut(&mut State<T>, f64) -> Result<u64, IntegratorsError<E>>,
) -> Result<Report, IntegratorsError<E>> {
    check_run(dimension, state, end)?;
    take_checked_steps(step, state, end, observer, advance)
}

/// The same from a state that has been checked.
pub(crate) fn take_checked_steps<T: Real, E>(
    step: f64,
    state: &mut State<T>,
    end: f64,
    mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    mut advance: impl FnMut(&mut State<T>, f64) -> Result<u64, IntegratorsError<E>>,
) -> Result<Report, IntegratorsError<E>> {
    let (steps, taken) = state.begin_equal_steps(end, step)?;
    let mut report = Report::begin();
    for number in 1..=steps.count - taken {
        report.evaluations += advance(state, steps.length)?;
        state.set_time(steps.time(taken + number));
        report.steps = number;
        if observer(Step { number, time: state.time, values: &state.values }).is_break() {
            report.ending = Ending::Stopped;
            break;
        }
    }
    Ok(report)
}
