//! Laws with history: viscoelasticity, plasticity and stress softening, fitted to stress–time and cyclic stress–stretch tables.
//!
//! ```text
//! minimise S(θ) = Σ ((P(θ; path) − P̂)/P̂ₘ)²
//! ```
//! P̂ₘ is the largest stress of a test. The law is followed along the path of each test, its free sides found on the way; all tests are
//! fitted at once. The search needs a start of its own for each parameter.
//!
//! # Example
//! See [`fit_history`].

mod model;
mod starts;
mod test;

use core::cell::Cell;

use nalgebra::DMatrix;

use crate::anew::{Anew, Change, check_intervals};
use crate::estimates::{Estimates, estimates, narrowed};
use crate::search::{Misfit, Range, minimise};
use crate::solids::SolidParameter;
use crate::statistics::{Autocorrelation, Criteria};
use crate::{FitError, Intervals, Outcome};

pub use piola_inelastic::StepControl;

pub use model::{AnyHistoryModel, HistoryModel, HistoryParameter};
pub use test::{HistoryTest, follow};

/// Options of a fit.
///
/// # Example
/// See [`fit_history`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HistoryOptions {
    /// Least and greatest values of parameters by name; they narrow those of the model. Equal ends fix a parameter.
    pub bounds: Vec<(String, [f64; 2])>,
    /// How the increments between two rows are integrated.
    pub control: StepControl,
    /// The probability of the intervals.
    pub confidence: f64,
    /// How intervals are found.
    pub intervals: Intervals,
    /// Evaluations of the search, for each unknown, besides those of derivatives.
    pub patience: usize,
}

impl Default for HistoryOptions {
    fn default() -> Self {
        Self {
            bounds: Vec::new(),
            control: StepControl::default(),
            confidence: 0.95,
            intervals: Intervals::Linear,
            patience: 100,
        }
    }
}

impl HistoryOptions {
    /// With bounds of a parameter; equal ends hold it.
    #[must_use]
    pub fn with_bounds(mut self, parameter: &str, bounds: [f64; 2]) -> Self {
        self.bounds.push((parameter.to_owned(), bounds));
        self
    }

    /// With another integration of the increments.
    #[must_use]
    pub const fn with_control(mut self, control: StepControl) -> Self {
        self.control = control;
        self
    }
}

/// Residuals of a test.
///
/// # Example
/// See [`fit_history`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct HistoryResiduals {
    /// Name of the test.
    pub test: String,
    /// The RMS residual over the largest stress.
    pub relative_rms: f64,
    /// P − P̂ of each row.
    pub stresses: Vec<f64>,
}

/// A fitted law with history.
///
/// # Example
/// See [`fit_history`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct HistoryFit {
    /// The model.
    pub model: String,
    /// Its parameters, in its order.
    pub parameters: Vec<SolidParameter>,
    /// Residuals of each test.
    pub tests: Vec<HistoryResiduals>,
    /// S.
    pub weighted_squares: f64,
    /// Numbers measured less parameters that could be moved.
    pub degrees_of_freedom: usize,
    /// Criteria for choosing between laws.
    pub criteria: Criteria,
    /// Correlation of neighbouring residuals.
    pub autocorrelation: Option<Autocorrelation>,
    /// How the search ended.
    pub outcome: Outcome,
    /// How often the law was followed along all tests.
    pub evaluations: usize,
}

impl HistoryFit {
    /// The values of the parameters.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.value).collect()
    }
}

/// Fits a law with history to tests, all at once, from a start.
///
/// # Errors
/// [`FitError::NoTests`], [`FitError::TestTwice`]; [`FitError::NumberOfValues`] of the start; [`FitError::TooFewPoints`];
/// [`FitError::WrongLength`] of stresses of a model of one's own; [`FitError::UnknownParameter`], [`FitError::ImpossibleBounds`], [`FitError::ConfidenceOutOfRange`]. What the law refuses at the start,
/// such as [`FitError::NoHistory`].
///
/// # Accuracy
/// Derivatives are central differences of the stresses over 1e-5 of a parameter; over 10⁵ times the tolerance of `control`, at most 1e-2,
/// if that is more. Data without errors give their parameters back to 1e-8, if they tell them and `control` is that of the data or the
/// error that it allows is small.
///
/// # Example
/// A block is sheared by ½ at once and held: the shear stress of Reese and Govindjee's law relaxes from 1.5 to ½ Pa.
/// ```
/// use piola_fit::history::{AnyHistoryModel, HistoryModel, HistoryOptions, HistoryTest, fit_history};
/// use piola_fit::sides::Loading;
/// use piola_inelastic::StepControl;
/// let model = AnyHistoryModel::ReeseGovindjee;
/// let made = [1.0, 5.0, 2.0, 10.0, 3.0]; // μ, λ at rest; μ, λ, η of the spring that flows
/// let control = StepControl::one_step();
/// let mut rows = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0].map(|t| [t, 0.5, 0.0]);
/// let path = HistoryTest::new("path", Loading::SimpleShear, &rows)?;
/// for (row, stress) in rows.iter_mut().zip(model.stresses(&made, &path, &control)?) {
///     row[2] = stress;
/// }
/// assert!((rows[0][2] - 1.5).abs() < 1e-12); // (1 + 2) k
/// let test = HistoryTest::new("hold", Loading::SimpleShear, &rows)?;
/// // In a shear the volume stays: λ of the law at rest is not told, and that of the other hardly.
/// let options = HistoryOptions::default()
///     .with_control(control)
///     .with_bounds("first_lame_parameter", [5.0, 5.0])
///     .with_bounds("overstress_first_lame_parameter", [10.0, 10.0]);
/// let fit = fit_history(&model, &[test], &[2.0, 5.0, 1.0, 10.0, 1.0], &options)?;
/// for (found, made) in fit.values().iter().zip(made) {
///     assert!((found / made - 1.0).abs() < 1e-8);
/// }
/// # Ok::<(), piola_fit::FitError>(())
/// ```
pub fn fit_history(
    model: &dyn HistoryModel,
    tests: &[HistoryTest],
    start: &[f64],
    options: &HistoryOptions,
) -> Result<HistoryFit, FitError> {
    fit_history_until(model, tests, start, options, &|| false)
}

/// The same until `stop` says so; the best parameters until then come with [`Outcome::Interrupted`].
///
/// # Errors
/// As [`fit_history`].
pub fn fit_history_until(
    model: &dyn HistoryModel,
    tests: &[HistoryTest],
    start: &[f64],
    options: &HistoryOptions,
    stop: &dyn Fn() -> bool,
) -> Result<HistoryFit, FitError> {
    if !(0.0 < options.confidence && options.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: options.confidence });
    }
    check_intervals(options.intervals)?;
    if tests.is_empty() {
        return Err(FitError::NoTests);
    }
    for (index, test) in tests.iter().enumerate() {
        if tests[..index].iter().any(|other| other.name() == test.name()) {
            return Err(FitError::TestTwice { test: test.name().to_owned() });
        }
    }
    let parameters = model.parameters();
    if start.len() != parameters.len() {
        let (model, parameters, values) = (model.name(), parameters.len(), start.len());
        return Err(FitError::NumberOfValues { model, parameters, values });
    }
    let names: Vec<(String, bool)> =
        parameters.iter().map(|(name, is_stress, _)| ((*name).to_owned(), *is_stress)).collect();
    let own = parameters.iter().map(|(_, _, bounds)| Range { bounds: *bounds, least: 1e-9 }).collect();
    let mut ranges = narrowed(&model.name(), &names, own, &options.bounds)?;
    for (range, value) in ranges.iter_mut().zip(start) {
        // The start tells the size of a parameter, and so what is near its bound.
        let distance = range.bounds.into_iter().map(|bound| (value - bound).abs()).fold(f64::INFINITY, f64::min);
        if 0.0 < distance && distance.is_finite() {
            range.least = (1e-9 * distance).max(f64::MIN_POSITIVE);
        }
    }
    let searched: Vec<usize> = (0..ranges.len()).filter(|&k| !ranges[k].is_fixed()).collect();
    let points = tests.iter().map(|test| test.rows().len()).sum();
    if points < searched.len() {
        return Err(FitError::TooFewPoints { model: model.name(), points, parameters: searched.len() });
    }
    let start: Vec<f64> =
        start.iter().zip(&ranges).map(|(value, range)| value.clamp(range.bounds[0], range.bounds[1])).collect();
    let evaluations = Cell::new(0);
    let problem =
        Problem { model, tests, ranges, control: options.control, points, shift: &[], evaluations: &evaluations };
    problem.residuals(&start)?;
    let x = searched.iter().map(|&k| problem.ranges[k].inward(start[k])).collect();
    let walk = Walk { problem: &problem, searched: &searched, parameters: start };
    let Some(end) = minimise(walk, x, options.patience.clamp(1, 1_000_000), stop) else {
        return Err(FitError::NoStart { model: model.name() });
    };
    let (theta, (x, residuals)) = (end.misfit.parameters, end.state);
    let slopes = problem.slopes(&theta, &searched, &x, &residuals);
    let mut rest = residuals.as_slice();
    let (mut series, mut found) = (Vec::new(), Vec::new());
    for test in tests {
        let (weighted, others) = rest.split_at(test.rows().len());
        rest = others;
        series.push(weighted);
        found.push(HistoryResiduals {
            test: test.name().to_owned(),
            relative_rms: (weighted.iter().map(|x| x * x).sum::<f64>() / weighted.len() as f64).sqrt(),
            stresses: weighted.iter().map(|residual| residual * test.largest_stress()).collect(),
        });
    }
    let Estimates { mut parameters, degrees_of_freedom, criteria, autocorrelation } =
        estimates(&names, &theta, &problem.ranges, &slopes, &series, options.confidence);
    let fitted = Anew {
        values: &theta,
        bounds: &problem.ranges.iter().map(|range| range.bounds).collect::<Vec<_>>(),
        errors: &parameters.iter().map(|parameter| parameter.standard_error).collect::<Vec<_>>(),
        series: &series,
        degrees_of_freedom,
        widening: autocorrelation.map_or(1.0, |found| found.widening),
        confidence: options.confidence,
    };
    let evaluations = problem.evaluations.get();
    let mut again = |change: Change<'_>| problem.again(change, &theta, options.patience, stop);
    let anew = fitted.intervals(options.intervals, &mut again, stop);
    for (parameter, interval) in parameters.iter_mut().zip(anew.into_iter().flatten()) {
        parameter.interval = interval;
    }
    Ok(HistoryFit {
        model: model.name(),
        parameters,
        tests: found,
        weighted_squares: residuals.iter().map(|r| r * r).sum(),
        degrees_of_freedom,
        criteria,
        autocorrelation,
        outcome: if options.intervals != Intervals::Linear && stop() { Outcome::Interrupted } else { end.outcome },
        evaluations,
    })
}

/// The accuracy of stresses where starts are tried, and evaluations for each unknown.
const ROUGHLY: (f64, usize) = (1e-4, 25);

/// Fits a law from the best of several starts: a rough search from each, with few evaluations and steps of 1e-4, then a full one from the
/// end of the best. `hold` names the parameters that keep the value of each start.
///
/// # Errors
/// As [`fit_history`]; where no start has a fit, what the first is refused for.
///
/// # Example
/// ```
/// use piola_fit::history::{AnyHistoryModel, HistoryModel, HistoryOptions, HistoryTest, fit_history_of_starts};
/// use piola_fit::sides::Loading;
/// use piola_inelastic::StepControl;
/// let (model, control) = (AnyHistoryModel::ReeseGovindjee, StepControl::one_step());
/// let mut rows = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0].map(|t| [t, 0.5, 0.0]);
/// let path = HistoryTest::new("path", Loading::SimpleShear, &rows)?;
/// let stresses = model.stresses(&[1.0, 100.0, 2.0, 100.0, 3.0], &path, &control)?;
/// rows.iter_mut().zip(stresses).for_each(|(row, stress)| row[2] = stress);
/// let tests = [HistoryTest::new("hold", Loading::SimpleShear, &rows)?];
/// let options = HistoryOptions::default().with_control(control);
/// let held = ["first_lame_parameter", "overstress_first_lame_parameter"];
/// let fit = fit_history_of_starts(&model, &tests, &model.starts(&tests), &held, &options, &|| false)?;
/// assert!((fit.values()[2] - 2.0).abs() < 1e-7 && (fit.values()[4] - 3.0).abs() < 1e-7);
/// # Ok::<(), piola_fit::FitError>(())
/// ```
pub fn fit_history_of_starts(
    model: &dyn HistoryModel,
    tests: &[HistoryTest],
    starts: &[Vec<f64>],
    hold: &[&str],
    options: &HistoryOptions,
    stop: &dyn Fn() -> bool,
) -> Result<HistoryFit, FitError> {
    let (accuracy, patience) = ROUGHLY;
    let rough = StepControl::new(accuracy)?;
    let (mut best, mut refused): (Option<(HistoryFit, HistoryOptions)>, _) = (None, None);
    for start in starts {
        let mut options = options.clone();
        for ((name, ..), value) in model.parameters().iter().zip(start).filter(|((name, ..), _)| hold.contains(name)) {
            options = options.with_bounds(name, [*value; 2]);
        }
        let mut sketch = options.clone();
        sketch.patience = patience;
        sketch.intervals = Intervals::Linear;
        if options.control.tolerance().is_some_and(|tolerance| tolerance < accuracy) {
            sketch.control = rough;
        }
        match fit_history_until(model, tests, start, &sketch, stop) {
            Ok(fit) if best.as_ref().is_none_or(|(best, _)| fit.weighted_squares < best.weighted_squares) => {
                best = Some((fit, options));
            }
            Ok(_) => {}
            Err(error) => refused = refused.or(Some(error)),
        }
        if stop() {
            break;
        }
    }
    let (best, options) = best.ok_or_else(|| refused.unwrap_or(FitError::NoStart { model: model.name() }))?;
    if stop() { Ok(best) } else { fit_history_until(model, tests, &best.values(), &options, stop) }
}

/// The data and ranges of a search.
struct Problem<'a> {
    model: &'a dyn HistoryModel,
    tests: &'a [HistoryTest],
    ranges: Vec<Range>,
    control: StepControl,
    points: usize,
    /// What is added to the residuals, if anything.
    shift: &'a [f64],
    evaluations: &'a Cell<usize>,
}

impl Problem<'_> {
    /// Residuals over their scales.
    fn residuals(&self, theta: &[f64]) -> Result<Vec<f64>, FitError> {
        self.evaluations.set(self.evaluations.get() + 1);
        let mut residuals = Vec::with_capacity(self.points);
        for test in self.tests {
            let scale = test.largest_stress();
            let found = self.model.stresses(theta, test, &self.control)?;
            let (expected, computed) = (test.rows().len(), found.len());
            if computed != expected {
                return Err(FitError::WrongLength { quantity: "stresses of a model", expected, found: computed });
            }
            residuals.extend(found.iter().zip(test.rows()).map(|(stress, row)| (stress - row[2]) / scale));
        }
        residuals.iter_mut().zip(self.shift).for_each(|(residual, shift)| *residual += shift);
        Ok(residuals)
    }

    /// The step of a difference in the unbounded coordinate of a parameter, of a positive one its share; and the change of a residual
    /// that counts as the error of the integration. Their quotient is at most 1e-4.
    fn step(&self) -> [f64; 2] {
        let error = self.control.tolerance().map_or(1e-12, |tolerance| (10.0 * tolerance).max(1e-12));
        let step = (1e4 * error).clamp(1e-5, 1e-2);
        [step, error.min(1e-4 * step)]
    }

    /// The residuals with a parameter at another coordinate.
    fn moved(&self, theta: &[f64], k: usize, x: f64) -> Option<Vec<f64>> {
        let mut moved = theta.to_vec();
        moved[k] = self.ranges[k].outward(x)[0];
        self.residuals(&moved).ok()
    }

    /// Derivatives of the residuals by the coordinates x of the searched parameters, in columns.
    fn by_coordinates(&self, theta: &[f64], searched: &[usize], x: &[f64], residuals: &[f64]) -> DMatrix<f64> {
        let [step, error] = self.step();
        let mut slopes = DMatrix::zeros(self.points, searched.len());
        for (column, (&k, &x)) in searched.iter().zip(x).enumerate() {
            let here = || residuals.to_vec();
            // Where the law answers on one side only, the difference from here; on neither, the search does not move the parameter.
            let (up, down, width) = match (self.moved(theta, k, x + step), self.moved(theta, k, x - step)) {
                (Some(up), Some(down)) => (up, down, 2.0 * step),
                (Some(up), None) => (up, here(), step),
                (None, Some(down)) => (here(), down, step),
                (None, None) => continue,
            };
            for (row, (up, down)) in up.iter().zip(down).enumerate() {
                let change = up - down;
                // What the integration leaves is no slope: it would seem to determine a parameter of exact data.
                slopes[(row, column)] = if change.abs() <= error { 0.0 } else { change / width };
            }
        }
        slopes
    }

    /// The parameters and S of a changed fit, from the fitted ones.
    fn again(
        &self,
        change: Change<'_>,
        theta: &[f64],
        patience: usize,
        stop: &dyn Fn() -> bool,
    ) -> Option<(Vec<f64>, f64)> {
        let (mut ranges, mut start) = (self.ranges.clone(), theta.to_vec());
        let shift = match change {
            Change::Shifted(shift) => shift,
            Change::Held(k, value) => {
                (ranges[k].bounds, start[k]) = ([value; 2], value);
                &[]
            }
        };
        let searched: Vec<usize> = (0..ranges.len()).filter(|&k| !ranges[k].is_fixed()).collect();
        let problem = Problem { ranges, shift, ..*self };
        if searched.is_empty() {
            let residuals = problem.residuals(&start).ok()?;
            return Some((start, residuals.iter().map(|r| r * r).sum()));
        }
        let x = searched.iter().map(|&k| problem.ranges[k].inward(start[k])).collect();
        let walk = Walk { problem: &problem, searched: &searched, parameters: start };
        let end = minimise(walk, x, patience.clamp(1, 1_000_000), stop)?;
        let squares = end.state.1.iter().map(|r| r * r).sum();
        Some((end.misfit.parameters, squares))
    }

    /// Derivatives by all parameters; zero of those that are held.
    fn slopes(&self, theta: &[f64], searched: &[usize], x: &[f64], residuals: &[f64]) -> DMatrix<f64> {
        let found = self.by_coordinates(theta, searched, x, residuals);
        let mut slopes = DMatrix::zeros(self.points, theta.len());
        for (column, (&k, &x)) in searched.iter().zip(x).enumerate() {
            let rate = self.ranges[k].outward(x)[1];
            slopes.set_column(k, &(found.column(column) / rate));
        }
        slopes
    }
}

/// One walk of a search.
struct Walk<'p, 'a> {
    problem: &'p Problem<'a>,
    searched: &'p [usize],
    parameters: Vec<f64>,
}

impl Misfit for Walk<'_, '_> {
    /// The coordinates and the residuals there.
    type State = (Vec<f64>, Vec<f64>);

    fn rows(&self) -> usize {
        self.problem.points
    }

    fn visit(&mut self, x: &[f64]) -> Option<Self::State> {
        for (&k, &x) in self.searched.iter().zip(x) {
            self.parameters[k] = self.problem.ranges[k].outward(x)[0];
        }
        let residuals = self.problem.residuals(&self.parameters).ok()?;
        residuals.iter().all(|x| x.is_finite()).then(|| (x.to_vec(), residuals))
    }

    fn residuals<'s>(&self, (_, residuals): &'s Self::State) -> &'s [f64] {
        residuals
    }

    fn jacobian(&self, (_, residuals): &Self::State, x: &[f64]) -> DMatrix<f64> {
        self.problem.by_coordinates(&self.parameters, self.searched, x, residuals)
    }
}
