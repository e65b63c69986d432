//! The stages of an accepted step, made again with the bits of the run.

use piola_numerics::Real;

use super::ParametricField;
use crate::IntegratorsError;
use crate::explicit::{RungeKuttaCoefficients, Weights, combine, row, row_mut, weighted_sums};
use crate::state::compensated_add;

/// The times of an accepted step.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepTimes {
    /// Where the rate at the start was evaluated: the end of the step before, before its sum was compensated.
    pub(super) first: f64,
    /// The time at the start.
    pub(super) start: f64,
    /// The length.
    pub(super) length: f64,
}

impl StepTimes {
    /// The time of a stage.
    pub(super) fn stage<P: RungeKuttaCoefficients>(self, number: usize) -> f64 {
        if number == 0 { self.first } else { self.start + P::NODES[number] * self.length }
    }

    /// Where the rate at the end is evaluated.
    pub(super) fn end(self) -> f64 {
        self.start + self.length
    }
}

/// A stage of a pair: its number and its row of the tableau.
pub(super) fn stage<P: RungeKuttaCoefficients>(index: usize) -> (usize, Weights) {
    match index.checked_sub(1) {
        None => (0, &[]),
        Some(index) => P::ROWS[index],
    }
}

/// The rates of the stages of one step.
#[derive(Clone, Debug)]
pub(super) struct Stages<S> {
    rates: Vec<S>,
    argument: Vec<S>,
}

impl<S: Real> Stages<S> {
    pub(super) const fn new() -> Self {
        Self { rates: Vec::new(), argument: Vec::new() }
    }

    /// Makes room for a pair's stages of n components.
    pub(super) fn resize<P: RungeKuttaCoefficients>(&mut self, n: usize) {
        self.rates.resize(P::END * n, S::zero());
        self.argument.resize(n, S::zero());
    }

    /// Evaluates the stages of a step from y, of which rounding left the second part.
    pub(super) fn evaluate<P: RungeKuttaCoefficients, F: ParametricField>(
        &mut self,
        field: &F,
        p: &[S],
        times: StepTimes,
        y: (&[S], &[S]),
    ) -> Result<(), IntegratorsError<F::Error>> {
        let n = self.argument.len();
        for index in 0..=P::ROWS.len() {
            let (number, _) = stage::<P>(index);
            self.write_argument::<P>(index, times.length, y);
            let t = times.stage::<P>(number);
            field
                .rate(t, &self.argument, p, row_mut(&mut self.rates, number, n))
                .map_err(|source| IntegratorsError::Field { t, source })?;
        }
        Ok(())
    }

    /// Writes the argument of a stage; the stages before it are known.
    fn write_argument<P: RungeKuttaCoefficients>(&mut self, index: usize, h: f64, (y, carry): (&[S], &[S])) {
        match stage::<P>(index) {
            // The rate at the start was evaluated at the rounded state.
            (0, _) => self.argument.copy_from_slice(y),
            (_, weights) => combine(weights, &self.rates, (y, carry), h, &mut self.argument),
        }
    }

    /// The argument of a stage whose step has been evaluated.
    pub(super) fn argument<P: RungeKuttaCoefficients>(&mut self, index: usize, h: f64, y: (&[S], &[S])) -> &[S] {
        self.write_argument::<P>(index, h, y);
        &self.argument
    }

    /// Moves y to the end of the step, whose stages have been evaluated.
    pub(super) fn advance<P: RungeKuttaCoefficients>(&mut self, h: f64, y: &mut [S], carry: &mut [S]) {
        weighted_sums(P::WEIGHTS, &self.rates, &mut self.argument);
        for ((y, carry), &slope) in y.iter_mut().zip(carry).zip(&self.argument) {
            compensated_add(y, carry, slope * S::lit(h));
        }
    }
}

/// Adds a xᵢ to row j of rows.
pub(super) fn add_to_row<S: Real>(rows: &mut [S], j: usize, a: f64, x: &[S]) {
    let a = S::lit(a);
    for (sum, &x) in row_mut(rows, j, x.len()).iter_mut().zip(x) {
        *sum += a * x;
    }
}

/// Writes a times row j of rows to `out`.
pub(super) fn scaled_row<S: Real>(rows: &[S], j: usize, a: f64, out: &mut [S]) {
    let a = S::lit(a);
    let n = out.len();
    for (out, &x) in out.iter_mut().zip(row(rows, j, n)) {
        *out = a * x;
    }
}
