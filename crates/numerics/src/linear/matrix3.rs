//! Determinant, inverse and solution of 3×3 systems in closed form.
//!
//! The kernels work on arrays of rows, have no branch and are inlined, so that they run in lanes; they give
//! ∞ or NaN for a singular matrix. [`inverse`] and [`solve`] take nalgebra's types and refuse it.
//!
//! ```text
//! A⁻¹ = adj A / det A        det A = a₁ · (a₂ × a₃),   adj A = [a₂×a₃  a₃×a₁  a₁×a₂]  for rows aᵢ
//! ```

use nalgebra::{ArrayStorage, Matrix3, Vector3};

use crate::error::check_finite;
use crate::sums::unit_in_last_place;
use crate::{Mask, NumericsError, Real};

/// a × b.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a · b.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// det A of an array of rows.
///
/// # Accuracy
/// Within 4 ulp of the sum of the six products with all signs positive.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn determinant<T: Real>(rows: [[T; 3]; 3]) -> T {
    dot(rows[0], cross(rows[1], rows[2]))
}

/// adj A, with A adj A = (det A) 1; it exists for singular matrices too.
///
/// # Accuracy
/// Each entry within 2 ulp of the sum of its two products with positive signs.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn adjugate<T: Real>(rows: [[T; 3]; 3]) -> [[T; 3]; 3] {
    let columns = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])];
    core::array::from_fn(|i| core::array::from_fn(|j| columns[j][i]))
}

/// (A⁻¹, det A) of an array of rows; ∞ or NaN when A is singular.
///
/// # Accuracy
/// A few ulp × the condition number.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn inverse_and_determinant<T: Real>(rows: [[T; 3]; 3]) -> ([[T; 3]; 3], T) {
    let adjugate = adjugate(rows);
    let determinant = rows[0][0] * adjugate[0][0] + rows[0][1] * adjugate[1][0] + rows[0][2] * adjugate[2][0];
    let reciprocal = determinant.recip();
    (adjugate.map(|row| row.map(|entry| entry * reciprocal)), determinant)
}

/// The solution of A x = b for an array of rows; ∞ or NaN when A is singular.
///
/// # Accuracy
/// A few ulp × the condition number.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn solve_rows<T: Real>(rows: [[T; 3]; 3], right: [T; 3]) -> [T; 3] {
    let adjugate = adjugate(rows);
    let determinant = rows[0][0] * adjugate[0][0] + rows[0][1] * adjugate[1][0] + rows[0][2] * adjugate[2][0];
    let reciprocal = determinant.recip();
    adjugate.map(|row| dot(row, right) * reciprocal)
}

/// The rows of a nalgebra matrix, for the kernels above.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn rows_of<T: Real>(matrix: &Matrix3<T>) -> [[T; 3]; 3] {
    // Written out: closures are not always inlined, and lanes then are copied through memory.
    let [x, y, z] = matrix.data.0;
    [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
}

/// The nalgebra matrix of an array of rows.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn from_rows<T: Real>(rows: [[T; 3]; 3]) -> Matrix3<T> {
    let [x, y, z] = rows;
    Matrix3::from_array_storage(ArrayStorage([[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]))
}

/// A⁻¹.
///
/// # Errors
/// [`NumericsError::NotFinite`]; [`NumericsError::Singular`] when, in any lane, |det A| is within rounding (8 ulp) of zero,
/// compared with the product of the largest entries of the rows.
///
/// # Accuracy
/// A few ulp × the condition number.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_numerics::linear::matrix3;
/// let inverse = matrix3::inverse(&Matrix3::new(2.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 1.0))?;
/// assert_eq!(inverse[(1, 1)], 0.25);
/// assert!(matrix3::inverse(&Matrix3::repeat(1.0)).is_err());
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[inline]
pub fn inverse<T: Real>(matrix: &Matrix3<T>) -> Result<Matrix3<T>, NumericsError> {
    check_finite("matrix", matrix.as_slice())?;
    let rows = rows_of(matrix);
    let (inverse, determinant) = inverse_and_determinant(rows);
    check_regular(rows, determinant)?;
    Ok(from_rows(inverse))
}

/// The solution of A x = b.
///
/// # Errors
/// As [`inverse`].
///
/// # Accuracy
/// A few ulp × the condition number; the residual is not always as small as elimination makes it, for which
/// see [`lu::solve`](super::lu::solve).
#[inline]
pub fn solve<T: Real>(matrix: &Matrix3<T>, right: &Vector3<T>) -> Result<Vector3<T>, NumericsError> {
    check_finite("matrix", matrix.as_slice())?;
    check_finite("right-hand side", right.as_slice())?;
    let rows = rows_of(matrix);
    check_regular(rows, determinant(rows))?;
    Ok(Vector3::from(solve_rows(rows, [right[0], right[1], right[2]])))
}

/// Refuses a determinant that is zero to rounding.
#[inline]
fn check_regular<T: Real>(rows: [[T; 3]; 3], determinant: T) -> Result<(), NumericsError> {
    // The volume is compared with that of the box with the same edges; largest entries stand for lengths,
    // which could overflow when squared.
    let length = |row: [T; 3]| row[0].abs().max(row[1].abs()).max(row[2].abs());
    let volume = length(rows[0]) * length(rows[1]) * length(rows[2]);
    let threshold = T::lit(8.0 * unit_in_last_place::<T>());
    let regular = (threshold * volume).less_than(determinant.abs());
    if regular.all() {
        return Ok(());
    }
    let limit = threshold.primal(0);
    let regular = |lane: usize| limit * volume.primal(lane) < determinant.primal(lane).abs();
    let lane = (0..T::LANES).find(|&lane| !regular(lane)).unwrap_or(0);
    Err(NumericsError::Singular { pivot: 3, value: determinant.primal(lane), scale: volume.primal(lane) })
}
