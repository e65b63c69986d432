//! Ticks of logarithmic axes: decades where there are several, otherwise 1, 2 and 5 of each.

use core::ops::Range;

use plotters::coord::combinators::{BindKeyPoints, IntoLogRange, LogCoord, WithKeyPoints};

use crate::figure::{format_short, power_of_ten};

/// Decades from which on only powers of ten are marked.
const DECADES: f64 = 2.5;
/// Ticks, at most.
const MOST: usize = 8;

/// A logarithmic axis with its ticks.
pub(crate) fn logarithmic(range: Range<f64>) -> WithKeyPoints<LogCoord<f64>> {
    let points = marks(range.start, range.end);
    range.log_scale().with_key_points(points)
}

/// The marks between two positive numbers.
fn marks(low: f64, high: f64) -> Vec<f64> {
    let decades = (high / low).log10();
    if !decades.is_finite() {
        return Vec::new();
    }
    let multiples: &[f64] = if DECADES < decades { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let mut found = Vec::new();
    let mut power = low.log10().floor();
    while power <= high.log10() {
        found.extend(
            multiples.iter().map(|multiple| multiple * 10.0_f64.powf(power)).filter(|x| low <= *x && *x <= high),
        );
        power += 1.0;
    }
    let stride = found.len().div_ceil(MOST).max(1);
    let mut found: Vec<f64> = found.into_iter().step_by(stride).collect();
    if found.len() < 2 {
        // A narrow range has round numbers between 1, 2 and 5.
        let step = 10.0_f64.powf((high - low).log10().floor());
        let step = if (high - low) < 3.0 * step { 0.5 * step } else { step };
        let mut x = (low / step).ceil() * step;
        found.clear();
        while x <= high && found.len() < MOST {
            found.push(x);
            x += step;
        }
    }
    found
}

/// 10⁻³ for a power of ten beyond the usual numbers, 0.05 or 2·10⁴ otherwise.
pub(crate) fn label(x: f64) -> String {
    let power = x.log10().round();
    let multiple = x / 10.0_f64.powf(power);
    if (multiple - 1.0).abs() < 1e-9 {
        return power_of_ten(x);
    }
    if (1e-2..1e4).contains(&x) {
        return format_short(x);
    }
    let power = x.log10().floor();
    format!("{}·{}", format_short(x / 10.0_f64.powf(power)), power_of_ten(10.0_f64.powf(power)))
}

#[cfg(test)]
mod tests {
    use super::{label, marks};

    #[test]
    fn every_range_has_ticks() {
        for (low, high) in [(0.9, 12.0), (3.0, 5.0), (31.0, 42.0), (1e-3, 1e5), (1.1e-9, 1.3e-9), (4.1, 4.3)] {
            let found = marks(low, high);
            assert!(2 <= found.len() && found.iter().all(|x| low <= *x && *x <= high), "{low} {high}: {found:?}");
        }
        assert_eq!(marks(0.8, 12.0).len(), 4);
        assert_eq!([10.0, 0.05, 2e4, 5e-7].map(label), ["10¹", "0.05", "2·10⁴", "5·10⁻⁷"]);
    }
}
