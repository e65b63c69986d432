//! Intervals of foams and fibres by fitting anew.

use piola_fit::internal::{Anew, Change, check_intervals, fit_sides_shifted};
use piola_fit::sides::{SidesFit, SidesModel, SidesOptions, SidesResiduals, SidesTest, fit_sides};
use piola_fit::{FitError, Intervals};

/// A fit with intervals of this kind. Before each fit that they take `step` is told the finished part, as far as it is known, and `stop` is
/// asked.
pub(super) fn with_intervals(
    mut fit: SidesFit,
    law: SidesModel,
    tests: &[SidesTest],
    options: &SidesOptions,
    intervals: Intervals,
    (step, stop): (&dyn Fn(f64), &dyn Fn() -> bool),
) -> Result<SidesFit, FitError> {
    check_intervals(intervals)?;
    let weighted: Vec<Vec<f64>> = fit.tests.iter().zip(tests).flat_map(|(found, test)| weighted(found, test)).collect();
    let bounds: Vec<[f64; 2]> = law
        .parameters()
        .into_iter()
        .map(|(name, _, own)| {
            let given = options.bounds.iter().filter(|(given, _)| *given == name);
            given.fold(own, |[low, high], (_, [a, b])| [low.max(*a), high.min(*b)])
        })
        .collect();
    let fitted = Anew {
        values: &fit.values(),
        bounds: &bounds,
        errors: &fit.parameters.iter().map(|parameter| parameter.standard_error).collect::<Vec<_>>(),
        series: &weighted.iter().map(Vec::as_slice).collect::<Vec<_>>(),
        degrees_of_freedom: fit.degrees_of_freedom,
        widening: fit.autocorrelation.map_or(1.0, |found| found.widening),
        confidence: options.confidence,
    };
    let mut made = 0.0;
    let mut again = |change: Change<'_>| {
        if stop() {
            return None;
        }
        made += 1.0;
        step(match (change, intervals) {
            (Change::Held(k, _), _) => k as f64 / fit.parameters.len() as f64,
            (_, Intervals::Bootstrap { samples, .. }) => made / samples as f64,
            _ => 0.0,
        });
        let found = match change {
            Change::Held(k, value) => {
                let held = options.clone().with_bounds(&fit.parameters[k].name, [value; 2]);
                fit_sides(law, tests, &held).ok()?
            }
            Change::Shifted(shift) => fit_sides_shifted(law, tests, options, shift).ok()?,
        };
        Some((found.values(), found.weighted_squares))
    };
    let anew = fitted.intervals(intervals, &mut again, stop);
    for (parameter, interval) in fit.parameters.iter_mut().zip(anew.into_iter().flatten()) {
        parameter.interval = interval;
    }
    Ok(fit)
}

/// What residuals of stresses and of lateral stretches are divided by.
fn scales(test: &SidesTest) -> [f64; 2] {
    let side = test.rows().iter().filter_map(|row| row.2).map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
    [test.largest_stress(), if 0.0 < side { side } else { 1.0 }]
}

/// Residuals over their scales, of the stresses and of the lateral stretches.
fn weighted(found: &SidesResiduals, test: &SidesTest) -> [Vec<f64>; 2] {
    let [stress, side] = scales(test);
    let over = |residuals: &[f64], scale: f64| residuals.iter().map(|x| x / scale).collect();
    [over(&found.stresses, stress), over(&found.laterals, side)]
}
