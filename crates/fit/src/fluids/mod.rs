//! Parameters of a fluid from its flow curve, or straight from discharges and speeds.
//!
//! ```text
//! minimise S(θ) = Σ rᵢ(θ)²      r = ln(answer/measured), or answer − measured over the largest
//! ```
//! Answers are exact integrals of the flow, with exact derivatives with respect to the parameters; the search is that of Levenberg and
//! Marquardt from one or several starts, over ln θ, or between bounds.
//!
//! # Example
//! ```
//! use piola_fluids::PowerLaw;
//! use piola_fit::fluids::{FlowData, Options, fit_flow};
//! // τ = 3 √k.
//! let data = FlowData::flow_curve(&[[1.0, 3.0], [4.0, 6.0], [9.0, 9.0], [100.0, 30.0]])?;
//! let fit = fit_flow::<PowerLaw, 2>(&[data], &[[1.0, 1.0]], &Options::default())?;
//! assert!((fit.fluid.consistency() - 3.0).abs() < 1e-10 && (fit.fluid.exponent() - 0.5).abs() < 1e-10);
//! # Ok::<(), piola_fit::FitError>(())
//! ```

mod data;
mod search;

pub use crate::{Covariance, Criteria, Outcome};
pub use data::FlowData;

use core::cell::Cell;

use nalgebra::DMatrix;
use piola_fluids::{Parameters, ViscometricFluid};

use crate::search::Range;
use crate::statistics::interval;
use crate::{FitError, student};
use search::{Model, Problem};

/// Definition of the residuals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Weighting {
    /// ln(answer/measured): errors are a part of what is measured.
    #[default]
    Relative,
    /// (answer − measured)/largest: errors are the same in all rows of a set.
    Equal,
}

/// Options of a fit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Options {
    /// Definition of the residuals.
    pub weighting: Weighting,
    /// Least and greatest values of parameters by name, both finite; parameters without are positive.
    pub bounds: Vec<(String, [f64; 2])>,
    /// The probability of the intervals.
    pub confidence: f64,
    /// Evaluations of a search, for each parameter.
    pub patience: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { weighting: Weighting::default(), bounds: Vec::new(), confidence: 0.95, patience: 200 }
    }
}

/// A fitted parameter.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FluidParameter {
    /// Its name.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Its standard error, if the data determine it and there are degrees of freedom.
    pub standard_error: Option<f64>,
    /// Its confidence interval.
    pub interval: Option<[f64; 2]>,
}

/// A fitted fluid.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FluidFit<F> {
    /// The fluid.
    pub fluid: F,
    /// Its parameters, in its order.
    pub parameters: Vec<FluidParameter>,
    /// The covariance of those that are determined.
    pub covariance: Covariance,
    /// Residuals of each set, row by row.
    pub residuals: Vec<Vec<f64>>,
    /// S.
    pub squares: f64,
    /// Rows less parameters.
    pub degrees_of_freedom: usize,
    /// Criteria for choosing between fluids fitted to the same data with the same weighting.
    pub criteria: Criteria,
    /// How the search ended.
    pub outcome: Outcome,
    /// Evaluations of all answers with their derivatives.
    pub evaluations: usize,
    /// Starts that came to this minimum.
    pub starts_that_agree: usize,
}

/// Fits a fluid to all sets at once, from the best of several starts.
///
/// What cannot converge still returns the best parameters that were found, with an [`Outcome`] that says so.
///
/// # Errors
/// [`FitError::TooFewPoints`], [`FitError::ConfidenceOutOfRange`], [`FitError::UnknownParameter`],
/// [`FitError::EmptyInterval`], [`FitError::NoStart`] if no start has finite answers;
/// [`FitError::Viscometry`] with the row of a set whose responses fall by more than its noise ([`FlowData::check_rising`]).
///
/// # Accuracy
/// Parameters to about the root of the rounding of S, ten digits where the data determine them; answers to 10⁻¹⁰. Intervals suppose
/// small errors, near which the fluid is linear in its parameters.
///
/// # Example
/// See the [module](self).
pub fn fit_flow<F: Parameters<N> + ViscometricFluid, const N: usize>(
    data: &[FlowData],
    starts: &[[f64; N]],
    options: &Options,
) -> Result<FluidFit<F>, FitError> {
    let residuals = |parameters: &[f64]| {
        search::residuals::<F, N>(data, options.weighting, core::array::from_fn(|k| parameters[k]))
    };
    let model = Model { name: F::NAME, names: &F::NAMES, residuals: &residuals };
    let starts: Vec<&[f64]> = starts.iter().map(<[f64; N]>::as_slice).collect();
    let found = fit_model(&model, data, &starts, options)?;
    let fluid = F::from_parameters(core::array::from_fn(|k| found.parameters[k].value))?;
    let FluidFit { parameters, covariance, residuals, squares, degrees_of_freedom, criteria, outcome, .. } = found;
    let FluidFit { evaluations, starts_that_agree, .. } = found;
    Ok(FluidFit {
        fluid,
        parameters,
        covariance,
        residuals,
        squares,
        degrees_of_freedom,
        criteria,
        outcome,
        evaluations,
        starts_that_agree,
    })
}

/// The same for any model: the fluid is left to the caller.
fn fit_model(model: &Model, data: &[FlowData], starts: &[&[f64]], options: &Options) -> Result<FluidFit<()>, FitError> {
    if !(0.0 < options.confidence && options.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: options.confidence });
    }
    let rows: usize = data.iter().map(FlowData::len).sum();
    let n = model.names.len();
    if rows < n {
        return Err(FitError::TooFewPoints { model: model.name.to_owned(), points: rows, parameters: n });
    }
    data.iter().try_for_each(FlowData::check_rising)?;
    let ranges = ranges(model, &options.bounds)?;
    let problem = Problem { model, data, ranges, patience: options.patience.max(1), evaluations: Cell::new(0) };
    let mut found: Vec<_> = starts.iter().filter_map(|start| problem.search(start)).collect();
    found.sort_by(|a, b| a.squares.total_cmp(&b.squares));
    let Some(best) = found.first() else { return Err(FitError::NoStart { model: model.name.to_owned() }) };
    let (residuals, slopes) = problem.evaluate(&best.parameters)?;
    let degrees_of_freedom = rows - n;
    let variance = if 0 < degrees_of_freedom { best.squares / degrees_of_freedom as f64 } else { 0.0 };
    let all: Vec<usize> = (0..n).collect();
    let covariance = Covariance::new(&DMatrix::from_row_slice(rows, n, &slopes), &all, variance);
    let quantile = student(options.confidence, degrees_of_freedom);
    let parameter = |k: usize| {
        let standard_error = covariance.standard_error(k).filter(|_| 0 < degrees_of_freedom);
        let value = best.parameters[k];
        let interval = interval(value, standard_error, quantile);
        FluidParameter { name: model.names[k], value, standard_error, interval }
    };
    let mut rest = residuals.as_slice();
    let mut sets = Vec::new();
    for set in data {
        let (these, others) = rest.split_at(set.len());
        sets.push(these.to_vec());
        rest = others;
    }
    Ok(FluidFit {
        fluid: (),
        parameters: (0..n).map(parameter).collect(),
        residuals: sets,
        squares: best.squares,
        degrees_of_freedom,
        criteria: Criteria::new(rows, n, best.squares),
        outcome: best.outcome,
        evaluations: problem.evaluations.get(),
        starts_that_agree: found.iter().filter(|other| other.squares <= best.squares * (1.0 + 1e-6)).count(),
        covariance,
    })
}

/// Where each parameter is searched for: within its bounds, or above zero.
fn ranges(model: &Model, given: &[(String, [f64; 2])]) -> Result<Vec<Range>, FitError> {
    let mut ranges = vec![Range::POSITIVE; model.names.len()];
    for (name, [lower, upper]) in given {
        let parameter = name.clone();
        let Some(k) = model.names.iter().position(|known| known == name) else {
            return Err(FitError::UnknownParameter { model: model.name.to_owned(), parameter });
        };
        if !(lower.is_finite() && upper.is_finite() && lower < upper) {
            return Err(FitError::EmptyInterval { parameter, lower: *lower, upper: *upper });
        }
        ranges[k].bounds = [*lower, *upper];
    }
    Ok(ranges)
}
