//! Dense output: the state at any time within an accepted step.

use piola_numerics::Real;

use super::pair::{Rows, RungeKutta, RungeKuttaPair, evaluate};
use super::{Dense, combine, row, row_mut};
use crate::accepted::AcceptedStep;
use crate::number_and_times;
use crate::{Checkpoint, Field, IntegratorsError};

/// An accepted step, with the state at any time within it.
///
/// The first call of [`at`](Self::at) within a step evaluates the field three times (Dormand–Prince) or nine times (Verner); a step that is not asked,
/// or asked at its ends only, costs nothing.
#[doc(alias("interpolation", "continuous output"))]
#[derive(Debug)]
pub struct DenseStep<'a, P, T, F> {
    method: &'a mut RungeKutta<P, T>,
    field: &'a mut F,
    pub(crate) step: AcceptedStep,
    evaluations: u64,
}

impl<'a, P: RungeKuttaPair, T: Real, F: Field<T>> DenseStep<'a, P, T, F> {
    pub(super) fn new(method: &'a mut RungeKutta<P, T>, field: &'a mut F, step: AcceptedStep) -> Self {
        Self { method, field, step, evaluations: 0 }
    }

    number_and_times!();

    /// The state at its start.
    #[must_use]
    pub fn start_values(&self) -> &[T] {
        self.row(Rows::START)
    }
    /// The state at its end.
    #[must_use]
    pub fn values(&self) -> &[T] {
        self.row(Rows::TRIAL)
    }
    pub(crate) fn row(&self, number: usize) -> &[T] {
        row(&self.method.memory, P::STAGES + number, self.method.components)
    }

    /// The run at the end of this step, to be written down and continued. Its report counts the evaluations for dense output of
    /// this step that were made before.
    #[must_use]
    pub fn checkpoint(&self) -> Checkpoint<T> {
        let mut checkpoint = self.method.checkpoint(self.step.end, &self.step.progress);
        checkpoint.report.evaluations += self.evaluations;
        checkpoint
    }

    /// Writes the state at a time within the step to `out`.
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideStep`]: dense output never extrapolates. [`IntegratorsError::Field`] when
    /// one of the additional evaluations fails. [`IntegratorsError::WrongLength`].
    pub fn at(&mut self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError<F::Error>> {
        self.step.check(t, self.method.components, out.len())?;
        // At its ends the step is known, to the last bit and without evaluations.
        if self.step.is_end(t) {
            out.copy_from_slice(self.row(Rows::TRIAL));
            return Ok(());
        }
        if t.to_bits() == self.start().to_bits() {
            out.copy_from_slice(self.row(Rows::START));
            return Ok(());
        }
        if self.evaluations == 0 {
            self.prepare()?;
        }
        let (theta, n) = (self.step.part(t), self.method.components);
        let interpolant = &self.method.memory[(P::STAGES + Rows::INTERPOLANT) * n..];
        let (start, carry) = (self.row(Rows::START), self.row(Rows::START_CARRY));
        for (i, out) in out.iter_mut().enumerate() {
            *out = start[i] + (carry[i] + P::increment(interpolant, n, i, theta));
        }
        Ok(())
    }

    fn prepare(&mut self) -> Result<(), IntegratorsError<F::Error>> {
        let (t, h, n) = (self.step.start, self.step.length, self.method.components);
        let (k, rest) = self.method.memory.split_at_mut(P::STAGES * n);
        let (ends, interpolant) = rest.split_at_mut(Rows::INTERPOLANT * n);
        let (start, carry) = (row(ends, Rows::START, n), row(ends, Rows::START_CARRY, n));
        for &(number, weights) in P::DENSE_ROWS {
            // The step's end stands in `trial`; the arguments of the stages go to the first interpolant.
            let argument = row_mut(interpolant, 0, n);
            combine(weights, k, (start, carry), h, argument);
            evaluate(self.field, t + P::NODES[number] * h, argument, row_mut(k, number, n))?;
            self.evaluations += 1;
        }
        let (trial, trial_carry) = (row(ends, Rows::TRIAL, n), row(ends, Rows::TRIAL + 1, n));
        let (increment, others) = interpolant.split_at_mut(n);
        for (i, increment) in increment.iter_mut().enumerate() {
            *increment = (trial[i] - start[i]) + (trial_carry[i] - carry[i]);
        }
        P::interpolant(k, increment, h, others);
        Ok(())
    }
}

impl<P: RungeKuttaPair, T: Real, F: Field<T>> Dense<T, F::Error> for DenseStep<'_, P, T, F> {
    fn at(&mut self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError<F::Error>> {
        DenseStep::at(self, t, out)
    }
    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}
