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

/// The runs of a method of equal steps on a group, which has `stages`, `displacement`, `trial`, `step` and `advance`.
macro_rules! equal_steps_on_a_group {
    () => {
        unobserved_run!(F: GroupField<T>, field: &mut F, IntegratorsError<F::Error>);

        /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than the
        /// state's time. The observer sees every step and may stop the run.
        ///
        /// # Errors
        /// The state does not fit, is not finite or is no element of the group; the step is too small to advance the time; the
        /// field fails or gives a velocity that is not finite. The state then stands at the last complete step.
        pub fn integrate<F: GroupField<T>>(
            &mut self,
            field: &mut F,
            state: &mut State<T>,
            end: f64,
            observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
        ) -> Result<Report, IntegratorsError<F::Error>> {
            check_start(field.group(), 0, state, end)?;
            let dimension = field.group().dimension();
            for vector in self.stages.iter_mut().chain([&mut self.displacement]) {
                vector.resize(dimension, T::zero());
            }
            self.trial.resize(state.values.len());
            take_equal_steps((Report::begin(), self.step), state, end, observer, |state, h| self.advance(field, state, h))
        }
    };
}
pub(super) use equal_steps_on_a_group;

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
