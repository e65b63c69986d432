//! `summary.json` and the CSV tables of a comparison.

use core::fmt::Write as _;

use piola_fit::solids::{AnyModel, Covariance, Fit, Fitted, Test};
use serde_json::{Value, json};

use super::{Comparison, Measurements};

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
                let mut value = serde_json::to_value(fit).unwrap_or_default();
                value["stable"] = json!(fit.stability.is_stable());
                value["converged"] = json!(fit.outcome.is_converged());
                value["correlation"] = json!(fit.covariance.as_ref().map(Covariance::correlation));
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
        "best_by_aicc": best.map(|(_, fit)| &fit.model),
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

/// Each measured stress with what each law has less it.
pub(super) fn residuals(measurements: &Measurements, comparison: &Comparison) -> String {
    let mut text = format!("test,stretch,{}", stress(measurements));
    for (law, _) in comparison.fits() {
        let _ = write!(text, ",residual of {law}");
    }
    text.push('\n');
    for (index, test) in measurements.data.tests().iter().enumerate() {
        for (point, (x, y)) in test.abscissas().zip(test.stresses()).enumerate() {
            let _ = write!(text, "{},{x:?},{y:?}", test.name());
            for (_, fit) in comparison.fits() {
                let _ = write!(text, ",{:?}", fit.tests[index].residuals[point]);
            }
            text.push('\n');
        }
    }
    text
}

fn stress(measurements: &Measurements) -> String {
    measurements.unit.as_ref().map_or_else(|| "stress".to_owned(), |unit| format!("stress_{unit}"))
}
