//! The tables at the end of a fit.

use core::fmt::Write as _;

use piola_measured::fitting::{Comparison, Fit, Measurements, SolidParameter, State};

/// Laws with their residuals and criteria, then each law's parameters.
pub(crate) fn table(measurements: &Measurements, comparison: &Comparison) -> String {
    let mut text = String::new();
    let tests = measurements.data.tests();
    let count = measurements.data.len();
    let _ = writeln!(text, "{}: {count} stresses in {} tests\n", measurements.name(), tests.len());
    let _ = write!(text, "{:<16}{:>3}", "law", "k");
    for test in tests {
        let _ = write!(text, "{:>14}", shortened(test.name()));
    }
    let _ = writeln!(text, "{:>10}{:>10}  {:<8}search", "AICc", "above", "stable");
    let least = comparison.best().and_then(|(_, fit)| fit.criteria.aicc);
    for (law, fit) in comparison.fits() {
        let _ = write!(text, "{:<16}{:>3}", law.to_string(), fit.parameters.len());
        for test in &fit.tests {
            let _ = write!(text, "{:>12.2} %", 100.0 * test.relative_rms);
        }
        let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.1}"));
        let above = fit.criteria.aicc.zip(least).map(|(own, least)| own - least);
        let stable = if fit.stability.is_stable() { "yes" } else { "no" };
        let (aicc, above) = (number(fit.criteria.aicc), number(above));
        let _ = writeln!(text, "{aicc:>10}{above:>10}  {stable:<8}{}", fit.outcome.reason());
    }
    let judged = if least.is_some() {
        "The least AICc is the best law for these data."
    } else {
        "No law has an AICc: that takes at least three stresses more than parameters."
    };
    let _ = writeln!(text, "\nRMS residuals are parts of the largest stress of each test. {judged}\n");
    for (law, fit) in comparison.fits() {
        let _ = writeln!(text, "{law}");
        if fit.degrees_of_freedom == 0 {
            let _ =
                writeln!(text, "  no degrees of freedom: {count} stresses, as many parameters; errors cannot be told");
        }
        for estimate in &fit.parameters {
            let _ = writeln!(text, "{}", parameter(estimate, measurements.unit.as_deref()));
        }
        violations(&mut text, fit);
    }
    text.push('\n');
    text
}

/// A parameter with its error and interval.
fn parameter(estimate: &SolidParameter, unit: Option<&str>) -> String {
    let unit = unit.filter(|_| estimate.is_stress).map_or_else(String::new, |unit| format!(" {unit}"));
    let mut line = format!("  {:<8}{:>14}", estimate.name, short(estimate.value));
    match (estimate.standard_error, estimate.interval, estimate.state) {
        (Some(error), Some([low, high]), _) => {
            let _ = write!(line, " ± {:<10}{unit}  [{}, {}]", format!("{error:.1e}"), short(low), short(high));
        }
        (_, _, State::AtBound) => {
            let _ = write!(line, "{unit}  at its bound");
        }
        (_, _, State::NoDegreesOfFreedom) => {
            let _ = write!(line, "{unit}  no error: no degrees of freedom");
        }
        _ => {
            let _ = write!(line, "{unit}  not determined by these data");
        }
    }
    line
}

/// The stretches at which a law is unstable.
fn violations(text: &mut String, fit: &Fit) {
    let conditions = [("Drucker", fit.stability.drucker), ("Baker-Ericksen", fit.stability.baker_ericksen)];
    for (name, worst) in conditions {
        if let Some(worst) = worst {
            let [a, b, c] = worst.stretches;
            let _ = writeln!(text, "  {name}'s condition fails, worst at the stretches {a:.3}, {b:.3}, {c:.3}");
        }
    }
}

/// A number with five digits.
fn short(x: f64) -> String {
    let size = x.abs();
    if size < f64::MIN_POSITIVE {
        "0".to_owned()
    } else if 1e-3 <= size && size < 1e5 {
        let digits = if 100.0 <= size {
            2
        } else if 1.0 <= size {
            4
        } else {
            6
        };
        format!("{x:.digits$}")
    } else {
        format!("{x:.4e}")
    }
}

fn shortened(name: &str) -> String {
    name.chars().take(13).collect()
}
