//! An accepted step, with the state at any time within it.

use piola_numerics::Real;

use super::stages::{NAME, Workspace};
use crate::accepted::AcceptedStep;
use crate::events::Interpolated;
use crate::number_and_times;
use crate::{Checkpoint, IntegratorsError, State};

/// An accepted step of [`GaussRadau15`](super::GaussRadau15), with the state at any time within it.
///
/// The accelerations of a step are known as a polynomial of degree seven. Velocities and positions are its integrals. A
/// step that is not asked costs nothing, and one that is asked needs no evaluation.
///
/// # Accuracy
/// Velocities within the step are accurate to order 9, positions to order 10; at its end to order 15.
#[doc(alias("interpolation", "continuous output"))]
#[derive(Debug)]
pub struct GaussRadauStep<'a, T = f64> {
    work: &'a Workspace<T>,
    state: &'a State<T>,
    step: AcceptedStep,
}

impl<'a, T: Real> GaussRadauStep<'a, T> {
    pub(super) fn new(work: &'a Workspace<T>, state: &'a State<T>, step: AcceptedStep) -> Self {
        Self { work, state, step }
    }

    number_and_times!();

    /// The state (q, v) at its start.
    #[must_use]
    pub fn start_values(&self) -> &[T] {
        &self.work.start
    }
    /// The state (q, v) at its end.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.state.values
    }

    /// The run at the end of this step, to be written down and continued.
    #[must_use]
    pub fn checkpoint(&self) -> Checkpoint<T> {
        let State { values, carry, .. } = self.state;
        self.step.progress.checkpoint(NAME, self.step.end, values, carry, self.work.saved())
    }

    /// Writes the state (q, v) at a time within the step to `out`.
    ///
    /// ```text
    /// v(s) = v₀ + h (s a₀ + Σ bₖ sᵏ⁺²/(k + 2)),    q(s) = q₀ + h s v₀ + h² (½ s² a₀ + Σ bₖ sᵏ⁺³/((k + 2)(k + 3)))
    /// ```
    ///
    /// with s = (t − t₀)/h and k = 0 … 6.
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideStep`]: dense output never extrapolates. [`IntegratorsError::WrongLength`].
    pub fn at(&self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError> {
        self.step.check(t, self.state.values.len(), out.len())?;
        if self.step.is_end(t) {
            out.copy_from_slice(&self.state.values);
        } else {
            self.work.state_between(self.step.part(t), out);
        }
        Ok(())
    }
}

impl<E> Interpolated<E> for GaussRadauStep<'_, f64> {
    fn ends(&self) -> (f64, f64) {
        (self.start(), self.time())
    }
    fn state_at(&mut self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError<E>> {
        self.at(t, out).map_err(IntegratorsError::with_field_error)
    }
}
