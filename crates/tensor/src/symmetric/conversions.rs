//! Symmetric tensors to and from matrices and lists of components.

use nalgebra::Matrix3;
use piola_numerics::Real;

use super::Symmetric;
use crate::TensorError;
use crate::error::check_finite;

/// From the components 11, 22, 33, 12, 23, 13; refuses infinite and NaN ones.
impl<T: Real> TryFrom<[T; 6]> for Symmetric<T> {
    type Error = TensorError;
    fn try_from(components: [T; 6]) -> Result<Self, TensorError> {
        check_finite("symmetric tensor", &components)?;
        Ok(Self { components })
    }
}

/// The components 11, 22, 33, 12, 23, 13.
impl<T> From<Symmetric<T>> for [T; 6] {
    fn from(tensor: Symmetric<T>) -> Self {
        tensor.components
    }
}

impl<T: Real> From<Symmetric<T>> for Matrix3<T> {
    fn from(tensor: Symmetric<T>) -> Self {
        tensor.matrix()
    }
}

/// As [`Symmetric::from_matrix`].
impl<T: Real> TryFrom<Matrix3<T>> for Symmetric<T> {
    type Error = TensorError;
    fn try_from(matrix: Matrix3<T>) -> Result<Self, TensorError> {
        Self::from_matrix(&matrix)
    }
}

#[cfg(feature = "glam")]
crate::glam_matrices!(Symmetric, TensorError, |tensor| tensor.rows());
