//! Numbers that are equal to the last digit.

use piola_testkit::{Tol, assert_close};

/// Compares exact numbers: zeros, and the answers of the same operations.
#[track_caller]
pub(super) fn equal<const N: usize>(actual: [f64; N], expected: [f64; N]) {
    assert_close("exact numbers", &actual, &expected, Tol::ulps(0.0));
}
