//! How far two lists of numbers are apart.

use crate::Tol;

/// Largest modulus; NaN when an element is NaN, so that NaN is never taken for small.
fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest: f64, x| if x.is_nan() || largest < x.abs() { x.abs() } else { largest })
}

fn largest_difference(actual: &[f64], expected: &[f64]) -> f64 {
    // Equal infinities are no difference; any other non-finite pair is an infinite one.
    largest(actual.iter().zip(expected).map(|(a, e)| {
        let difference = a - e;
        if difference.is_finite() {
            difference
        } else if a.is_infinite() && a.to_bits() == e.to_bits() {
            0.0
        } else {
            f64::INFINITY
        }
    }))
}

/// Asserts max|aᵢ − eᵢ| ≤ tol · max|eᵢ|. Where all eᵢ are zero the tolerance is absolute.
///
/// # Panics
/// When the lengths differ, the difference is larger or a number is NaN.
#[track_caller]
pub fn assert_close(what: &str, actual: &[f64], expected: &[f64], tol: Tol) {
    let largest_expected = largest(expected.iter().copied());
    let scale = if 0.0 < largest_expected { largest_expected } else { 1.0 };
    check(what, actual, expected, scale, tol);
}

/// Asserts max|aᵢ − eᵢ| ≤ tol · max(max|eᵢ|, `scale`): for results whose terms, of size `scale`, cancel.
///
/// # Panics
/// When the lengths differ, the difference is larger or a number is NaN.
#[track_caller]
pub fn assert_close_at_scale(what: &str, actual: &[f64], expected: &[f64], scale: f64, tol: Tol) {
    check(what, actual, expected, largest(expected.iter().copied()).max(scale), tol);
}

/// Asserts |aᵢ − eᵢ| ≤ tol · |eᵢ| for each i: for components of different units or sizes. Where eᵢ is zero aᵢ must be, too.
///
/// # Panics
/// When the lengths differ, a difference is larger or a number is NaN.
///
/// # Example
/// ```
/// use piola_testkit::{Tol, assert_each_close};
/// // A position of 10⁷ m beside a mass of 1 kg: by the largest component the mass could be anything.
/// assert_each_close("state", &[1e7, 1.0], &[1e7, 1.0 + f64::EPSILON], Tol::ulps(1.0));
/// ```
#[track_caller]
pub fn assert_each_close(what: &str, actual: &[f64], expected: &[f64], tol: Tol) {
    assert_each_close_at_scales(what, actual, expected, &vec![0.0; expected.len()], tol);
}

/// Asserts |aᵢ − eᵢ| ≤ tol · max(|eᵢ|, sᵢ) for each i: for components whose terms, of sizes sᵢ, cancel.
///
/// # Panics
/// When the lengths differ, a difference is larger or a number is NaN.
#[track_caller]
pub fn assert_each_close_at_scales(what: &str, actual: &[f64], expected: &[f64], scales: &[f64], tol: Tol) {
    assert_eq!((actual.len(), scales.len()), (expected.len(), expected.len()), "{what}: the lengths differ");
    for (i, ((a, e), scale)) in actual.iter().zip(expected).zip(scales).enumerate() {
        let scale = if e.is_finite() { e.abs().max(*scale) } else { 1.0 };
        let difference = largest_difference(&[*a], &[*e]);
        assert!(
            difference <= tol.value() * scale,
            "{what}: component {i} is off by {difference:.3e} of {scale:e}, more than {tol}\n  actual   {actual:?}\n  \
             expected {expected:?}",
        );
    }
}

#[track_caller]
fn check(what: &str, actual: &[f64], expected: &[f64], scale: f64, tol: Tol) {
    assert_eq!(actual.len(), expected.len(), "{what}: the lengths differ");
    // An infinite reference has no scale: only equality is close to it.
    let scale = if scale.is_finite() { scale } else { 1.0 };
    let difference = largest_difference(actual, expected);
    assert!(
        difference <= tol.value() * scale,
        "{what}: relative difference {:.3e} exceeds {tol}\n  actual   {actual:?}\n  expected {expected:?}\n  scale    {scale:e}",
        difference / scale,
    );
}

/// max|aᵢ − eᵢ| / max|eᵢ|; the plain difference where all eᵢ are zero.
///
/// # Panics
/// When the lengths differ.
///
/// # Example
/// ```
/// assert_eq!(piola_testkit::relative_error(&[2.0, 4.5], &[2.0, 4.0]), 0.125);
/// ```
#[must_use]
#[track_caller]
pub fn relative_error(actual: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(actual.len(), expected.len(), "the lengths differ");
    let scale = largest(expected.iter().copied());
    largest_difference(actual, expected) / if 0.0 < scale { scale } else { 1.0 }
}

/// The number of floats between `a` and `b`: 0 for equal numbers (also 0.0 and −0.0), 1 for neighbours,
/// ∞ when exactly one of them is NaN or infinite.
///
/// # Example
/// ```
/// assert_eq!(piola_testkit::ulps_between(1.0, 1.0 + f64::EPSILON), 1.0);
/// ```
#[must_use]
pub fn ulps_between(a: f64, b: f64) -> f64 {
    // The bits of a float, read as a sign and a magnitude, count the floats from zero.
    fn place(x: f64) -> i128 {
        let magnitude = i128::from(x.abs().to_bits());
        if x.is_sign_negative() { -magnitude } else { magnitude }
    }
    if a.is_nan() && b.is_nan() {
        0.0
    } else if a.is_finite() == b.is_finite() && !a.is_nan() && !b.is_nan() {
        (place(a) - place(b)).unsigned_abs() as f64
    } else {
        f64::INFINITY
    }
}
