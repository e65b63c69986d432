//! The search over all parameters of a fluid.

use core::cell::Cell;
use core::marker::PhantomData;

use nalgebra::DMatrix;
use piola_fluids::{Parameters, ViscometricFluid};
use piola_numerics::{Gradient, Real};

use super::{FlowData, Weighting};
use crate::search::{Misfit, Range, minimise};
use crate::{FitError, Outcome};

/// The data and bounds of a search.
pub(super) struct Problem<'a, F, const N: usize> {
    data: &'a [FlowData],
    weighting: Weighting,
    ranges: [Range; N],
    patience: usize,
    evaluations: Cell<usize>,
    fluid: PhantomData<F>,
}

/// The end of a search.
#[derive(Clone, Debug)]
pub(super) struct Best<const N: usize> {
    pub(super) parameters: [f64; N],
    pub(super) squares: f64,
    pub(super) outcome: Outcome,
}

/// Residuals and their derivatives, row by row.
type Rows<const N: usize> = (Vec<f64>, Vec<[f64; N]>);

impl<'a, F: Parameters<N> + ViscometricFluid, const N: usize> Problem<'a, F, N> {
    pub(super) const fn new(data: &'a [FlowData], weighting: Weighting, ranges: [Range; N], patience: usize) -> Self {
        Self { data, weighting, ranges, patience, evaluations: Cell::new(0), fluid: PhantomData }
    }

    pub(super) fn evaluations(&self) -> usize {
        self.evaluations.get()
    }

    /// Residuals at parameters.
    pub(super) fn evaluate(&self, parameters: [f64; N]) -> Result<Rows<N>, FitError> {
        self.evaluations.set(self.evaluations.get() + 1);
        let fluid = F::from_parameters(parameters)?;
        let lifted: [Gradient<f64, N>; N] = core::array::from_fn(|k| Gradient::variable(parameters[k], k));
        let (mut residuals, mut slopes) = (Vec::new(), Vec::new());
        for set in self.data {
            let largest = set.rows().iter().map(|row| row[1]).fold(0.0, f64::max);
            for (index, [_, measured]) in set.rows().iter().enumerate() {
                let answer = set.answer(&fluid, lifted, index)?;
                let residual = match self.weighting {
                    Weighting::Relative => (answer / Gradient::lit(*measured)).ln(),
                    Weighting::Equal => (answer - Gradient::lit(*measured)) / Gradient::lit(largest),
                };
                residuals.push(residual.value);
                slopes.push(residual.partials);
            }
        }
        Ok((residuals, slopes))
    }

    /// From a start; nothing if it has no finite answers.
    pub(super) fn search(&self, start: [f64; N]) -> Option<Best<N>> {
        let x = self.ranges.iter().zip(start).map(|(range, value)| range.inward(value)).collect();
        let end = minimise(Walk { problem: self, parameters: start }, x, self.patience)?;
        let squares = end.state.0.iter().map(|r| r * r).sum();
        Some(Best { parameters: end.misfit.parameters, squares, outcome: end.outcome })
    }
}

/// One walk of a search.
struct Walk<'p, 'a, F, const N: usize> {
    problem: &'p Problem<'a, F, N>,
    parameters: [f64; N],
}

impl<F: Parameters<N> + ViscometricFluid, const N: usize> Misfit for Walk<'_, '_, F, N> {
    type State = Rows<N>;

    fn rows(&self) -> usize {
        self.problem.data.iter().map(FlowData::len).sum()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Rows<N>> {
        self.parameters = core::array::from_fn(|k| self.problem.ranges[k].outward(x[k])[0]);
        let finite =
            |(residuals, slopes): &Rows<N>| residuals.iter().chain(slopes.iter().flatten()).all(|x| x.is_finite());
        self.problem.evaluate(self.parameters).ok().filter(finite)
    }

    fn residuals<'s>(&self, (residuals, _): &'s Rows<N>) -> &'s [f64] {
        residuals
    }

    fn jacobian(&self, (residuals, slopes): &Rows<N>, x: &[f64]) -> DMatrix<f64> {
        let outward: [f64; N] = core::array::from_fn(|k| self.problem.ranges[k].outward(x[k])[1]);
        DMatrix::from_fn(residuals.len(), N, |i, k| slopes[i][k] * outward[k])
    }
}
