//! An accepted step, with the state at any time within it.

use super::order::RadauOrder;
use super::stages::Workspace;
use crate::IntegratorsError;

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
    number: u64,
    start: f64,
    end: f64,
    step: f64,
}

impl<'a> RadauIiaStep<'a> {
    pub(super) const fn new(
        work: &'a Workspace,
        order: RadauOrder,
        number: u64,
        [start, end]: [f64; 2],
        step: f64,
    ) -> Self {
        Self { work, order, number, start, end, step }
    }

    /// The number of the step, from 1.
    #[must_use]
    pub const fn number(&self) -> u64 {
        self.number
    }
    /// The order of the method that made it.
    #[must_use]
    pub const fn order(&self) -> RadauOrder {
        self.order
    }
    /// The time at its start, s.
    #[must_use]
    pub const fn start(&self) -> f64 {
        self.start
    }
    /// The time at its end, s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.end
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
    /// Whether a time lies within the step.
    #[must_use]
    pub fn contains(&self, t: f64) -> bool {
        let (low, high) = if self.start <= self.end { (self.start, self.end) } else { (self.end, self.start) };
        low <= t && t <= high
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
        if out.len() != n {
            return Err(IntegratorsError::WrongLength { quantity: "out", expected: n, found: out.len() });
        }
        if !self.contains(t) {
            return Err(IntegratorsError::OutsideStep { t, start: self.start, end: self.end });
        }
        if t.to_bits() == self.end.to_bits() {
            out.copy_from_slice(&self.work.trial);
            return Ok(());
        }
        let tableau = self.order.tableau();
        let weights = tableau.weights_at(((t - self.start) / self.step).clamp(0.0, 1.0));
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
