//! `summary.json` and the CSV tables of a comparison.

use core::fmt::Write as _;

use piola_fit::solids::{AnyModel, Covariance, Fit, Fitted, Measure, Prediction, Test};
use piola_specimens::homogeneous::Mode;
use serde_json::{Value, json};

use super::{Comparison, Measurements};
use crate::MeasuredError;

/// Points of a curve.
const POINTS: u32 = 120;

pub(super) fn summary(measurements: &Measurements, comparison: &Comparison) -> String {
    let best = comparison.best();
    let least = best.and_then(|(_, fit)| fit.criteria.aicc);
    let laws: Vec<Value> = comparison
        .candidates
        .iter()
        .map(|candidate| match &candidate.fit {
            Ok(fit) => {
                // Nothing in a fit can fail to serialise: numbers that are not finite become null.
                let mut value = serde_json::to_value(&fit.fit).unwrap_or_default();
                value["stable"] = json!(fit.stability.is_stable());
                value["converged"] = json!(fit.outcome.is_converged());
                value["correlation"] = json!(fit.covariance.as_ref().map(Covariance::correlation));
                value["contradictions"] = serde_json::to_value(&fit.contradictions).unwrap_or_default();
                value["held_out"] = serde_json::to_value(&fit.predicted).unwrap_or_default();
                value["left_out"] = serde_json::to_value(&fit.left_out).unwrap_or_default();
                value["aicc_above_the_best"] = json!(fit.criteria.aicc.zip(least).map(|(own, least)| own - least));
                value
            }
            Err(error) => json!({ "model": candidate.model.to_string(), "failure": error.to_string() }),
        })
        .collect();
    let tests: Vec<Value> = measurements
        .data
        .tests()
        .iter()
        .map(|test| {
            json!({
                "name": test.name(),
                "points": test.len(),
                "measure": test.measure(),
                "largest_stress": test.largest_stress(),
            })
        })
        .collect();
    let summary = json!({
        "data": measurements.path.display().to_string(),
        "stress_unit": measurements.unit,
        "tests": tests,
        "read": measurements.notes,
        "best_by_aicc": best.map(|(_, fit)| &fit.model),
        "not_told_apart_from_the_best": comparison.rivals().map(|(law, _)| law.to_string()).collect::<Vec<_>>(),
        "interrupted": comparison.interrupted,
        "laws": laws,
    });
    let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
    text.push('\n');
    text
}

/// The stretches of a curve, from rest to the ends of the test.
pub(super) fn stretches(test: &Test) -> Vec<f64> {
    let Some((mode, _)) = test.table().mode() else { return Vec::new() };
    let low = test.abscissas().fold(mode.rest(), f64::min);
    let high = test.abscissas().fold(mode.rest(), f64::max);
    (0..=POINTS).map(|k| low + (high - low) * f64::from(k) / f64::from(POINTS)).collect()
}

/// The curve of a fit in a test: nothing for a table of components.
pub(super) fn curve(law: AnyModel, fit: &Fit, test: &Test) -> Vec<(f64, f64)> {
    let stretches = stretches(test);
    let law = Fitted::new(&law, fit.values()).ok();
    let stresses = law.and_then(|law| test.curve(&stretches, &law)).unwrap_or_default();
    stretches.into_iter().zip(stresses).collect()
}

/// `law,test,stretch,stress`.
pub(super) fn curves(measurements: &Measurements, comparison: &Comparison) -> String {
    let mut text = format!("law,test,stretch,{}\n", stress(measurements));
    for (law, fit) in comparison.fits() {
        for test in measurements.data.tests() {
            for (x, y) in curve(law, fit, test) {
                let _ = writeln!(text, "{law},{},{x:?},{y:?}", test.name());
            }
        }
    }
    text
}

/// `law,mode,stretch,stress,low,high,beyond the data`.
pub(super) fn predictions(
    measurements: &Measurements,
    comparison: &Comparison,
    reach: f64,
) -> Result<String, MeasuredError> {
    if !(0.0 < reach && reach.is_finite()) {
        return Err(MeasuredError::Argument { argument: format!("{reach}"), valid: "a stretch above 0, as 5" });
    }
    let mut text = format!("law,mode,stretch,{},low,high,beyond the data\n", stress(measurements));
    let mut modes: Vec<(Mode, f64, f64)> = Vec::new();
    for test in measurements.data.tests() {
        let Some((mode, _)) = test.table().mode() else { continue };
        let low = test.abscissas().fold(mode.rest(), f64::min);
        let high = test.abscissas().fold(mode.rest(), f64::max);
        match modes.iter_mut().find(|(other, _, _)| *other == mode) {
            Some((_, least, most)) => (*least, *most) = (least.min(low), most.max(high)),
            None => modes.push((mode, low, high)),
        }
    }
    for (law, fit) in comparison.fits() {
        for &(mode, low, high) in &modes {
            let rest = mode.rest();
            let stretches: Vec<f64> =
                (0..=POINTS).map(|k| rest + (reach - rest) * f64::from(k) / f64::from(POINTS)).collect();
            for found in law.predict(&fit.fit, mode, Measure::FirstPiola, &stretches)? {
                let Prediction { stretch, stress, half_width, .. } = found;
                let band = half_width
                    .map_or_else(|| ",".to_owned(), |half| format!("{:?},{:?}", stress - half, stress + half));
                let beyond = stretch < low || high < stretch;
                let _ = writeln!(text, "{law},{},{stretch:?},{stress:?},{band},{}", mode.name(), u8::from(beyond));
            }
        }
    }
    Ok(text)
}

/// Each measured stress with what each law has less it.
pub(super) fn residuals(measurements: &Measurements, comparison: &Comparison) -> String {
    let mut text = format!("test,stretch,{}", stress(measurements));
    for (law, _) in comparison.fits() {
        let _ = write!(text, ",residual of {law}");
    }
    text.push('\n');
    for test in measurements.data.tests().iter().chain(&measurements.held_out) {
        for (point, (x, y)) in test.abscissas().zip(test.stresses()).enumerate() {
            let _ = write!(text, "{},{x:?},{y:?}", test.name());
            for (_, fit) in comparison.fits() {
                let mut all = fit.tests.iter().chain(&fit.predicted);
                let found = all.find(|found| found.test == test.name());
                let residual = found.and_then(|found| found.residuals.get(point)).copied().unwrap_or(f64::NAN);
                let _ = write!(text, ",{residual:?}");
            }
            text.push('\n');
        }
    }
    text
}

fn stress(measurements: &Measurements) -> String {
    measurements.unit.as_ref().map_or_else(|| "stress".to_owned(), |unit| format!("stress_{unit}"))
}
