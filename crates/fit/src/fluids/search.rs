//! The search over all parameters of a fluid.

use core::cell::Cell;

use nalgebra::DMatrix;
use piola_fluids::{Parameters, ViscometricFluid};
use piola_numerics::{Gradient, Real};

use super::{FlowData, Weighting};
use crate::search::{Misfit, Range, minimise};
use crate::{FitError, Outcome};

/// What a search must know of a fluid: the search is compiled once for all fluids.
pub(super) struct Model<'f> {
    pub(super) name: &'static str,
    /// The names of its parameters.
    pub(super) names: &'f [&'static str],
    /// Residuals of data at parameters.
    pub(super) residuals: &'f Residuals<'f>,
}

/// Residuals of data at parameters.
pub(super) type Residuals<'f> = dyn Fn(&[FlowData], &[f64]) -> Result<Rows, FitError> + 'f;

/// Residuals, and their derivatives row by row.
pub(super) type Rows = (Vec<f64>, Vec<f64>);

/// Residuals of a fluid with given parameters.
pub(super) fn residuals<F: Parameters<N> + ViscometricFluid, const N: usize>(
    data: &[FlowData],
    weighting: Weighting,
    parameters: [f64; N],
) -> Result<Rows, FitError> {
    let fluid = F::from_parameters(parameters)?;
    let lifted: [Gradient<f64, N>; N] = core::array::from_fn(|k| Gradient::variable(parameters[k], k));
    let stress = |k: f64| F::shear_stress_of(lifted, Gradient::lit(k));
    let rate = |stress: f64| Ok(fluid.shear_rate(stress)?);
    let (mut residuals, mut slopes) = (Vec::new(), Vec::new());
    for set in data {
        let largest = set.rows().iter().map(|row| row[1]).fold(0.0, f64::max);
        let answers = set.answers(&stress, &rate)?;
        for ([_, measured], answer) in set.rows().iter().zip(answers) {
            let residual = match weighting {
                Weighting::Relative => (answer / Gradient::lit(*measured)).ln(),
                Weighting::Equal => (answer - Gradient::lit(*measured)) / Gradient::lit(largest),
            };
            residuals.push(residual.value);
            slopes.extend(residual.partials);
        }
    }
    Ok((residuals, slopes))
}

/// A model, its data and the ranges of its parameters.
pub(super) struct Problem<'a> {
    pub(super) model: &'a Model<'a>,
    pub(super) data: &'a [FlowData],
    pub(super) ranges: Vec<Range>,
    pub(super) patience: usize,
    pub(super) evaluations: &'a Cell<usize>,
    /// Whether the search shall end.
    pub(super) stop: &'a dyn Fn() -> bool,
}

/// The end of a search.
#[derive(Clone, Debug)]
pub(super) struct Best {
    pub(super) parameters: Vec<f64>,
    pub(super) squares: f64,
    pub(super) outcome: Outcome,
}

impl Problem<'_> {
    /// Residuals at parameters.
    pub(super) fn evaluate(&self, parameters: &[f64]) -> Result<Rows, FitError> {
        self.evaluations.set(self.evaluations.get() + 1);
        (self.model.residuals)(self.data, parameters)
    }

    /// From a start; nothing if it has no finite answers.
    pub(super) fn search(&self, start: &[f64]) -> Option<Best> {
        let x = self.ranges.iter().zip(start).map(|(range, value)| range.inward(*value)).collect();
        let end = minimise(Walk { problem: self, parameters: start.to_vec() }, x, self.patience, self.stop)?;
        let squares = end.state.0.iter().map(|r| r * r).sum();
        Some(Best { parameters: end.misfit.parameters, squares, outcome: end.outcome })
    }
}

/// One walk of a search.
struct Walk<'p> {
    problem: &'p Problem<'p>,
    parameters: Vec<f64>,
}

impl Misfit for Walk<'_> {
    type State = Rows;

    fn rows(&self) -> usize {
        self.problem.data.iter().map(FlowData::len).sum()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Rows> {
        for ((parameter, range), x) in self.parameters.iter_mut().zip(&self.problem.ranges).zip(x) {
            *parameter = range.outward(*x)[0];
        }
        let finite = |(residuals, slopes): &Rows| residuals.iter().chain(slopes).all(|x| x.is_finite());
        self.problem.evaluate(&self.parameters).ok().filter(finite)
    }

    fn residuals<'s>(&self, (residuals, _): &'s Rows) -> &'s [f64] {
        residuals
    }

    fn jacobian(&self, (residuals, slopes): &Rows, x: &[f64]) -> DMatrix<f64> {
        let outward: Vec<f64> = x.iter().zip(&self.problem.ranges).map(|(x, range)| range.outward(*x)[1]).collect();
        DMatrix::from_fn(residuals.len(), outward.len(), |i, k| slopes[i * outward.len() + k] * outward[k])
    }
}
