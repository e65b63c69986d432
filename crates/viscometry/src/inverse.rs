//! The drive for a wanted answer.

use crate::{Estimate, ViscometryError};

/// The wanted answer, for errors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    pub(crate) flow: &'static str,
    pub(crate) quantity: &'static str,
    /// 0 < value.
    pub(crate) value: f64,
}

/// The misfit from which one step of Newton's method leaves rounding only.
const NEAR: f64 = 1e-9;

/// The `excess` > 0 at which an increasing answer is the wanted one: Newton's method on logarithms, in a bracket that shrinks.
///
/// `answer` gives the value and its derivative by the excess. Where it refuses (no rate at that stress) the excess was too large.
pub(crate) fn solve(
    wanted: Wanted,
    start: f64,
    mut answer: impl FnMut(f64) -> Result<(f64, f64), ViscometryError>,
) -> Result<f64, ViscometryError> {
    let target = wanted.value;
    let start = if start.is_finite() && start > 0.0 { start } else { 1.0 };
    // Logarithms are counted from the start: there they are small and keep their digits.
    let (mut x, mut low, mut high) = (0.0_f64, f64::NEG_INFINITY, f64::INFINITY);
    let mut refused = None;
    let mut best = (f64::INFINITY, 0.0);
    for _ in 0..200 {
        let excess = start * x.exp();
        let (misfit, slope) = match answer(excess) {
            Ok((value, derivative)) if value.is_finite() => ((value / target).ln(), derivative * (excess / value)),
            Ok(_) => (f64::INFINITY, f64::NAN),
            Err(error) => {
                refused = Some(error);
                (f64::INFINITY, f64::NAN)
            }
        };
        if misfit.abs() < best.0 {
            best = (misfit.abs(), x);
        }
        if misfit < 0.0 {
            low = x;
        } else {
            high = x;
        }
        let step = misfit / slope;
        let newton = x - step;
        let next = if step.is_finite() && low <= newton && newton <= high {
            // The next misfit is of the order of the square of this one.
            if misfit.abs() <= NEAR {
                return Ok(start * newton.exp());
            }
            newton
        } else if low.is_finite() && high.is_finite() {
            0.5 * (low + high)
        } else if misfit < 0.0 {
            x + 3.0 * (1.0 + x.abs())
        } else {
            x - 3.0 * (1.0 + x.abs())
        };
        let settled = (next - x).abs() <= 2.0 * f64::EPSILON * (1.0 + x.abs());
        x = next;
        if settled || x.abs() > 1400.0 {
            break;
        }
    }
    if best.0 <= 1e-11 {
        return Ok(start * (if (x - best.1).abs() <= 1e-11 { x } else { best.1 }).exp());
    }
    Err(refused.unwrap_or(ViscometryError::NoDrive { flow: wanted.flow, quantity: wanted.quantity, value: target }))
}

/// Error bound of a drive found for a wanted answer: (residual of the answer + its error)/slope; infinite where the answer does not rise.
///
/// `least` is the drive below which nothing is sheared; `answer` is the answer to a drive 0 < d.
pub(crate) fn drive_error(
    drive: f64,
    least: f64,
    wanted: f64,
    answer: impl Fn(f64) -> Result<Estimate, ViscometryError>,
) -> Result<f64, ViscometryError> {
    /// A step whose square is beside one what the slope may be off.
    const STEP: f64 = 1e-4;
    let (drive, wanted) = (drive.abs(), wanted.abs());
    if drive <= 0.0 {
        return Ok(0.0);
    }
    let at = answer(drive)?;
    let missed = (at.value.abs() - wanted).abs() + at.error;
    let step = STEP * if least < drive { drive - least } else { drive };
    let rise = answer(drive + step)?.value.abs() - answer(drive - step)?.value.abs();
    if rise <= 0.0 {
        return Ok(f64::INFINITY);
    }
    // The drive is a number of a few roundings itself.
    Ok(missed * (2.0 * step / rise) + 4.0 * f64::EPSILON * drive)
}

/// The number at which an increasing function changes sign, between two at which it has opposite ones.
///
/// Bisection in company with secants of weighted ends (Illinois).
pub(crate) fn zero(
    mut low: f64,
    mut high: f64,
    mut function: impl FnMut(f64) -> Result<f64, ViscometryError>,
) -> Result<f64, ViscometryError> {
    let (mut below, mut above) = (function(low)?, function(high)?);
    if below >= 0.0 {
        return Ok(low);
    }
    if above <= 0.0 {
        return Ok(high);
    }
    let mut side = 0;
    let mut width = high - low;
    let mut last = f64::NAN;
    for round in 0..200 {
        let secant = low + (high - low) * (below / (below - above));
        // Secants that do not halve the bracket in eight rounds yield to the middle.
        let stalls = round % 8 == 7 && high - low > 0.5 * width;
        if round % 8 == 7 {
            width = high - low;
        }
        let x = if stalls || !(low < secant && secant < high) { 0.5 * (low + high) } else { secant };
        // Secants gain digits from step to step: where two agree the bracket need not shrink about them.
        let agree = (x - last).abs() <= 4.0 * f64::EPSILON * x.abs();
        if agree || x <= low || high <= x {
            return Ok(x);
        }
        last = x;
        let value = function(x)?;
        if value == 0.0 {
            return Ok(x);
        }
        if value < 0.0 {
            (low, below) = (x, value);
            if side < 0 {
                above *= 0.5;
            }
            side = -1;
        } else {
            (high, above) = (x, value);
            if side > 0 {
                below *= 0.5;
            }
            side = 1;
        }
    }
    Ok(0.5 * (low + high))
}
