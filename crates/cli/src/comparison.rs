//! The tables at the end of a fit.

use core::fmt::Write as _;

use piola_measured::fitting::{Comparison, Fit, Measurements, Residuals, SolidParameter, State};

/// Tests with a column of their own, at most.
const SHOWN: usize = 6;

/// Laws with their residuals and criteria, then each law's parameters.
pub(crate) fn table(measurements: &Measurements, comparison: &Comparison) -> String {
    let mut text = String::new();
    let tests = measurements.data.tests();
    let (count, told) = (measurements.data.len(), measurements.data.informative());
    let plural = if tests.len() == 1 { "" } else { "s" };
    let _ = writeln!(text, "{}: {count} stresses in {} test{plural}", measurements.name(), tests.len());
    if told < count {
        let _ = writeln!(text, "  {} of them at rest, where every law has the same: they do not count", count - told);
    }
    for note in &measurements.notes {
        let _ = writeln!(text, "  {note}");
    }
    let fitted = comparison.fits().next().map_or(&[][..], |(_, fit)| fit.tests.as_slice());
    let names: Vec<&str> =
        if fitted.len() <= SHOWN { fitted.iter().map(|test| test.test.as_str()).collect() } else { Vec::new() };
    let widths: Vec<usize> = names.iter().map(|name| name.chars().count().max(10) + 2).collect();
    let _ = write!(text, "\n{:<16}{:>3}", "law", "k");
    for (name, width) in names.iter().zip(&widths) {
        let _ = write!(text, "{name:>width$}");
    }
    let validated = comparison.fits().any(|(_, fit)| !fit.left_out.is_empty());
    let left_out = if validated { format!("{:>11}", "left out") } else { String::new() };
    let _ = writeln!(
        text,
        "{:>12}{:>10}{left_out}{:>10}{:>10}  {:<8}search",
        "worst RMS", "largest", "AICc", "above", "stable"
    );
    let least = comparison.best().and_then(|(_, fit)| fit.criteria.aicc);
    for (law, fit) in comparison.fits() {
        // Parameters that are searched for: those that bounds hold do not count in AICc.
        let searched = fit.parameters.iter().filter(|parameter| parameter.state != State::Held).count();
        let _ = write!(text, "{:<16}{searched:>3}", law.to_string());
        for (test, width) in fit.tests.iter().zip(&widths) {
            let width = width - 2;
            let _ = write!(text, "{:>width$.2} %", 100.0 * test.relative_rms);
        }
        let largest = fit.tests.iter().map(|test| test.relative_largest).fold(0.0, f64::max);
        let _ = write!(text, "{:>10.2} %{:>8.1} %", 100.0 * fit.worst_relative_rms(), 100.0 * largest);
        if validated {
            let _ = match worst(&fit.left_out) {
                Some(rms) if rms < 10.0 => write!(text, "{:>9.1} %", 100.0 * rms),
                Some(_) => write!(text, "{:>11}", "far off"),
                None => write!(text, "{:>11}", "-"),
            };
        }
        let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.1}"));
        let above = fit.criteria.aicc.zip(least).map(|(own, least)| own - least);
        let stable = if fit.stability.is_stable() { "yes" } else { "no" };
        let (aicc, above) = (number(fit.criteria.aicc), number(above));
        let _ = writeln!(text, "{aicc:>10}{above:>10}  {stable:<8}{}", fit.outcome.reason());
    }
    let _ = writeln!(
        text,
        "\nRMS and largest residuals are parts of the largest stress of each test.{}",
        judgement(comparison)
    );
    if validated {
        text.push_str("Left out: the RMS residual of the test that the law predicts worst from all the others.\n");
    }
    text.push('\n');
    for (law, fit) in comparison.fits() {
        let _ = writeln!(text, "{law}");
        if fit.degrees_of_freedom == 0 {
            let _ =
                writeln!(text, "  no degrees of freedom: {told} stresses, as many parameters; errors cannot be told");
        }
        for estimate in &fit.parameters {
            let _ = writeln!(text, "{}", parameter(estimate, measurements.unit.as_deref()));
        }
        let unit = measurements.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
        let (shear, young) = (short(fit.initial_shear_modulus), short(3.0 * fit.initial_shear_modulus));
        let _ = writeln!(text, "  at rest: shear modulus {shear}{unit}, Young's modulus {young}{unit}");
        if let Some(found) = fit.autocorrelation.filter(|found| 1.0 < found.widening) {
            let (rho, widening) = (found.lag_one, found.widening);
            let _ = writeln!(
                text,
                "  neighbouring residuals are correlated ({rho:.2}): intervals are {widening:.1} times those of independent errors"
            );
        }
        for found in &fit.contradictions {
            let ([a, b], [x, y]) = (&found.tests, found.values);
            let name = &found.parameter;
            let _ = writeln!(
                text,
                "  tests contradict each other: alone, {a} asks for {name} = {} and {b} for {}",
                short(x),
                short(y)
            );
        }
        for test in &fit.predicted {
            let (rms, most) = (100.0 * test.relative_rms, 100.0 * test.relative_largest);
            let _ = writeln!(text, "  {}, held out: predicted to {rms:.2} % RMS, {most:.1} % at most", test.test);
        }
        violations(&mut text, fit);
    }
    text.push('\n');
    text
}

/// The largest RMS residual of tests.
fn worst(tests: &[Residuals]) -> Option<f64> {
    tests.iter().map(|test| test.relative_rms).max_by(f64::total_cmp)
}

/// Lines on the best law: how it was chosen, and warnings.
fn judgement(comparison: &Comparison) -> String {
    let Some((best, fit)) = comparison.best() else {
        return " No law has an AICc: that takes at least three\nstresses more than parameters.".to_owned();
    };
    let mut text = format!(" {best} has the least AICc.");
    let rivals: Vec<String> = comparison.rivals().map(|(law, _)| law.to_string()).collect();
    if !rivals.is_empty() {
        let _ = write!(text, "\nThese data do not tell it from {}.", rivals.join(", "));
    }
    if fit.autocorrelation.is_some_and(|found| 1.0 < found.widening) {
        let within = comparison.indifference().unwrap_or(2.0);
        let _ = write!(
            text,
            "\nIts neighbouring residuals are correlated: differences of AICc below {within:.0} say nothing."
        );
    }
    text
}

/// A warning if the stretch is beyond the data.
pub(crate) fn warning(measurements: &Measurements, stretch: f64) -> String {
    let mut text = String::new();
    for test in measurements.data.tests() {
        let (low, high) = test.abscissas().fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        if test.table().mode().is_some() && (high < stretch || stretch < low) {
            let _ = writeln!(
                text,
                "{}: measured from {low} to {high}; at {stretch} the law is a guess, and its band tells only the errors of its parameters",
                test.name()
            );
        }
    }
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
        (_, _, State::Held) => {
            let _ = write!(line, "{unit}  held");
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
