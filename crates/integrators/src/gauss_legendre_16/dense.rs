//! An accepted step, with the state at any time within it.

use super::stages::{NAME, Workspace};
use super::tableau::{LEGENDRE, mirrored};
use crate::accepted::AcceptedStep;
use crate::legendre::integrals;
use crate::number_and_times;
use crate::{Checkpoint, IntegratorsError, State};

/// An accepted step of [`GaussLegendre16`](super::GaussLegendre16), with the state at any time within it.
///
/// The accelerations of a step are known as a polynomial of degree seven; velocities and positions are its integrals. A
/// step that is not asked costs nothing, one that is asked needs no evaluation.
///
/// # Accuracy
/// Velocities within the step are accurate to order 9, positions to order 10; at its end to order 16.
#[doc(alias("interpolation", "continuous output"))]
#[derive(Debug)]
pub struct CollocationStep<'a> {
    work: &'a Workspace,
    state: &'a State,
    step: AcceptedStep,
}

impl<'a> CollocationStep<'a> {
    pub(super) fn new(work: &'a Workspace, state: &'a State, step: AcceptedStep) -> Self {
        Self { work, state, step }
    }

    number_and_times!();

    /// The state (q, v) at its start.
    #[must_use]
    pub fn start_values(&self) -> &[f64] {
        &self.work.start
    }
    /// The state (q, v) at its end.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.state.values
    }

    /// The run at the end of this step, to be written down and continued.
    #[must_use]
    pub fn checkpoint(&self) -> Checkpoint {
        let State { values, carry, .. } = self.state;
        self.step.progress.checkpoint(NAME, self.step.end, values, carry, self.work.saved())
    }

    /// Writes the state (q, v) at a time within the step to `out`.
    ///
    /// ```text
    /// v(θ) = v₀ + h Σ γ_k ∫₀^θ P_k,    q(θ) = q₀ + h θ v₀ + h² Σ γ_k ∬₀^θ P_k,    θ = (t − t₀)/h
    /// ```
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideStep`]: dense output never extrapolates. [`IntegratorsError::WrongLength`].
    pub fn at(&self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError> {
        self.step.check(t, self.state.values.len(), out.len())?;
        if self.step.is_end(t) {
            out.copy_from_slice(&self.state.values);
        } else {
            self.work.state_between(self.step.part(t), out);
        }
        Ok(())
    }
}

impl Workspace {
    /// Writes the state at the part θ of the last accepted step.
    pub(super) fn state_between(&self, theta: f64, out: &mut [f64]) {
        let (n, h) = (self.previous.len(), self.previous_step);
        let (once, twice) = integrals(theta);
        // The weights of the stages: Σ_k (2k + 1) bⱼ P_k(cⱼ) ∫ P_k.
        let (mut velocity, mut position) = ([0.0; 8], [0.0; 8]);
        for (k, row) in LEGENDRE.iter().enumerate() {
            for j in 0..8 {
                velocity[j] += row.0[j] * once[k];
                position[j] += row.0[j] * twice[k];
            }
        }
        let (q0, v0) = self.start.split_at(n);
        let (q, v) = out.split_at_mut(n);
        for (k, a) in self.previous.iter().enumerate() {
            let a = mirrored(*a);
            let sum = |weights: &[f64; 8]| weights.iter().zip(a.0).map(|(w, a)| w * a).sum::<f64>();
            v[k] = v0[k] + h * sum(&velocity);
            q[k] = q0[k] + h * (theta * v0[k] + h * sum(&position));
        }
    }
}
