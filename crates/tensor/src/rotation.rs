//! What a rotation must obey before tensors are turned by it.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{determinant, rows_of};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::rows::{Rows, difference, identity, product_transposed};
use crate::TensorError;
use crate::error::check_finite;

/// ‖Q Qᵀ − 1‖, 64 ulp of one, and det Q.
#[cfg_attr(not(debug_assertions), inline(always))]
fn defect<T: Real>(q: Rows<T>) -> (T, f64, T) {
    let defects = difference(product_transposed(q, q), identity());
    let mut largest = T::zero();
    for x in defects.as_flattened() {
        largest = largest.max(x.abs());
    }
    (largest, 64.0 * unit_in_last_place::<T>(), determinant(q))
}

/// Whether a matrix is a rotation to 64 ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn is_rotation<T: Real>(q: Rows<T>) -> T::Mask {
    let (defect, tolerance, determinant) = defect(q);
    defect.at_most(T::lit(tolerance)) & T::zero().less_than(determinant)
}

/// Refuses a matrix that is not a rotation to 64 ulp, in any lane.
///
/// # Errors
/// `NotFinite`, `NotARotation`.
pub fn check_rotation<T: Real>(rotation: &Matrix3<T>) -> Result<(), TensorError> {
    let q = rows_of(rotation);
    check_finite("rotation", q.as_flattened())?;
    if is_rotation(q).all() {
        return Ok(());
    }
    let (defect, tolerance, determinant) = defect(q);
    let fits = |lane: usize| defect.primal(lane) <= tolerance && 0.0 < determinant.primal(lane);
    let lane = (0..T::LANES).find(|&lane| !fits(lane)).unwrap_or(0);
    Err(TensorError::NotARotation { defect: defect.primal(lane), determinant: determinant.primal(lane) })
}
