//! Statistics at the end of a search.

use super::search::{Best, Problem};
use super::{
    Fit, Intervals, Model, Options, Outcome, Parameter, Residuals, SolidParameter, StabilityReport, State, stability,
};
use crate::anew::{Anew, Change};
use crate::statistics::{Autocorrelation, Covariance, Criteria, interval, profile, student};

/// A limit with an interval this many times its distance from its bound is not determined.
const LOST: f64 = 9.2;

pub(super) fn result<M: Model>(
    problem: &Problem<'_, M>,
    options: &Options,
    best: &Best,
    stability: StabilityReport,
    (starts, starts_that_agree): (usize, usize),
) -> Fit {
    let theta = &best.parameters;
    let (values, slopes) = problem.stresses(theta);
    let tests = residuals(problem, values.as_slice());
    let points = problem.data.informative();
    let at_bound = |k: usize| {
        let scale = if problem.parameters[k].is_stress { problem.stress } else { 1.0 };
        let near = |bound: f64| (theta[k] - bound).abs() <= 1e-9 * bound.abs().max(1e-3 * scale);
        problem.bounds(k, theta).into_iter().any(|bound| bound.is_finite() && near(bound))
    };
    let free: Vec<usize> = (0..theta.len()).filter(|&k| !at_bound(k)).collect();
    let degrees_of_freedom = points - free.len();
    let has_errors = 0 < degrees_of_freedom;
    let variance = if has_errors { best.squares / degrees_of_freedom as f64 } else { 0.0 };
    let autocorrelation = autocorrelation(problem, &tests).filter(|_| 1e-9 < variance.sqrt());
    let widening = autocorrelation.map_or(1.0, |found| found.widening);
    let quantile = student(options.confidence, degrees_of_freedom).map(|t| t * widening);
    let all = Covariance::new(&slopes, &free, variance);
    // A limit that has gone off to where it does nothing is not told by the data, and takes no part.
    let lost = |k: usize, error: f64| match problem.parameters[k].bounds {
        [low, high] if low.is_finite() && high.is_infinite() => {
            LOST * (theta[k] - low) < quantile.unwrap_or(2.0) * error
        }
        _ => false,
    };
    let kept = |place: usize, k: usize| !lost(k, all.matrix[place][place].sqrt());
    let told: Vec<usize> =
        all.parameters.iter().enumerate().filter(|&(place, &k)| kept(place, k)).map(|(_, &k)| k).collect();
    let covariance = if told.len() < all.parameters.len() { Covariance::new(&slopes, &told, variance) } else { all };
    let estimate = |(k, parameter): (usize, &Parameter)| {
        let state = match covariance.parameters.contains(&k) {
            _ if is_held(parameter) => State::Held,
            true if has_errors => State::Determined,
            true => State::NoDegreesOfFreedom,
            false if free.contains(&k) => State::Undetermined,
            false => State::AtBound,
        };
        let standard_error = covariance.standard_error(k).filter(|_| has_errors);
        let bounds = problem.bounds(k, theta);
        let interval = standard_error.zip(quantile).map(|(error, quantile)| {
            // That of the bootstrap comes for all parameters at once; the linear one stays where the profile is interrupted.
            let profile = (options.intervals == Intervals::Profile).then(|| {
                let limit = best.squares + quantile * quantile * variance;
                let mut squares = |value: f64| problem.again(Change::Held(k, value), best).map(|(_, squares)| squares);
                profile(theta[k], bounds, error, (best.squares, limit), &mut squares)
            });
            let is_whole = |_: &[f64; 2]| !(problem.stop)();
            profile.filter(is_whole).unwrap_or_else(|| interval(theta[k], bounds, quantile * error))
        });
        let (name, is_stress) = (parameter.name.clone(), parameter.is_stress);
        SolidParameter { name, is_stress, value: theta[k], standard_error, interval, state }
    };
    let evaluations = problem.evaluations();
    let mut parameters: Vec<SolidParameter> = problem.parameters.iter().enumerate().map(estimate).collect();
    let freedom = (degrees_of_freedom, widening);
    resample(problem, best, &mut parameters, (options, values.as_slice()), freedom);
    let is_interrupted = options.intervals != Intervals::Linear && (problem.stop)();
    Fit {
        model: problem.model.name(),
        parameters,
        tests,
        weighted_squares: best.squares,
        degrees_of_freedom,
        criteria: Criteria::new(
            points,
            problem.parameters.iter().filter(|parameter| !is_held(parameter)).count(),
            best.squares,
        ),
        autocorrelation,
        confidence: options.confidence,
        // W = μ ε:ε at rest.
        initial_shear_modulus: 0.5 * stability::least_modulus(problem.model, [0.0; 3], theta),
        stability,
        outcome: if is_interrupted { Outcome::Interrupted } else { best.outcome },
        evaluations,
        starts,
        starts_that_agree,
        covariance: has_errors.then_some(covariance),
    }
}

/// Intervals by the bootstrap, where they are asked for. Numbers at rest are not drawn.
fn resample<M: Model>(
    problem: &Problem<'_, M>,
    best: &Best,
    parameters: &mut [SolidParameter],
    (options, values): (&Options, &[f64]),
    (degrees_of_freedom, widening): (usize, f64),
) {
    if !matches!(options.intervals, Intervals::Bootstrap { .. }) || degrees_of_freedom == 0 {
        return;
    }
    let mut row = 0;
    let (mut series, mut places) = (Vec::new(), Vec::new());
    for test in problem.data.tests() {
        // In the order of the stretches, as neighbours are.
        let mut points: Vec<(f64, usize)> =
            test.abscissas().zip(row..).filter(|(_, i)| 0.0 < problem.weights[*i]).collect();
        if test.table().mode().is_some() {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let stresses: Vec<f64> = test.stresses().collect();
        let residual = |i: usize| values[i] - problem.weights[i] * stresses[i - row];
        series.push(points.iter().map(|(_, i)| residual(*i)).collect::<Vec<f64>>());
        places.extend(points.into_iter().map(|(_, i)| i));
        row += test.len();
    }
    let fitted = Anew {
        values: &best.parameters,
        bounds: &(0..parameters.len()).map(|k| problem.bounds(k, &best.parameters)).collect::<Vec<_>>(),
        errors: &parameters.iter().map(|parameter| parameter.standard_error).collect::<Vec<_>>(),
        series: &series.iter().map(Vec::as_slice).collect::<Vec<_>>(),
        degrees_of_freedom,
        widening,
        confidence: options.confidence,
    };
    let mut shifts = vec![0.0; row];
    let mut again = |change: Change<'_>| {
        let Change::Shifted(of_points) = change else { return None };
        places.iter().zip(of_points).for_each(|(place, shift)| shifts[*place] = *shift);
        let (mut values, squares) = problem.again(Change::Shifted(&shifts), best)?;
        problem.model.order(&mut values);
        Some((values, squares))
    };
    let anew = fitted.intervals(options.intervals, &mut again, problem.stop);
    for (parameter, interval) in parameters.iter_mut().zip(anew.into_iter().flatten()) {
        parameter.interval = interval;
    }
}

/// Whether the bounds of a parameter leave one value.
fn is_held(parameter: &Parameter) -> bool {
    parameter.bounds[1] <= parameter.bounds[0]
}

/// Residuals of each test from weighted stresses.
fn residuals<M: Model>(problem: &Problem<'_, M>, values: &[f64]) -> Vec<Residuals> {
    let mut row = 0;
    let mut tests = Vec::new();
    for test in problem.data.tests() {
        let residual = |(index, stress): (usize, f64)| {
            let weight = problem.weights[row + index];
            if 0.0 < weight { values[row + index] / weight - stress } else { -stress }
        };
        let residuals: Vec<f64> = test.stresses().enumerate().map(residual).collect();
        tests.push(Residuals::new(test, residuals));
        row += test.len();
    }
    tests
}

impl Residuals {
    /// Of a test, from P − P̂ of each point.
    pub(super) fn new(test: &super::Test, residuals: Vec<f64>) -> Self {
        let told: Vec<f64> =
            residuals.iter().enumerate().filter(|(point, _)| test.informs(*point)).map(|(_, x)| *x).collect();
        let rms = (told.iter().map(|x| x * x).sum::<f64>() / told.len().max(1) as f64).sqrt();
        let largest_stress = test.largest_stress();
        let relative_largest = told.iter().fold(0.0_f64, |most, x| most.max(x.abs())) / largest_stress;
        let (points, relative_rms) = (test.len(), rms / largest_stress);
        Self { test: test.name().to_owned(), points, rms, relative_rms, relative_largest, largest_stress, residuals }
    }
}

/// Of weighted residuals in the order of the stretches of each test.
fn autocorrelation<M: Model>(problem: &Problem<'_, M>, tests: &[Residuals]) -> Option<Autocorrelation> {
    let mut row = 0;
    let mut series: Vec<Vec<f64>> = Vec::new();
    for (test, found) in problem.data.tests().iter().zip(tests) {
        let weights = &problem.weights[row..row + test.len()];
        row += test.len();
        let mut points: Vec<(f64, f64)> = test
            .abscissas()
            .zip(&found.residuals)
            .zip(weights)
            .filter(|(_, weight)| 0.0 < **weight)
            .map(|((x, residual), weight)| (x, residual * weight))
            .collect();
        if test.table().mode().is_some() {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        series.push(points.into_iter().map(|(_, residual)| residual).collect());
    }
    Autocorrelation::of(series.iter().map(Vec::as_slice))
}
