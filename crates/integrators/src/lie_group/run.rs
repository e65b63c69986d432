//! What runs on groups share: the start, equal steps, a trial that the state becomes when it is complete.

use core::ops::ControlFlow;

use piola_numerics::Real;

use super::{GroupField, LieGroup};
use crate::state::{check_finite, check_run, equal_steps};
use crate::{Ending, IntegratorsError, Report, State, Step};

/// An element with its carry while a step is made.
#[derive(Clone, Debug)]
pub(super) struct Trial<T> {
    pub(super) element: Vec<T>,
    pub(super) carry: Vec<T>,
}

impl<T: Real> Trial<T> {
    pub(super) const fn new() -> Self {
        Self { element: Vec::new(), carry: Vec::new() }
    }

    pub(super) fn resize(&mut self, length: usize) {
        self.element.resize(length, T::zero());
        self.carry.resize(length, T::zero());
    }

    /// Begins at the state.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn begin(&mut self, state: &State<T>) {
        self.element.copy_from_slice(&state.values);
        self.carry.copy_from_slice(&state.carry);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn advance(&mut self, group: &impl LieGroup<T>, displacement: &[T]) {
        group.advance(&mut self.element, &mut self.carry, displacement);
    }

    /// Ends a step: the element is renormalised and becomes the state.
    pub(super) fn accept<E>(
        &mut self,
        group: &impl LieGroup<T>,
        state: &mut State<T>,
    ) -> Result<(), IntegratorsError<E>> {
        self.renormalise(group);
        self.replace(state)
    }

    pub(super) fn renormalise(&mut self, group: &impl LieGroup<T>) {
        group.renormalise(&mut self.element, &mut self.carry);
    }

    /// Becomes the state if it is finite.
    pub(super) fn replace<E>(&mut self, state: &mut State<T>) -> Result<(), IntegratorsError<E>> {
        check_finite("state", Some(state.time), &self.element)?;
        self.swap(state);
        Ok(())
    }

    /// Becomes the state, which it keeps.
    pub(super) fn swap(&mut self, state: &mut State<T>) {
        core::mem::swap(&mut self.element, &mut state.values);
        core::mem::swap(&mut self.carry, &mut state.carry);
    }
}

/// The velocity of the field, which must be finite. `start` is the time at the start of the step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn evaluate<T: Real, F: GroupField<T>>(
    field: &mut F,
    start: f64,
    t: f64,
    element: &[T],
    velocity: &mut [T],
) -> Result<(), IntegratorsError<F::Error>> {
    field.velocity(t, element, velocity).map_err(|source| IntegratorsError::Field { t, source })?;
    check_finite("rate", Some(start), velocity)
}

/// Refuses a state that does not fit, is not finite or does not begin with an element of the group; `others` numbers follow it.
pub(super) fn check_start<T: Real, E>(
    group: &impl LieGroup<T>,
    others: usize,
    state: &mut State<T>,
    end: f64,
) -> Result<(), IntegratorsError<E>> {
    let length = group.element_length();
    check_run(length + others, state, end)?;
    match group.defect(&state.values[..length]) {
        None => Ok(()),
        Some((index, defect)) => Err(IntegratorsError::OutsideGroup { index, defect }),
    }
}

/// Makes equal steps no longer than `longest` from the state to `end`. `make` moves the state and returns its evaluations; where
/// it fails it leaves the state as it was.
pub(super) fn make_equal_steps<T: Real, E>(
    state: &mut State<T>,
    end: f64,
    longest: f64,
    mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    mut make: impl FnMut(&mut State<T>, f64) -> Result<u64, IntegratorsError<E>>,
) -> Result<Report, IntegratorsError<E>> {
    let start = state.time;
    let (steps, h) = equal_steps(start, end, longest)?;
    let mut report = Report::begin();
    for number in 1..=steps {
        report.evaluations += make(state, h)?;
        state.set_time(if number == steps { end } else { start + h * number as f64 });
        report.steps = number;
        if observer(Step { number, time: state.time, values: &state.values }).is_break() {
            report.ending = Ending::Stopped;
            break;
        }
    }
    Ok(report)
}
