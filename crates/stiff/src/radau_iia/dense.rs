//! An accepted step, with the state at any time within it.

use piola_integrators::internal::{AcceptedStep, Interpolated, state_of};
use piola_integrators::{IntegratorsError, number_and_times};

use super::RadauReport;
use super::checkpoint::{Memory, RadauCheckpoint};
use super::order::RadauOrder;
use super::stages::Workspace;

/// An accepted step of [`RadauIia`](super::RadauIia), with the state at any time within it.
///
/// The collocation polynomial gives the state in between: a step that is asked needs no evaluation.
///
/// # Accuracy
/// Within the step the error is of order s + 1 = 4, 6 or 8 of the step, at its end of order 2s = 6, 10 or 14.
#[doc(alias("interpolation", "continuous output"))]
#[derive(Debug)]
pub struct RadauIiaStep<'a> {
    work: &'a Workspace,
    order: RadauOrder,
    step: AcceptedStep,
    so_far: SoFar,
}

/// What a checkpoint needs beside the workspace.
#[derive(Clone, Copy, Debug)]
pub(super) struct SoFar {
    pub(super) report: RadauReport,
    /// When the run started, s.
    pub(super) origin: f64,
    pub(super) time_carry: f64,
    pub(super) memory: Memory,
}

impl<'a> RadauIiaStep<'a> {
    pub(super) const fn new(work: &'a Workspace, order: RadauOrder, step: AcceptedStep, so_far: SoFar) -> Self {
        Self { work, order, step, so_far }
    }

    number_and_times!();

    /// The order of the method that made it.
    #[must_use]
    pub const fn order(&self) -> RadauOrder {
        self.order
    }
    /// The state at its start.
    #[must_use]
    pub fn start_values(&self) -> &[f64] {
        &self.work.start
    }
    /// The state at its end.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.work.trial
    }

    /// The run at the end of this step, to be continued later by [`RadauIia::resume`](super::RadauIia::resume).
    #[must_use]
    pub fn checkpoint(&self) -> RadauCheckpoint {
        let SoFar { report, origin, time_carry, memory } = self.so_far;
        let (values, carry) = (self.work.trial.clone(), self.work.trial_carry.clone());
        let state = state_of([self.step.end, time_carry], values, carry);
        RadauCheckpoint::new(state, report, origin, memory, self.work)
    }

    /// Writes the state at a time within the step to `out`.
    ///
    /// ```text
    /// y(θ) = y₀ + Σᵢ ℓᵢ(θ) Zᵢ,    ℓᵢ(θ) = θ/cᵢ Π_{k≠i} (θ − c_k)/(cᵢ − c_k),    θ = (t − t₀)/h
    /// ```
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideStep`]: dense output never extrapolates. [`IntegratorsError::WrongLength`].
    pub fn at(&self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError> {
        let n = self.work.trial.len();
        self.step.check(t, n, out.len())?;
        if self.step.is_end(t) {
            out.copy_from_slice(&self.work.trial);
            return Ok(());
        }
        let tableau = self.order.tableau();
        let weights = tableau.weights_at(self.step.part(t));
        for (k, out) in out.iter_mut().enumerate() {
            let mut increment = self.work.start_carry[k];
            for (weight, stage) in weights.iter().zip(self.work.accepted.chunks_exact(n)).take(tableau.stages()) {
                increment += weight * stage[k];
            }
            *out = self.work.start[k] + increment;
        }
        Ok(())
    }
}

impl<E> Interpolated<E> for RadauIiaStep<'_> {
    fn ends(&self) -> (f64, f64) {
        (self.start(), self.time())
    }
    fn state_at(&mut self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError<E>> {
        self.at(t, out).map_err(IntegratorsError::with_field_error)
    }
}
