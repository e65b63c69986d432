//! Zeros of a function of one variable with its derivative: from a guess, and all in an interval.

use crate::CharacteristicsError;
use crate::check::check_finite;

/// Where covectors are sought: at c in [from, to] along a line, looked at in so many parts.
///
/// Two zeros closer than a part may be missed unless Φ has an extremum that touches or crosses zero there.
///
/// # Example
/// See [`MongeCone`](crate::MongeCone).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Search {
    /// The lower end.
    pub from: f64,
    /// The upper end.
    pub to: f64,
    /// The number of parts, at least one.
    pub parts: usize,
}

impl Search {
    /// Finite ends, and at least one part between them.
    pub(super) fn check(&self) -> Result<(), CharacteristicsError> {
        check_finite("search", &[self.from, self.to])?;
        if self.parts == 0 { Err(CharacteristicsError::TooFewSamples { found: 0, needed: 1 }) } else { Ok(()) }
    }
}

/// The zero of f between a and b, where f has opposite signs: Newton's steps kept inside by bisection.
pub(super) fn zero_between<E>(
    f: &mut impl FnMut(f64) -> Result<(f64, f64), E>,
    (mut a, fa): (f64, f64),
    mut b: f64,
) -> Result<f64, E> {
    let mut c = 0.5 * (a + b);
    for iteration in 0..300 {
        let (value, slope) = f(c)?;
        if value.abs() <= 0.0 {
            return Ok(c);
        }
        if (value < 0.0) == (fa < 0.0) {
            a = c;
        } else {
            b = c;
        }
        let newton = c - value / slope;
        let (low, high) = (a.min(b), a.max(b));
        let next = if low < newton && newton < high && iteration % 8 != 7 { newton } else { 0.5 * (a + b) };
        let resolution = 2.0 * f64::EPSILON * a.abs().max(b.abs());
        if (next - c).abs() <= resolution || high - low <= resolution {
            return Ok(next);
        }
        c = next;
    }
    Ok(c)
}

/// All zeros in the interval of the search, in order: crossings, and extrema that touch zero to the share `touching`
/// of the values about them.
pub(super) fn zeros<E>(
    f: &mut impl FnMut(f64) -> Result<(f64, f64), E>,
    slope: &mut impl FnMut(f64) -> Result<(f64, f64), E>,
    search: Search,
    touching: f64,
) -> Result<Vec<f64>, E> {
    let mut found: Vec<f64> = Vec::new();
    let mut add = |zero: f64| {
        let near = |&z: &f64| (z - zero).abs() <= 1e-9 * (search.to - search.from).abs() / search.parts as f64;
        if !found.iter().any(near) {
            found.push(zero);
        }
    };
    let at = |i: usize| search.from + (search.to - search.from) * (i as f64 / search.parts as f64);
    let mut before = (at(0), f(at(0))?);
    if before.1.0.abs() <= 0.0 {
        add(before.0);
    }
    for i in 1..=search.parts {
        let after = (at(i), f(at(i))?);
        let ((a, (fa, sa)), (b, (fb, sb))) = (before, after);
        if fb.abs() <= 0.0 {
            add(b);
        } else if fa.abs() <= 0.0 {
            // It was counted as the end of the part before.
        } else if (fa < 0.0) != (fb < 0.0) {
            add(zero_between(f, (a, fa), b)?);
        } else if (sa < 0.0) != (sb < 0.0) && (sa < 0.0) == (0.0 < fa) {
            // An extremum towards zero.
            let extremum = zero_between(slope, (a, sa), b)?;
            let value = f(extremum)?.0;
            if value.abs() <= touching * fa.abs().max(fb.abs()) {
                add(extremum);
            } else if (value < 0.0) != (fa < 0.0) {
                add(zero_between(f, (a, fa), extremum)?);
                add(zero_between(f, (extremum, value), b)?);
            }
        }
        before = after;
    }
    Ok(found)
}
