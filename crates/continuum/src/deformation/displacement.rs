//! The displacement gradient ∇u = F − 1.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{determinant, rows_of};

use super::gradient::check_jacobian;
use super::{Deformation, volume_change};
use crate::ContinuumError;
use crate::error::check_finite;
use crate::tensor::rows::{Rows, identity, sum};

/// The displacement gradient ∇u = ∂u/∂X = F − 1 with 0 < det F, B(4.28): no cancellation at small strain.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{Deformation, DisplacementGradient};
/// let tiny = DisplacementGradient::new(Matrix3::from_diagonal_element(1e-20))?;
/// assert_eq!(tiny.volume_change(), 3e-20); // F itself would be 1 to the last bit
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct DisplacementGradient<T = f64> {
    matrix: Matrix3<T>,
}

impl<T: Real> DisplacementGradient<T> {
    /// From ∇u.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NonPositiveJacobian`], in any lane.
    pub fn new(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
        let rows = rows_of(&matrix);
        check_finite("∇u", rows.as_flattened())?;
        check_jacobian(determinant(sum(rows, identity())))?;
        Ok(Self { matrix })
    }

    /// ∇u as a matrix.
    #[inline(always)]
    #[must_use]
    pub const fn matrix(&self) -> &Matrix3<T> {
        &self.matrix
    }
}

impl<T: Real> Deformation<T> for DisplacementGradient<T> {
    #[inline(always)]
    fn gradient_rows(&self) -> Rows<T> {
        sum(rows_of(&self.matrix), identity())
    }
    #[inline(always)]
    fn displacement_rows(&self) -> Rows<T> {
        rows_of(&self.matrix)
    }
    #[inline(always)]
    fn jacobian(&self) -> T {
        determinant(self.gradient_rows())
    }
    #[inline(always)]
    fn volume_change(&self) -> T {
        volume_change(rows_of(&self.matrix))
    }
}
