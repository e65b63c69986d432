//! Stresses seen from another basis, or turned with the body.
//!
//! ```text
//! T* = Q T Qᵀ   W(16.10)        P* = Q P        S* = S        for a body turned by Q after its deformation
//! ```
//!
//! The components of T in the basis fᵢ = Qᵀ eᵢ are those of Q T Qᵀ too: what turns the body forwards turns the basis
//! back.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::rows::product;
use piola_tensor::rotation::check_rotation;

use super::{CauchyStress, FirstPiola, KirchhoffStress};
use crate::ContinuumError;

impl<T: Real> CauchyStress<T> {
    /// Q T Qᵀ: the stress of the body turned by Q, or its components in the basis Qᵀ eᵢ.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
    ///
    /// # Accuracy
    /// 8 ulp of |T|.
    ///
    /// # Source
    /// W(16.10).
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self(self.0.congruence(rows_of(rotation))))
    }
}

impl<T: Real> KirchhoffStress<T> {
    /// Q τ Qᵀ, as [`CauchyStress::rotated`].
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self(self.0.congruence(rows_of(rotation))))
    }
}

impl<T: Real> FirstPiola<T> {
    /// Q P: the stress of the body turned by Q; its reference configuration does not turn.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self::trusted(product(rows_of(rotation), self.rows())))
    }
}
