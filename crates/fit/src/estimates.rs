//! Statistics of fitted parameters: errors, intervals, criteria; and bounds given by name.

use nalgebra::DMatrix;

#[cfg(feature = "solids")]
use crate::FitError;
use crate::State;
#[cfg(feature = "solids")]
use crate::search::Range;
#[cfg(feature = "solids")]
use crate::solids::SolidParameter;
use crate::statistics::{Autocorrelation, Covariance, Criteria, interval, student};

/// A parameter's error and interval, and what the data say of it.
pub(crate) struct ParameterEstimate {
    pub(crate) standard_error: Option<f64>,
    pub(crate) interval: Option<[f64; 2]>,
    pub(crate) state: State,
}

/// Estimates of all parameters, and statistics of the fit.
pub(crate) struct FitStatistics {
    pub(crate) parameters: Vec<ParameterEstimate>,
    pub(crate) degrees_of_freedom: usize,
    pub(crate) criteria: Criteria,
    pub(crate) autocorrelation: Option<Autocorrelation>,
}

/// Errors, intervals and criteria from the parameter values, their bounds, whether each is at a bound, the derivatives of the residuals by
/// all parameters, and the residuals as series of neighbours. Equal bounds hold a parameter: it does not count in the criteria.
pub(crate) fn statistics_of(
    theta: &[f64],
    bounds: &[[f64; 2]],
    at_bound: &[bool],
    slopes: &DMatrix<f64>,
    series: &[&[f64]],
    confidence: f64,
) -> FitStatistics {
    let points: usize = series.iter().map(|residuals| residuals.len()).sum();
    let squares: f64 = series.iter().flat_map(|residuals| residuals.iter()).map(|r| r * r).sum();
    let is_held = |k: usize| bounds[k][1] <= bounds[k][0];
    let free: Vec<usize> = (0..theta.len()).filter(|&k| !at_bound[k]).collect();
    let degrees_of_freedom = points - free.len();
    let has_errors = 0 < degrees_of_freedom;
    let variance = if has_errors { squares / degrees_of_freedom as f64 } else { 0.0 };
    let autocorrelation = Autocorrelation::of(series.iter().copied()).filter(|_| 1e-9 < variance.sqrt());
    let widening = autocorrelation.map_or(1.0, |found| found.widening);
    let quantile = student(confidence, degrees_of_freedom).map(|t| t * widening);
    let covariance = Covariance::new(slopes, &free, variance);
    let told = |k: usize| {
        let standard_error = covariance.standard_error(k).filter(|_| has_errors);
        let half = standard_error.zip(quantile).map(|(error, quantile)| quantile * error);
        let is_lost = half.is_some_and(|half| widest(theta[k], bounds[k]) <= half);
        let state = if is_held(k) {
            State::Held
        } else {
            match covariance.parameters.contains(&k) && !is_lost {
                true if has_errors => State::Determined,
                true => State::NoDegreesOfFreedom,
                false if at_bound[k] => State::AtBound,
                false => State::Undetermined,
            }
        };
        let standard_error = standard_error.filter(|_| !is_lost);
        let interval = half.filter(|_| !is_lost).map(|half| interval(theta[k], bounds[k], half));
        ParameterEstimate { standard_error, interval, state }
    };
    FitStatistics {
        parameters: (0..theta.len()).map(told).collect(),
        degrees_of_freedom,
        criteria: Criteria::new(points, (0..theta.len()).filter(|&k| !is_held(k)).count(), squares),
        autocorrelation,
    }
}

/// Parameters of a solid with their errors, and what else the residuals say.
#[cfg(feature = "solids")]
pub(crate) struct Estimates {
    pub(crate) parameters: Vec<SolidParameter>,
    pub(crate) degrees_of_freedom: usize,
    pub(crate) criteria: Criteria,
    pub(crate) autocorrelation: Option<Autocorrelation>,
}

/// Estimates from the names with whether each is a stress, the parameter values, their ranges, the derivatives of the residuals by all
/// parameters, and the residuals as series of neighbours.
#[cfg(feature = "solids")]
pub(crate) fn estimates(
    names: &[(String, bool)],
    theta: &[f64],
    ranges: &[Range],
    slopes: &DMatrix<f64>,
    series: &[&[f64]],
    confidence: f64,
) -> Estimates {
    let is_at_bound = |k: usize| {
        let Range { bounds: [low, high], least } = ranges[k];
        let near = |bound: f64| {
            let width =
                if (high - low).is_finite() { 1e-8 * (high - low) } else { (1e-7 * bound.abs()).max(0.1 * least) };
            bound.is_finite() && (theta[k] - bound).abs() <= width
        };
        ranges[k].is_fixed() || near(low) || near(high)
    };
    let at_bound: Vec<bool> = (0..theta.len()).map(is_at_bound).collect();
    let bounds: Vec<[f64; 2]> = ranges.iter().map(|range| range.bounds).collect();
    let FitStatistics { parameters, degrees_of_freedom, criteria, autocorrelation } =
        statistics_of(theta, &bounds, &at_bound, slopes, series, confidence);
    let named = |((found, (name, is_stress)), value): ((ParameterEstimate, &(String, bool)), &f64)| {
        let ParameterEstimate { standard_error, interval, state } = found;
        SolidParameter { name: name.clone(), is_stress: *is_stress, value: *value, standard_error, interval, state }
    };
    let parameters = parameters.into_iter().zip(names).zip(theta).map(named).collect();
    Estimates { parameters, degrees_of_freedom, criteria, autocorrelation }
}

/// The half width of an interval beyond which data do not tell the order of magnitude of the distance to a single bound, nor where in
/// a range between two bounds a parameter is.
fn widest(value: f64, [low, high]: [f64; 2]) -> f64 {
    /// Of the logarithm of the distance: four orders of magnitude.
    const LOST: f64 = 9.2;
    match (low.is_finite(), high.is_finite()) {
        (true, true) => high - low,
        (true, false) => LOST * (value - low),
        (false, true) => LOST * (high - value),
        (false, false) => f64::INFINITY,
    }
}

/// Ranges of parameters, narrowed by bounds given by name.
///
/// # Errors
/// [`FitError::UnknownParameter`], [`FitError::ImpossibleBounds`].
#[cfg(feature = "solids")]
pub(crate) fn narrowed(
    model: &str,
    names: &[(String, bool)],
    mut ranges: Vec<Range>,
    bounds: &[(String, [f64; 2])],
) -> Result<Vec<Range>, FitError> {
    for (parameter, [low, high]) in bounds {
        let Some(k) = names.iter().position(|(name, _)| name == parameter) else {
            return Err(FitError::UnknownParameter { model: model.to_owned(), parameter: parameter.clone() });
        };
        let [lower, upper] = [low.max(ranges[k].bounds[0]), high.min(ranges[k].bounds[1])];
        // The larger of NaN and a number is the number.
        let holds_a_number = !low.is_nan() && !high.is_nan() && lower <= upper && lower < f64::INFINITY;
        if !holds_a_number {
            let (model, parameter) = (model.to_owned(), parameter.clone());
            return Err(FitError::ImpossibleBounds { model, parameter, lower, upper });
        }
        ranges[k].bounds = [lower, upper];
    }
    Ok(ranges)
}
