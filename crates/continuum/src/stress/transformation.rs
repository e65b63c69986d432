//! Stresses seen from another basis, or turned with the body.
//!
//! ```text
//! T* = Q T Qᵀ   W(16.10)        P* = Q P        S* = S        for a body turned by Q after its deformation
//! ```
//!
//! The components of T in the basis fᵢ = Qᵀ eᵢ are those of Q T Qᵀ too: what turns the body forwards turns the basis
//! back.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{determinant, rows_of};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::kernels::congruence;
use super::{CauchyStress, FirstPiola, KirchhoffStress};
use crate::ContinuumError;
use crate::error::check_finite;
use crate::tensor::rows::{difference, identity, product, product_transposed};

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

impl<T: Real> CauchyStress<T> {
    /// Q T Qᵀ: the stress of the body turned by Q, or its components in the basis Qᵀ eᵢ.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NotARotation`].
    ///
    /// # Accuracy
    /// 8 ulp of |T|.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::CauchyStress;
    /// let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    /// let stress = CauchyStress::new(1.0, 2.0, 3.0, 4.0, 0.0, 0.0)?;
    /// assert_eq!(stress.rotated(&quarter_turn)?, CauchyStress::new(2.0, 1.0, 3.0, -4.0, 0.0, 0.0)?);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(16.10).
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self(congruence(rows_of(rotation), &self.0)))
    }
}

impl<T: Real> KirchhoffStress<T> {
    /// Q τ Qᵀ, as [`CauchyStress::rotated`].
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NotARotation`].
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self(congruence(rows_of(rotation), &self.0)))
    }
}

impl<T: Real> FirstPiola<T> {
    /// Q P: the stress of the body turned by Q; its reference configuration does not turn.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NotARotation`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::FirstPiola;
    /// let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    /// let pull = FirstPiola::new(Matrix3::new(3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// assert_eq!(pull.rotated(&quarter_turn)?.0[(1, 0)], 3.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self::from_rows(product(rows_of(rotation), self.rows())))
    }
}
