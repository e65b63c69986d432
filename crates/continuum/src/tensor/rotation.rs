//! What a rotation must obey before tensors are turned by it.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{determinant, rows_of};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::rows::{difference, identity, product_transposed};
use crate::ContinuumError;
use crate::error::check_finite;

/// Refuses a matrix that is not a rotation to 64 ulp, in any lane.
pub(crate) fn check_rotation<T: Real>(rotation: &Matrix3<T>) -> Result<(), ContinuumError> {
    let q = rows_of(rotation);
    check_finite("rotation", q.as_flattened())?;
    let defects = difference(product_transposed(q, q), identity());
    let defect = defects.as_flattened().iter().fold(T::zero(), |largest, x| largest.max(x.abs()));
    let (tolerance, determinant) = (64.0 * unit_in_last_place::<T>(), determinant(q));
    let is_rotation = defect.at_most(T::lit(tolerance)) & T::zero().less_than(determinant);
    if is_rotation.all() {
        return Ok(());
    }
    let fits = |lane: usize| defect.primal(lane) <= tolerance && 0.0 < determinant.primal(lane);
    let lane = (0..T::LANES).find(|&lane| !fits(lane)).unwrap_or(0);
    Err(ContinuumError::NotARotation { defect: defect.primal(lane), determinant: determinant.primal(lane) })
}
