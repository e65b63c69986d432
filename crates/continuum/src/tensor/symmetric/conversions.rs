//! Symmetric tensors to and from matrices and lists of components.

use nalgebra::Matrix3;
use piola_numerics::Real;

use super::Symmetric;
use crate::ContinuumError;
use crate::error::check_finite;

/// From the components 11, 22, 33, 12, 23, 13; refuses infinite and NaN ones.
impl<T: Real> TryFrom<[T; 6]> for Symmetric<T> {
    type Error = ContinuumError;
    fn try_from(components: [T; 6]) -> Result<Self, ContinuumError> {
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
    type Error = ContinuumError;
    fn try_from(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
        Self::from_matrix(&matrix)
    }
}

#[cfg(feature = "glam")]
impl From<Symmetric<f64>> for glam::DMat3 {
    fn from(tensor: Symmetric<f64>) -> Self {
        Self::from_cols_array_2d(&tensor.rows())
    }
}

#[cfg(feature = "glam")]
impl From<Symmetric<f32>> for glam::Mat3 {
    fn from(tensor: Symmetric<f32>) -> Self {
        Self::from_cols_array_2d(&tensor.rows())
    }
}

/// As [`Symmetric::from_matrix`].
#[cfg(feature = "glam")]
impl TryFrom<glam::DMat3> for Symmetric<f64> {
    type Error = ContinuumError;
    fn try_from(matrix: glam::DMat3) -> Result<Self, ContinuumError> {
        Self::from_matrix(&Matrix3::from_column_slice(&matrix.to_cols_array()))
    }
}

/// As [`Symmetric::from_matrix`].
#[cfg(feature = "glam")]
impl TryFrom<glam::Mat3> for Symmetric<f32> {
    type Error = ContinuumError;
    fn try_from(matrix: glam::Mat3) -> Result<Self, ContinuumError> {
        Self::from_matrix(&Matrix3::from_column_slice(&matrix.to_cols_array()))
    }
}
