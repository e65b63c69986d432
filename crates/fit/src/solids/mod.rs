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

mod laws;
mod linear;
mod model;
mod search;
mod stability;
mod test;

pub use crate::{Covariance, Criteria, Outcome, student};
pub use laws::{AnyModel, Series};
pub use model::{Fitted, Model, Parameter, Role, StableSign};
pub use stability::{Counterexample, StabilityReport};
pub use test::{Component, Data, Measure, Table, Test};

use piola_solids::{AnySolid, AnyVolumetric};

use crate::FitError;
use crate::statistics::interval;
use search::{Best, Problem};

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
            patience: 200,
        }
    }
}

/// Whether a parameter could be moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum State {
    /// Yes, and the data determine it.
    Determined,
    /// It is at a bound, or at zero where stability asks for a sign.
    AtBound,
    /// The data say nothing of it, or not of it alone.
    Undetermined,
    /// Yes, but there are as many parameters as numbers: what remains says nothing of the error of any.
    NoDegreesOfFreedom,
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
    /// Its standard error, if it is determined and there are degrees of freedom.
    pub standard_error: Option<f64>,
    /// Its confidence interval.
    pub interval: Option<[f64; 2]>,
    /// Whether it could be moved.
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
    /// √(Σ (P − P̂)²/points), in the unit of the stresses.
    pub rms: f64,
    /// The same over the largest stress of the test.
    pub relative_rms: f64,
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
    /// Numbers measured less parameters that could be moved. At 0 there are no errors, intervals or covariance, and
    /// parameters that the data fix are [`State::NoDegreesOfFreedom`].
    pub degrees_of_freedom: usize,
    /// Criteria for choosing between laws.
    pub criteria: Criteria,
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
    pub fn law(&self) -> Result<AnySolid, FitError> {
        self.model.parse::<AnyModel>()?.law(&self.values())
    }

    /// The compressible law whose energy of the change of shape is the fitted one.
    ///
    /// # Errors
    /// As [`law`](Self::law).
    pub fn compressible(&self, volumetric: impl Into<AnyVolumetric>) -> Result<AnySolid, FitError> {
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
    if !(0.0 < options.confidence && options.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: options.confidence });
    }
    if let Some(first) = data.tests().first().filter(|_| data.tests().iter().all(Test::is_at_rest)) {
        let (test, value) = (first.name().to_owned(), first.abscissas().next().unwrap_or(1.0));
        return Err(FitError::NothingDeformed { test, value });
    }
    let reach = data.largest_first_invariant();
    let parameters = bounded(model, reach, &options.bounds)?;
    if data.len() < parameters.len() {
        let (points, parameters) = (data.len(), parameters.len());
        return Err(FitError::TooFewPoints { model: model.name(), points, parameters });
    }
    let signs = options.stability == Stability::Required;
    let weights = weights(data, options.weighting);
    let problem = Problem::new(model, data, parameters, weights, signs, options.patience.clamp(1, MOST_PATIENCE));
    let starts = model.starts(reach);
    let Some((mut best, starts_that_agree)) = problem.search(&starts) else {
        return Err(FitError::NoStart { model: model.name() });
    };
    if options.bounds.is_empty() {
        model.order(&mut best.parameters);
    }
    let mut stability = stability::report(model, &best.parameters, reach);
    // A law without any stress is what such data ask for, and cannot be made stable.
    let loaded = data.tests().iter().flat_map(Test::stresses).any(|stress| 0.0 < stress.abs());
    if signs && loaded && problem.has_no_stiffness(&best) {
        // At their bounds the factors are at the minimum; beyond it no law is stable.
        best.outcome = Outcome::NoStiffness;
    } else if signs && loaded && stability.drucker.is_some() {
        if let Some(found) = problem.stabilise(&best, &stability::fan(reach)) {
            best = found;
        }
        stability = stability::report(model, &best.parameters, reach);
    }
    Ok(result(&problem, options, &best, stability, (starts.len(), starts_that_agree)))
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

/// wᵢ of every number.
fn weights(data: &Data, weighting: Weighting) -> Vec<f64> {
    let largest = data.tests().iter().map(Test::largest_stress).fold(0.0, f64::max);
    let of_test = |test: &Test| {
        let scale = if weighting == Weighting::Equal { largest } else { test.largest_stress() };
        core::iter::repeat_n(test.weight() / scale, test.len())
    };
    data.tests().iter().flat_map(of_test).collect()
}

/// A limit with a standard error this many times its distance from its bound is not determined.
const LOST: f64 = 100.0;

/// Statistics at the end of a search.
fn result<M: Model>(
    problem: &Problem<'_, M>,
    options: &Options,
    best: &Best,
    stability: StabilityReport,
    (starts, starts_that_agree): (usize, usize),
) -> Fit {
    let theta = &best.parameters;
    let (values, slopes) = problem.stresses(theta);
    let at_bound = |k: usize| {
        let scale = if problem.parameters[k].is_stress { problem.stress } else { 1.0 };
        let near = |bound: f64| (theta[k] - bound).abs() <= 1e-9 * bound.abs().max(1e-3 * scale);
        problem.bounds(k, theta).into_iter().any(|bound| bound.is_finite() && near(bound))
    };
    let free: Vec<usize> = (0..theta.len()).filter(|&k| !at_bound(k)).collect();
    let degrees_of_freedom = problem.data.len() - free.len();
    let has_errors = 0 < degrees_of_freedom;
    let variance = if has_errors { best.squares / degrees_of_freedom as f64 } else { 0.0 };
    let all = Covariance::new(&slopes, &free, variance);
    // A limit that has gone off to where it does nothing is not told by the data, and takes no part.
    let lost = |k: usize, error: f64| match problem.parameters[k].bounds {
        [low, high] if low.is_finite() && high.is_infinite() => LOST * (theta[k] - low) < error,
        _ => false,
    };
    let kept = |place: usize, k: usize| !lost(k, all.matrix[place][place].sqrt());
    let told: Vec<usize> =
        all.parameters.iter().enumerate().filter(|&(place, &k)| kept(place, k)).map(|(_, &k)| k).collect();
    let covariance = if told.len() < all.parameters.len() { Covariance::new(&slopes, &told, variance) } else { all };
    let quantile = student(options.confidence, degrees_of_freedom);
    let estimate = |(k, parameter): (usize, &Parameter)| {
        let state = match covariance.parameters.contains(&k) {
            true if has_errors => State::Determined,
            true => State::NoDegreesOfFreedom,
            false if free.contains(&k) => State::Undetermined,
            false => State::AtBound,
        };
        let standard_error = covariance.standard_error(k).filter(|_| has_errors);
        let interval = interval(theta[k], standard_error, quantile);
        let (name, is_stress) = (parameter.name.clone(), parameter.is_stress);
        SolidParameter { name, is_stress, value: theta[k], standard_error, interval, state }
    };
    let mut row = 0;
    let mut tests = Vec::new();
    for test in problem.data.tests() {
        let residuals: Vec<f64> = test
            .stresses()
            .enumerate()
            .map(|(index, stress)| values[row + index] / problem.weights[row + index] - stress)
            .collect();
        row += test.len();
        let rms = (residuals.iter().map(|x| x * x).sum::<f64>() / test.len() as f64).sqrt();
        let largest_stress = test.largest_stress();
        let (points, relative_rms) = (test.len(), rms / largest_stress);
        tests.push(Residuals { test: test.name().to_owned(), points, rms, relative_rms, largest_stress, residuals });
    }
    Fit {
        model: problem.model.name(),
        parameters: problem.parameters.iter().enumerate().map(estimate).collect(),
        tests,
        weighted_squares: best.squares,
        degrees_of_freedom,
        criteria: Criteria::new(problem.data.len(), theta.len(), best.squares),
        stability,
        outcome: best.outcome,
        evaluations: problem.evaluations(),
        starts,
        starts_that_agree,
        covariance: has_errors.then_some(covariance),
    }
}
