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

mod any;
mod data;
mod search;

pub use crate::{Autocorrelation, Covariance, Criteria, Intervals, Outcome, State};
pub use any::FluidModel;
pub use data::FlowData;

use core::cell::Cell;

use nalgebra::DMatrix;
use piola_fluids::{Parameters, ViscometricFluid};

use crate::anew::{Anew, Change, check_intervals};
use crate::search::Range;
use crate::statistics::{interval, profile};
use crate::{FitError, student};
use search::{Best, Model, Problem};

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
    /// How intervals are found.
    pub intervals: Intervals,
    /// Evaluations of a search, for each parameter.
    pub patience: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            weighting: Weighting::default(),
            bounds: Vec::new(),
            confidence: 0.95,
            intervals: Intervals::Linear,
            patience: 200,
        }
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
    /// Its standard error for independent residuals, if the data determine it and there are degrees of freedom.
    pub standard_error: Option<f64>,
    /// Its confidence interval, widened where residuals are correlated; it crosses no bound. At a bound it reaches from there.
    pub interval: Option<[f64; 2]>,
    /// What the data say of it.
    pub state: State,
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
    /// Rows less parameters that are not at a bound.
    pub degrees_of_freedom: usize,
    /// Correlation of neighbouring residuals.
    pub autocorrelation: Option<Autocorrelation>,
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
    fit_flow_until(data, starts, options, &|| false)
}

/// The same until `stop` says so; the best parameters until then come with [`Outcome::Interrupted`].
///
/// # Errors
/// As [`fit_flow`].
pub fn fit_flow_until<F: Parameters<N> + ViscometricFluid, const N: usize>(
    data: &[FlowData],
    starts: &[[f64; N]],
    options: &Options,
    stop: &dyn Fn() -> bool,
) -> Result<FluidFit<F>, FitError> {
    let residuals = |data: &[FlowData], parameters: &[f64]| {
        search::residuals::<F, N>(data, options.weighting, core::array::from_fn(|k| parameters[k]))
    };
    let model = Model { name: F::NAME, names: &F::NAMES, residuals: &residuals };
    let starts: Vec<&[f64]> = starts.iter().map(<[f64; N]>::as_slice).collect();
    let found = fit_model(&model, data, &starts, options, stop)?;
    let fluid = F::from_parameters(core::array::from_fn(|k| found.parameters[k].value))?;
    Ok(found.with_fluid(|()| fluid))
}

impl<F> FluidFit<F> {
    /// The same fit of the fluid in another form.
    pub(crate) fn with_fluid<G>(self, form: impl FnOnce(F) -> G) -> FluidFit<G> {
        let Self { fluid, parameters, covariance, residuals, squares, degrees_of_freedom, .. } = self;
        let Self { autocorrelation, criteria, outcome, evaluations, starts_that_agree, .. } = self;
        FluidFit {
            fluid: form(fluid),
            parameters,
            covariance,
            residuals,
            squares,
            degrees_of_freedom,
            autocorrelation,
            criteria,
            outcome,
            evaluations,
            starts_that_agree,
        }
    }
}

/// Rows beyond which starts are first tried on some of them.
const MANY: usize = 400;

/// The same for any model: the fluid is left to the caller.
fn fit_model(
    model: &Model,
    data: &[FlowData],
    starts: &[&[f64]],
    options: &Options,
    stop: &dyn Fn() -> bool,
) -> Result<FluidFit<()>, FitError> {
    if !(0.0 < options.confidence && options.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: options.confidence });
    }
    check_intervals(options.intervals)?;
    let rows: usize = data.iter().map(FlowData::len).sum();
    let n = model.names.len();
    if rows < n {
        return Err(FitError::TooFewPoints { model: model.name.to_owned(), points: rows, parameters: n });
    }
    data.iter().try_for_each(FlowData::check_rising)?;
    let ranges = ranges(model, &options.bounds)?;
    let evaluations = Cell::new(0);
    let patience = options.patience.max(1);
    let problem = Problem { model, data, ranges: ranges.clone(), patience, evaluations: &evaluations, stop };
    let few: Vec<FlowData> = data.iter().map(|set| set.thinned(MANY * set.len() / rows)).collect();
    let sketch = Problem { data: &few, ranges: ranges.clone(), ..problem };
    let by_squares = |a: &Best, b: &Best| a.squares.total_cmp(&b.squares);
    let mut found: Vec<Best> =
        starts.iter().filter_map(|start| if rows <= MANY { &problem } else { &sketch }.search(start)).collect();
    found.sort_by(by_squares);
    let agree = |found: &[Best]| {
        let least = found.first().map_or(0.0, |best| best.squares);
        found.iter().filter(|other| other.squares <= least * (1.0 + 1e-6)).count()
    };
    let starts_that_agree = agree(&found);
    let mut best = found.into_iter().next();
    // Then on fifty times as many, and on all: each search begins where its least sum of squares nearly is.
    if 100 * MANY < rows {
        let more: Vec<FlowData> = data.iter().map(|set| set.thinned(50 * MANY * set.len() / rows)).collect();
        let draft = Problem { data: &more, ranges, ..problem };
        best = best.and_then(|best| draft.search(&best.parameters));
    }
    if MANY < rows {
        best = best.and_then(|best| problem.search(&best.parameters));
    }
    let Some(best) = best else { return Err(FitError::NoStart { model: model.name.to_owned() }) };
    let (residuals, slopes) = problem.evaluate(&best.parameters)?;
    let mut rest = residuals.as_slice();
    let mut sets = Vec::new();
    for set in data {
        let (these, others) = rest.split_at(set.len());
        sets.push(these.to_vec());
        rest = others;
    }
    let evaluations_of_the_fit = evaluations.get();
    let statistics = Statistics::new(&problem, &best, &DMatrix::from_row_slice(rows, n, &slopes), &sets, options);
    let mut parameters: Vec<FluidParameter> = (0..n).map(|k| statistics.parameter(k)).collect();
    statistics.resample(&mut parameters, &sets, options);
    Ok(FluidFit {
        fluid: (),
        parameters,
        residuals: sets,
        squares: best.squares,
        degrees_of_freedom: statistics.degrees_of_freedom,
        autocorrelation: statistics.autocorrelation,
        criteria: Criteria::new(rows, n, best.squares),
        outcome: if options.intervals != Intervals::Linear && stop() { Outcome::Interrupted } else { best.outcome },
        evaluations: evaluations_of_the_fit,
        starts_that_agree,
        covariance: statistics.covariance,
    })
}

/// What the least sum of squares says of the parameters.
struct Statistics<'p> {
    problem: &'p Problem<'p>,
    best: &'p Best,
    covariance: Covariance,
    autocorrelation: Option<Autocorrelation>,
    degrees_of_freedom: usize,
    at_bound: Vec<bool>,
    /// t of Student, times the widening by correlated residuals.
    quantile: Option<f64>,
    variance: f64,
    intervals: Intervals,
}

/// A half width of ln θ beyond which not even the order of magnitude is told.
const LOST: f64 = 9.2;

impl<'p> Statistics<'p> {
    fn new(
        problem: &'p Problem<'p>,
        best: &'p Best,
        slopes: &DMatrix<f64>,
        sets: &[Vec<f64>],
        options: &Options,
    ) -> Self {
        let (rows, n) = slopes.shape();
        let is_at_bound = |k: usize| {
            let [low, high] = problem.ranges[k].bounds;
            let value = best.parameters[k];
            if low.is_finite() && high.is_finite() {
                let near = 1e-5 * (high - low);
                return value - low <= near || high - value <= near;
            }
            // Going all the way to the bound changes nothing.
            Self::moved(problem, best, k)
                .is_some_and(|squares| squares <= best.squares * (1.0 + 1e-9) + f64::MIN_POSITIVE)
        };
        let at_bound: Vec<bool> = (0..n).map(is_at_bound).collect();
        let free: Vec<usize> = (0..n).filter(|&k| !at_bound[k]).collect();
        let degrees_of_freedom = rows - free.len();
        let variance = if 0 < degrees_of_freedom { best.squares / degrees_of_freedom as f64 } else { 0.0 };
        let covariance = Covariance::new(slopes, &free, variance);
        let autocorrelation = Autocorrelation::of(sets.iter().map(Vec::as_slice)).filter(|_| 1e-9 < variance.sqrt());
        let widening = autocorrelation.map_or(1.0, |found| found.widening);
        let quantile = student(options.confidence, degrees_of_freedom).map(|t| t * widening);
        let intervals = options.intervals;
        Self { problem, best, covariance, autocorrelation, degrees_of_freedom, at_bound, quantile, variance, intervals }
    }

    /// S with a positive parameter so small that it does nothing; the others stay.
    fn moved(problem: &Problem<'_>, best: &Best, k: usize) -> Option<f64> {
        let mut parameters = best.parameters.clone();
        parameters[k] = (1e-30 * parameters[k]).max(f64::MIN_POSITIVE);
        let (residuals, _) = problem.evaluate(&parameters).ok()?;
        let squares = residuals.iter().map(|r| r * r).sum::<f64>();
        squares.is_finite().then_some(squares)
    }

    fn parameter(&self, k: usize) -> FluidParameter {
        let (name, value) = (self.problem.model.names[k], self.best.parameters[k]);
        let bounds = self.problem.ranges[k].bounds;
        let none = FluidParameter { name, value, standard_error: None, interval: None, state: State::Undetermined };
        let Some(quantile) = self.quantile.filter(|_| 0 < self.degrees_of_freedom) else {
            let is_fixed = self.covariance.parameters.contains(&k);
            let state = if self.at_bound[k] {
                State::AtBound
            } else if is_fixed {
                State::NoDegreesOfFreedom
            } else {
                State::Undetermined
            };
            return FluidParameter { state, ..none };
        };
        if self.at_bound[k] {
            return FluidParameter { interval: self.beyond(k, quantile), state: State::AtBound, ..none };
        }
        let Some(error) = self.covariance.standard_error(k) else { return none };
        let (half, distance) = (quantile * error, value - bounds[0]);
        let is_positive = bounds[1].is_infinite();
        let limit = self.best.squares + quantile * quantile * self.variance;
        if is_positive && distance < half {
            // Either the bound is among what the data allow, or nothing is.
            let is_allowed = Self::moved(self.problem, self.best, k).is_some_and(|squares| squares <= limit);
            if !is_allowed && LOST * distance < half {
                return none;
            }
        }
        // That of the bootstrap comes for all parameters at once; the linear one stays where the profile is interrupted.
        let profile = (self.intervals == Intervals::Profile).then(|| self.profile(k, error, limit));
        let interval = profile.filter(|_| !(self.problem.stop)()).unwrap_or_else(|| interval(value, bounds, half));
        FluidParameter { standard_error: Some(error), interval: Some(interval), state: State::Determined, ..none }
    }

    /// Intervals by the bootstrap, where they are asked for.
    fn resample(&self, parameters: &mut [FluidParameter], sets: &[Vec<f64>], options: &Options) {
        if !matches!(self.intervals, Intervals::Bootstrap { .. }) {
            return;
        }
        let Problem { model, data, .. } = *self.problem;
        let fitted = Anew {
            values: &self.best.parameters,
            bounds: &self.problem.ranges.iter().map(|range| range.bounds).collect::<Vec<_>>(),
            errors: &parameters.iter().map(|parameter| parameter.standard_error).collect::<Vec<_>>(),
            series: &sets.iter().map(Vec::as_slice).collect::<Vec<_>>(),
            degrees_of_freedom: self.degrees_of_freedom,
            widening: self.autocorrelation.map_or(1.0, |found| found.widening),
            confidence: options.confidence,
        };
        let mut again = |change: Change<'_>| {
            let Change::Shifted(shift) = change else { return None };
            let residuals = |data: &[FlowData], parameters: &[f64]| {
                let (mut residuals, slopes) = (model.residuals)(data, parameters)?;
                residuals.iter_mut().zip(shift).for_each(|(residual, shift)| *residual += shift);
                Ok((residuals, slopes))
            };
            let model = Model { residuals: &residuals, ..*model };
            let problem = Problem { model: &model, data, ranges: self.problem.ranges.clone(), ..*self.problem };
            problem.search(&self.best.parameters).map(|best| (best.parameters, best.squares))
        };
        let anew = fitted.intervals(self.intervals, &mut again, self.problem.stop);
        for (parameter, interval) in parameters.iter_mut().zip(anew.into_iter().flatten()) {
            if parameter.standard_error.is_some() {
                parameter.interval = interval;
            }
        }
    }

    /// By profile likelihood.
    fn profile(&self, k: usize, error: f64, limit: f64) -> [f64; 2] {
        let bounds = self.problem.ranges[k].bounds;
        let mut squares = |value: f64| self.refitted(k, value);
        profile(self.best.parameters[k], bounds, error, (self.best.squares, limit), &mut squares)
    }

    /// The least S with a parameter at a value.
    fn refitted(&self, k: usize, value: f64) -> Option<f64> {
        let mut ranges = self.problem.ranges.clone();
        ranges[k].bounds = [value; 2];
        let problem = Problem { ranges, ..*self.problem };
        let mut start = self.best.parameters.clone();
        start[k] = value;
        problem.search(&start).map(|best| best.squares)
    }

    /// The interval of a parameter at its bound 0: up to where S exceeds its least, all others fitted anew.
    fn beyond(&self, k: usize, quantile: f64) -> Option<[f64; 2]> {
        let [low, high] = self.problem.ranges[k].bounds;
        let rows: usize = self.problem.data.iter().map(FlowData::len).sum();
        if low.is_finite() && high.is_finite() || MANY < rows {
            return None;
        }
        let limit = self.best.squares + quantile * quantile * self.variance;
        let exceeds = |value: f64| self.refitted(k, value).is_none_or(|squares| limit < squares);
        // Steps by a thousand from what does nothing, then halving of the logarithm.
        let start = self.best.parameters[k].max(1e-12);
        let above = (0..14).map(|power| start * 1e3_f64.powi(power)).find(|value| exceeds(*value))?;
        let (mut inside, mut outside) = (1e-3 * above, above);
        for _ in 0..9 {
            let middle = (inside * outside).sqrt();
            if exceeds(middle) { outside = middle } else { inside = middle }
        }
        (!(self.problem.stop)()).then_some([low, outside])
    }
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
