//! Parameters of incompressible laws from measured stresses.
//!
//! ```text
//! minimise S(θ) = Σ wᵢ² (Pᵢ(θ) − P̂ᵢ)²      over all tests at once, between bounds, stable where measured
//! ```
//! | step | item |
//! |---|---|
//! | tables become data | [`Test`] of a [`Table`], [`Data`] of several tests |
//! | a law with unknown parameters | [`AnyModel`] (`"ogden:3".parse()`), or your own [`Model`] |
//! | the fit | [`fit`] with [`Options`]: weights, bounds, stability |
//! | the result | [`Fit`]: [`SolidParameter`]s with errors, [`Covariance`], [`Residuals`] of each test, [`Criteria`], [`StabilityReport`] |
//! | the law itself, for all else | [`Fit::law`], [`Fit::compressible`] |
//!
//! Derivatives of the stresses with respect to the parameters are exact: a model is one function over any scalar. Parameters
//! that are factors are eliminated, so that a law of factors alone is solved directly; the others are searched for by
//! the method of Levenberg and Marquardt from several fixed starts, the same in every run.
//!
//! # Example
//! See the [crate].

mod any;
mod crossed;
mod laws;
mod linear;
mod model;
mod prediction;
mod report;
mod search;
mod stability;
mod test;

pub use crate::{Autocorrelation, Covariance, Criteria, Intervals, Outcome, State, student};
pub use crossed::{Alone, Contradiction, HeldOut, alone, contradictions, held_out};
pub use laws::{AnyModel, Series};
pub use model::{Embedding, Fitted, Model, Parameter, Role, StableSign};
pub use prediction::{Prediction, predict};
pub use stability::{Counterexample, StabilityReport};
pub use test::{Component, Data, Measure, Table, Test};

use core::cell::Cell;

use piola_laws::rubber::AnyRubber;
use piola_solids::AnyVolumetric;

use crate::FitError;
use crate::anew::check_intervals;
use search::Problem;

/// The divisor of the residuals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Weighting {
    /// The largest stress of the test: errors are a part of the range of the machine.
    #[default]
    LargestStress,
    /// The largest stress of all tests: errors are the same in all tests.
    Equal,
}

/// Whether a law must be stable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Stability {
    /// By the signs of its parameters where a model has such; otherwise Drucker's condition as far as the data go.
    #[default]
    Required,
    /// It is reported only.
    Free,
}

/// Options of a fit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Options {
    /// The divisor of the residuals; the weight of each test comes on top.
    pub weighting: Weighting,
    /// Whether the law must be stable.
    pub stability: Stability,
    /// Least and greatest values of parameters by name; they narrow those of the model.
    pub bounds: Vec<(String, [f64; 2])>,
    /// The probability of the intervals.
    pub confidence: f64,
    /// How intervals are found.
    pub intervals: Intervals,
    /// Evaluations of a search, for each unknown; at most a million.
    pub patience: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            weighting: Weighting::default(),
            stability: Stability::default(),
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
pub struct SolidParameter {
    /// Its name.
    pub name: String,
    /// Whether it is in the unit of the stresses; a pure number otherwise.
    pub is_stress: bool,
    /// Its value.
    pub value: f64,
    /// Its standard error for independent residuals, if it is determined and there are degrees of freedom.
    pub standard_error: Option<f64>,
    /// Its confidence interval, widened where residuals are correlated; it crosses no bound.
    pub interval: Option<[f64; 2]>,
    /// What the data say of it.
    pub state: State,
}

/// Residuals of a test.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Residuals {
    /// Name of the test.
    pub test: String,
    /// Numbers in it.
    pub points: usize,
    /// √(Σ (P − P̂)²/points), in the unit of the stresses. Points at rest do not count: there no law has a stress.
    pub rms: f64,
    /// The same over the largest stress of the test.
    pub relative_rms: f64,
    /// The largest |P − P̂| over the largest stress of the test, points at rest left out.
    pub relative_largest: f64,
    /// The largest stress of the test.
    pub largest_stress: f64,
    /// P − P̂ of each point.
    pub residuals: Vec<f64>,
}

/// A fitted law.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Fit {
    /// Name of the model.
    pub model: String,
    /// Its parameters, in its order.
    pub parameters: Vec<SolidParameter>,
    /// The covariance of those that are determined; none without degrees of freedom, as the residuals then say nothing of
    /// the errors.
    pub covariance: Option<Covariance>,
    /// Residuals of each test.
    pub tests: Vec<Residuals>,
    /// S, the weighted sum of squares.
    pub weighted_squares: f64,
    /// Numbers measured, those at rest left out, less parameters that could be moved. At 0 there are no errors, intervals or covariance, and
    /// parameters that the data fix are [`State::NoDegreesOfFreedom`].
    pub degrees_of_freedom: usize,
    /// Criteria for choosing between laws; numbers at rest do not count.
    pub criteria: Criteria,
    /// Correlation of neighbouring residuals.
    pub autocorrelation: Option<Autocorrelation>,
    /// The probability of the intervals.
    pub confidence: f64,
    /// The shear modulus at rest, in the unit of the stresses; Young's is three times it.
    pub initial_shear_modulus: f64,
    /// Whether the law is stable as far as the data go.
    pub stability: StabilityReport,
    /// How the search ended.
    pub outcome: Outcome,
    /// Evaluations of all stresses with their derivatives.
    pub evaluations: usize,
    /// Starts of the search.
    pub starts: usize,
    /// Starts that came to this minimum.
    pub starts_that_agree: usize,
}

impl Fit {
    /// The values of the parameters.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.value).collect()
    }

    /// The fitted law, incompressible and without excess pressure.
    ///
    /// # Errors
    /// [`FitError::UnknownModel`] for a model of your own; as [`AnyModel::law`] otherwise.
    ///
    /// # Example
    /// ```
    /// use piola_fit::solids::{AnyModel, Data, Measure, Options, Table, Test, fit};
    /// use piola_specimens::homogeneous::{Mode, first_piola};
    /// use piola_solids::{Hyperelastic, volumetric::SimoTaylor};
    /// use piola_continuum::DeformationGradient;
    /// let bar = Table::Uniaxial(vec![[1.5, 0.4], [2.0, 0.6], [3.0, 1.1]]);
    /// let data = Data::new(vec![Test::new("bar", bar, Measure::FirstPiola)?])?;
    /// let fitted = fit(&AnyModel::NeoHookean, &data, &Options::default())?;
    /// let mu = fitted.parameters[0].value;
    /// let stress: f64 = first_piola(Mode::Uniaxial, 2.0, &fitted.law()?);
    /// assert!((stress - 1.75 * mu).abs() < 1e-15); // μ (λ − λ⁻²)
    /// let solid = fitted.compressible(SimoTaylor::new(1e3)?)?; // for a finite-element code
    /// let sheared = solid.cauchy(&DeformationGradient::simple_shear(0.5)?).0.components[3];
    /// assert!((sheared - 0.5 * mu).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn law(&self) -> Result<AnyRubber, FitError> {
        self.model.parse::<AnyModel>()?.law(&self.values())
    }

    /// The compressible law whose energy of the change of shape is the fitted one.
    ///
    /// # Errors
    /// As [`law`](Self::law).
    pub fn compressible(&self, volumetric: impl Into<AnyVolumetric>) -> Result<AnyRubber, FitError> {
        self.model.parse::<AnyModel>()?.compressible(&self.values(), volumetric)
    }

    /// The largest relative RMS residual of the tests.
    #[must_use]
    pub fn worst_relative_rms(&self) -> f64 {
        self.tests.iter().map(|test| test.relative_rms).fold(0.0, f64::max)
    }
}

/// Fits a model to all tests at once.
///
/// What cannot converge still returns the best parameters that were found, with an [`Outcome`] that says so. As many
/// numbers as parameters are fitted without errors: see [`Fit::degrees_of_freedom`].
///
/// # Errors
/// [`FitError::NothingDeformed`] if nothing is deformed in any test, so that the stresses say nothing of any
/// parameter; [`FitError::TooFewPoints`] for fewer numbers than parameters;
/// [`FitError::UnknownParameter`], [`FitError::ImpossibleBounds`],
/// [`FitError::ConfidenceOutOfRange`], [`FitError::NoSuchSign`]; [`FitError::NoStart`] if the model has finite stresses at no start.
///
/// # Accuracy
/// Parameters that are factors: that of linear least squares. Others: to about the root of the rounding of S, ten digits
/// where the data determine them. Intervals suppose small errors, near which the law is linear in its parameters.
///
/// # Example
/// See the [crate].
pub fn fit<M: Model>(model: &M, data: &Data, options: &Options) -> Result<Fit, FitError> {
    fit_until(model, data, options, &|| false)
}

/// The same until `stop` says so; the best parameters until then come with [`Outcome::Interrupted`].
///
/// # Errors
/// As [`fit`].
pub fn fit_until<M: Model>(
    model: &M,
    data: &Data,
    options: &Options,
    stop: &dyn Fn() -> bool,
) -> Result<Fit, FitError> {
    fit_from(model, data, options, None, stop)
}

/// Numbers beyond which starts are first tried on some of them.
const MANY: usize = 600;
/// Starts for a law that another contains.
const FEW_STARTS: usize = 12;

/// From starts of one's own, or those of the model.
fn fit_from<M: Model>(
    model: &M,
    data: &Data,
    options: &Options,
    starts: Option<Vec<Vec<f64>>>,
    stop: &dyn Fn() -> bool,
) -> Result<Fit, FitError> {
    if !(0.0 < options.confidence && options.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: options.confidence });
    }
    check_intervals(options.intervals)?;
    if let Some(first) = data.tests().first().filter(|_| data.tests().iter().all(Test::is_at_rest)) {
        let (test, value) = (first.name().to_owned(), first.abscissas().next().unwrap_or(1.0));
        return Err(FitError::NothingDeformed { test, value });
    }
    let reach = data.largest_first_invariant();
    let parameters = bounded(model, reach, &options.bounds)?;
    let points = data.informative();
    if points < parameters.len() {
        return Err(FitError::TooFewPoints { model: model.name(), points, parameters: parameters.len() });
    }
    let signs = options.stability == Stability::Required;
    let patience = options.patience.clamp(1, MOST_PATIENCE);
    let scales = scales(data, options.weighting);
    let stress = data.tests().iter().map(Test::largest_stress).fold(0.0, f64::max);
    let evaluations = Cell::new(0);
    let problem_on = |data| {
        let weights = (weights(data, &scales), stress);
        Problem::new((model, data), parameters.clone(), weights, signs, patience, (stop, &evaluations))
    };
    let problem = problem_on(data);
    let starts = starts.unwrap_or_else(|| model.starts(reach));
    let few = (MANY < points).then(|| data.thinned(MANY.div_ceil(data.tests().len())));
    let found = match &few {
        Some(few) => problem_on(few).search(&starts).and_then(|(best, agree)| {
            let (best, _) = problem.search(&[problem.start_of(&best)])?;
            Some((best, agree))
        }),
        None => problem.search(&starts),
    };
    let Some((mut best, starts_that_agree)) = found else {
        return Err(FitError::NoStart { model: model.name() });
    };
    let fan = stability::fan(reach);
    // A law without any stress is what such data ask for, and cannot be made stable.
    let loaded = data.tests().iter().flat_map(Test::stresses).any(|stress| 0.0 < stress.abs());
    let no_stiffness = signs && loaded && problem.has_no_stiffness(&best);
    let unstable = signs && loaded && !no_stiffness && !problem.is_stable(&best.parameters, &fan);
    if no_stiffness {
        // At their bounds the factors are at the minimum; beyond it no law is stable.
        best.outcome = Outcome::NoStiffness;
    } else if unstable && let Some(found) = problem.stabilise(&best, &fan) {
        best = found;
    }
    // What is solved directly cannot be worse than what it contains.
    let searched = best.outcome != Outcome::LinearSolution && few.is_none();
    if options.bounds.is_empty() && loaded && (unstable || searched) {
        let linear = Options { intervals: Intervals::Linear, ..options.clone() };
        for (contained, places) in model.contained() {
            let few = contained.starts(reach);
            let few = few.iter().step_by(few.len().div_ceil(FEW_STARTS).max(1)).cloned().collect();
            let Ok(lower) = fit_from(&contained, data, &linear, Some(few), stop) else { continue };
            if lower.weighted_squares < best.squares * (1.0 - 1e-9) && lower.outcome != Outcome::NoStiffness {
                best = problem.not_worse(&Embedding::embed(&places, &lower.values()), lower.weighted_squares, &fan);
            }
        }
    }
    if options.bounds.is_empty() {
        model.order(&mut best.parameters);
    }
    let stability = stability::report(model, &best.parameters, reach);
    Ok(report::result(&problem, options, &best, stability, (starts.len(), starts_that_agree)))
}

/// The most evaluations of a search, for each unknown.
const MOST_PATIENCE: usize = 1_000_000;

/// Refuses bounds that hold no number.
fn check_bounds<M: Model>(model: &M, parameter: &str, [lower, upper]: [f64; 2]) -> Result<(), FitError> {
    if lower <= upper && lower < f64::INFINITY && f64::NEG_INFINITY < upper {
        return Ok(());
    }
    Err(FitError::ImpossibleBounds { model: model.name(), parameter: parameter.to_owned(), lower, upper })
}

/// The parameters of a model within narrower bounds.
fn bounded<M: Model>(model: &M, reach: f64, bounds: &[(String, [f64; 2])]) -> Result<Vec<Parameter>, FitError> {
    let mut parameters = model.parameters(reach);
    for parameter in &parameters {
        check_bounds(model, &parameter.name, parameter.bounds)?;
        if let StableSign::SameAs(index) = parameter.stable
            && parameters.get(index).is_none_or(|other| other.role == Role::Linear)
        {
            let (model, parameter) = (model.name(), parameter.name.clone());
            return Err(FitError::NoSuchSign { model, parameter, index });
        }
    }
    for (name, [low, high]) in bounds {
        let Some(parameter) = parameters.iter_mut().find(|parameter| parameter.name == *name) else {
            return Err(FitError::UnknownParameter { model: model.name(), parameter: name.clone() });
        };
        let [least, greatest] = parameter.bounds;
        let (lower, upper) = (low.max(least), high.min(greatest));
        if low.is_nan() || high.is_nan() {
            let (model, parameter) = (model.name(), name.clone());
            return Err(FitError::ImpossibleBounds { model, parameter, lower, upper });
        }
        check_bounds(model, name, [lower, upper])?;
        parameter.bounds = [lower, upper];
    }
    Ok(parameters)
}

/// The divisor of the residuals of each test.
fn scales(data: &Data, weighting: Weighting) -> Vec<f64> {
    let largest = data.tests().iter().map(Test::largest_stress).fold(0.0, f64::max);
    let scale = |test: &Test| if weighting == Weighting::Equal { largest } else { test.largest_stress() };
    data.tests().iter().map(scale).collect()
}

/// wᵢ of every number; 0 at rest, where no law has a stress.
fn weights(data: &Data, scales: &[f64]) -> Vec<f64> {
    let of_test = |(test, scale): (&Test, &f64)| {
        let weight = test.weight() / scale;
        (0..test.len()).map(|point| if test.informs(point) { weight } else { 0.0 }).collect::<Vec<_>>()
    };
    data.tests().iter().zip(scales).flat_map(of_test).collect()
}
