//! What runs on groups share: the start, equal steps, a trial that the state becomes when it is complete.

use piola_integrators::internal::{check_finite, check_run};
use piola_integrators::{IntegratorsError, State};
use piola_numerics::Real;

use super::{GroupField, LieGroup};

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
