//! Parameters of viscoelastic fluids from start-up, extension and normal stresses.
//!
//! ```text
//! minimise S(θ) = Σ ln²(answer/measured)      over all rows of all flows
//! ```
//! Answers are closed forms where there are any: steady shear, steady extension of differential fluids, start-up of Oldroyd's fluid B.
//! The others are integrated along the flow to 10⁻¹². A fluid has one relaxation mode, several that are fitted, or those of a spectrum
//! that is known ([`RelaxationModes`]). The search is that of Levenberg and Marquardt over ln θ, or between bounds, from
//! several starts; derivatives are central differences.
//!
//! # Example
//! ```
//! use piola_fit::nonlinear::{NonlinearData, NonlinearFlow, NonlinearModel, Options, ShearResponse, fit_nonlinear};
//! use piola_fluids::{OldroydB, ViscometricFluid};
//! // T₁₂ = (ηₛ + ηₚ) k and N₁ = 2 ηₚ λ k² alone would not tell ηₛ from ηₚ: start-up does.
//! let steady = NonlinearFlow::SteadyShear(ShearResponse::FirstNormalStressDifference);
//! let normal = NonlinearData::new(steady, vec![[1.0, 16.0], [2.0, 64.0]])?; // 2 · 2 · 4
//! let start = NonlinearFlow::ShearStartUp { shear_rate: 1.0, response: ShearResponse::ShearStress };
//! let rows = [1.0_f64, 2.0, 4.0, 8.0, 16.0].map(|t| [t, 1.0 + 2.0 * (1.0 - (-t / 4.0).exp())]).to_vec();
//! let fit = fit_nonlinear(NonlinearModel::OldroydB, &[normal, NonlinearData::new(start, rows)?], &Options::default())?;
//! let values: Vec<f64> = fit.parameters.iter().map(|parameter| parameter.value).collect();
//! assert!((values[0] - 1.0).abs() < 1e-8 && (values[1] - 2.0).abs() < 1e-8 && (values[2] - 4.0).abs() < 1e-8);
//! # Ok::<(), piola_fit::FitError>(())
//! ```

mod answers;
mod data;
mod model;

pub use crate::{Autocorrelation, Criteria, Intervals, Outcome, State};
pub use data::{Extension, NonlinearData, NonlinearFlow, ShearResponse};
pub use model::{NonlinearModel, RelaxationModes};

use core::cell::Cell;

use nalgebra::DMatrix;
use piola_fluids::AnyFluid;

use crate::FitError;
use crate::anew::{Anew, Change, check_intervals};
use crate::estimates::{FitStatistics, statistics_of};
use crate::search::{Misfit, Range, minimise};

/// Options of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The probability of the intervals.
    pub confidence: f64,
    /// How intervals are found.
    pub intervals: Intervals,
    /// Evaluations of a search, for each parameter.
    pub patience: usize,
    /// Where searches start, if not at a few places about the viscosities and rates of the data.
    pub starts: Vec<Vec<f64>>,
    /// The relaxation modes: a number of modes whose viscosities and times are fitted, or given ones.
    pub modes: RelaxationModes,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            confidence: 0.95,
            intervals: Intervals::Linear,
            patience: 60,
            starts: Vec::new(),
            modes: RelaxationModes::default(),
        }
    }
}

/// A fitted parameter.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NonlinearParameter {
    /// Its name.
    pub name: String,
    /// Its value, SI.
    pub value: f64,
    /// Its standard error for independent residuals, if the data determine it and there are degrees of freedom.
    pub standard_error: Option<f64>,
    /// Its confidence interval, widened where residuals are correlated; it crosses no bound.
    pub interval: Option<[f64; 2]>,
    /// What the data say of it.
    pub state: State,
}

/// A fitted viscoelastic fluid.
#[derive(Clone, Debug, PartialEq)]
pub struct NonlinearFit {
    /// The fluid.
    pub fluid: AnyFluid,
    /// Its parameters, in its order.
    pub parameters: Vec<NonlinearParameter>,
    /// ln(answer/measured) of each flow, row by row.
    pub residuals: Vec<Vec<f64>>,
    /// S.
    pub squares: f64,
    /// Rows less parameters that are not at a bound.
    pub degrees_of_freedom: usize,
    /// Correlation of neighbouring residuals.
    pub autocorrelation: Option<Autocorrelation>,
    /// Criteria for choosing between fluids fitted to the same data.
    pub criteria: Criteria,
    /// How the search ended.
    pub outcome: Outcome,
    /// Evaluations of all answers.
    pub evaluations: usize,
    /// Starts that came to this minimum.
    pub starts_that_agree: usize,
}

/// Residuals over unbounded coordinates.
struct Walk<'p> {
    model: NonlinearModel,
    modes: &'p RelaxationModes,
    data: &'p [NonlinearData],
    ranges: &'p [Range],
    /// What is added to the residuals, if anything.
    shift: &'p [f64],
    evaluations: &'p Cell<usize>,
}

impl Walk<'_> {
    fn parameters(&self, x: &[f64]) -> Vec<f64> {
        self.ranges.iter().zip(x).map(|(range, x)| range.outward(*x)[0]).collect()
    }

    fn evaluate(&self, parameters: &[f64]) -> Option<Vec<f64>> {
        self.evaluations.set(self.evaluations.get() + 1);
        let mut residuals = Vec::with_capacity(self.data.iter().map(|set| set.rows().len()).sum());
        for set in self.data {
            self.model.answer(self.modes, parameters, set, &mut residuals).ok()?;
        }
        let measured = self.data.iter().flat_map(NonlinearData::rows);
        residuals.iter_mut().zip(measured).for_each(|(answer, row)| *answer = (*answer / row[1]).ln());
        residuals.iter_mut().zip(self.shift).for_each(|(residual, shift)| *residual += shift);
        residuals.iter().all(|r| r.is_finite()).then_some(residuals)
    }

    /// ∂r/∂x by central differences, by columns.
    fn slopes(&self, x: &[f64], residuals: &[f64]) -> DMatrix<f64> {
        /// Errors 10⁻¹² of answers over this, and its square, are near 10⁻⁸.
        const STEP: f64 = 1e-4;
        const ROUNDING: f64 = 1e-11;
        let mut slopes = DMatrix::zeros(residuals.len(), x.len());
        let mut moved = x.to_vec();
        for k in 0..x.len() {
            let mut at = |step: f64| {
                moved[k] = x[k] + step;
                let found = self.evaluate(&self.parameters(&moved));
                moved[k] = x[k];
                found
            };
            // Beyond the reach of the fluid on one side: the difference from here.
            let (after, before, width) = match (at(STEP), at(-STEP)) {
                (Some(after), Some(before)) => (after, before, 2.0 * STEP),
                (Some(after), None) => (after, residuals.to_vec(), STEP),
                (None, Some(before)) => (residuals.to_vec(), before, STEP),
                (None, None) => continue,
            };
            for (row, (after, before)) in after.iter().zip(&before).enumerate() {
                let change = after - before;
                // What rounding and quadrature leave is no slope: it would seem to determine a parameter of exact data.
                slopes[(row, k)] = if change.abs() <= ROUNDING { 0.0 } else { change / width };
            }
        }
        slopes
    }
}

impl Walk<'_> {
    /// The parameters and S of a changed fit, from the coordinates of the fitted one.
    fn again(
        &self,
        change: Change<'_>,
        x: &[f64],
        patience: usize,
        stop: &dyn Fn() -> bool,
    ) -> Option<(Vec<f64>, f64)> {
        let (shift, held) = match change {
            Change::Shifted(shift) => (shift, None),
            Change::Held(k, value) => (&[][..], Some((k, value))),
        };
        let mut ranges = self.ranges.to_vec();
        let mut start = x.to_vec();
        if let Some((k, value)) = held {
            (ranges[k].bounds, start[k]) = ([value; 2], 0.0);
        }
        let walk = Walk { ranges: &ranges, shift, ..*self };
        let end = minimise(walk, start, patience, stop)?;
        let squares = end.state.1.iter().map(|r| r * r).sum();
        Some((end.misfit.parameters(&end.state.0), squares))
    }
}

impl Misfit for Walk<'_> {
    type State = (Vec<f64>, Vec<f64>);

    fn rows(&self) -> usize {
        self.data.iter().map(|set| set.rows().len()).sum()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Self::State> {
        Some((x.to_vec(), self.evaluate(&self.parameters(x))?))
    }

    fn residuals<'s>(&self, state: &'s Self::State) -> &'s [f64] {
        &state.1
    }

    fn jacobian(&self, state: &Self::State, x: &[f64]) -> DMatrix<f64> {
        self.slopes(x, &state.1)
    }
}

/// Fits a fluid to all flows at once, from the best of several starts.
///
/// What cannot converge still returns the best parameters that were found, with an [`Outcome`] that says so.
///
/// # Errors
/// [`FitError::TooFewPoints`], [`FitError::ConfidenceOutOfRange`]; [`FitError::ModeCount`] or [`FitError::ModeNotPositive`] for invalid
/// relaxation modes; [`FitError::NoSecondNormalStressDifference`] if N₂ is measured and the fluid has none; [`FitError::NumberOfValues`] of
/// a start; [`FitError::NoStart`] if no start has finite answers.
///
/// # Accuracy
/// Exact data give the parameters back to 10⁻⁸ where they determine them. Intervals suppose small errors.
///
/// # Example
/// See the [module](self).
pub fn fit_nonlinear(
    model: NonlinearModel,
    data: &[NonlinearData],
    options: &Options,
) -> Result<NonlinearFit, FitError> {
    fit_nonlinear_until(model, data, options, &|| false)
}

/// The same until `stop` says so; the best parameters until then come with [`Outcome::Interrupted`].
///
/// # Errors
/// As [`fit_nonlinear`].
pub fn fit_nonlinear_until(
    model: NonlinearModel,
    data: &[NonlinearData],
    options: &Options,
    stop: &dyn Fn() -> bool,
) -> Result<NonlinearFit, FitError> {
    if !(0.0 < options.confidence && options.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: options.confidence });
    }
    check_intervals(options.intervals)?;
    options.modes.check()?;
    let is_second =
        |set: &NonlinearData| set.flow().shear_response() == Some(ShearResponse::SecondNormalStressDifference);
    if !model.has_second_normal_stress() && data.iter().any(is_second) {
        return Err(FitError::NoSecondNormalStressDifference { model: model.name().to_owned() });
    }
    let rows: usize = data.iter().map(|set| set.rows().len()).sum();
    let names = model.parameters(&options.modes);
    let n = names.len();
    if rows < n {
        return Err(FitError::TooFewPoints { model: model.name().to_owned(), points: rows, parameters: n });
    }
    let bounds = model.bounds(&options.modes);
    let ranges: Vec<Range> = bounds.iter().map(|bounds| Range { bounds: *bounds, least: f64::MIN_POSITIVE }).collect();
    let evaluations = Cell::new(0);
    let scales = data.iter().filter_map(NonlinearData::scales);
    let [viscosity, rate] = scales.fold([0.0; 2], |[a, b]: [f64; 2], [c, d]| [a.max(c), b.max(d)]);
    let usual = if options.starts.is_empty() { model.starts(&options.modes, [viscosity, rate]) } else { Vec::new() };
    let mut ends = Vec::new();
    for start in usual.iter().chain(&options.starts) {
        if start.len() != n {
            let (model, values) = (model.name().to_owned(), start.len());
            return Err(FitError::NumberOfValues { model, parameters: n, values });
        }
        let x = ranges.iter().zip(start).map(|(range, value)| range.inward(*value)).collect();
        let walk = Walk { model, modes: &options.modes, data, ranges: &ranges, shift: &[], evaluations: &evaluations };
        if let Some(end) = minimise(walk, x, options.patience.max(1), stop) {
            let squares: f64 = end.state.1.iter().map(|r| r * r).sum();
            ends.push((squares, end));
        }
        if stop() {
            break;
        }
    }
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let least = ends.first().map_or(0.0, |end| end.0);
    // Squares of answers to 10⁻¹² are no squares.
    let same = least * (1.0 + 1e-6) + rows as f64 * 1e-20;
    let starts_that_agree = ends.iter().filter(|end| end.0 <= same).count();
    let (squares, end) = ends.into_iter().next().ok_or_else(|| FitError::NoStart { model: model.name().to_owned() })?;
    let (mut x, residuals) = end.state;
    let (first, count) = model.places(&options.modes);
    sort_modes(&mut x[first..first + 2 * count]);
    let values = end.misfit.parameters(&x);
    let at_bound: Vec<bool> = (0..n).map(|k| is_at_bound(&end.misfit, k, &values, squares)).collect();
    let mut slopes = end.misfit.slopes(&x, &residuals);
    for (k, range) in ranges.iter().enumerate() {
        let outward = range.outward(x[k])[1];
        slopes.column_mut(k).iter_mut().for_each(|slope| *slope /= outward);
    }
    let mut series = Vec::new();
    let mut rest = residuals.as_slice();
    for set in data {
        let (these, others) = rest.split_at(set.rows().len());
        series.push(these);
        rest = others;
    }
    let FitStatistics { mut parameters, degrees_of_freedom, criteria, autocorrelation } =
        statistics_of(&values, &bounds, &at_bound, &slopes, &series, options.confidence);
    let fitted = Anew {
        values: &values,
        bounds: &bounds,
        errors: &parameters.iter().map(|parameter| parameter.standard_error).collect::<Vec<_>>(),
        series: &series,
        degrees_of_freedom,
        widening: autocorrelation.map_or(1.0, |found| found.widening),
        confidence: options.confidence,
    };
    let walk = Walk { model, modes: &options.modes, data, ranges: &ranges, shift: &[], evaluations: &evaluations };
    let evaluations_of_the_fit = evaluations.get();
    let mut again = |change: Change<'_>| {
        let (values, squares) = walk.again(change, &x, options.patience.max(1), stop)?;
        Some((sorted_modes(values, model.places(&options.modes)), squares))
    };
    let anew = fitted.intervals(options.intervals, &mut again, stop);
    for (parameter, interval) in parameters.iter_mut().zip(anew.into_iter().flatten()) {
        parameter.interval = interval;
    }
    let parameters = parameters.into_iter().zip(names).zip(&values).map(|((told, name), value)| NonlinearParameter {
        name,
        value: *value,
        standard_error: told.standard_error,
        interval: told.interval,
        state: told.state,
    });
    Ok(NonlinearFit {
        fluid: model.fluid(&options.modes, &values)?,
        parameters: parameters.collect(),
        residuals: series.iter().map(|residuals| residuals.to_vec()).collect(),
        squares,
        degrees_of_freedom,
        autocorrelation,
        criteria,
        outcome: if stop() { Outcome::Interrupted } else { end.outcome },
        evaluations: evaluations_of_the_fit,
        starts_that_agree,
    })
}

/// Whether a parameter is at its bound: near an end of a range, or where going all the way to zero changes nothing.
fn is_at_bound(walk: &Walk<'_>, k: usize, values: &[f64], squares: f64) -> bool {
    let [low, high] = walk.ranges[k].bounds;
    if high.is_finite() {
        let near = 1e-5 * (high - low);
        return values[k] - low <= near || high - values[k] <= near;
    }
    let mut moved = values.to_vec();
    moved[k] *= 1e-30;
    let squares_there = walk.evaluate(&moved).map(|r| r.iter().map(|r| r * r).sum::<f64>());
    squares_there.is_some_and(|there| there <= squares * (1.0 + 1e-9) + f64::MIN_POSITIVE)
}

/// Parameters with their modes sorted.
fn sorted_modes(mut values: Vec<f64>, (first, count): (usize, usize)) -> Vec<f64> {
    sort_modes(&mut values[first..first + 2 * count]);
    values
}

/// Sorts pairs of a viscosity and a time by their times, the shortest first.
fn sort_modes(pairs: &mut [f64]) {
    let mut modes: Vec<[f64; 2]> = pairs.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
    modes.sort_by(|a, b| a[1].total_cmp(&b[1]));
    pairs.copy_from_slice(modes.as_flattened());
}
