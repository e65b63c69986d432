//! The deformation gradient F = ∂x/∂X.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{determinant, rows_of};
use piola_numerics::{Mask, Real};

use super::{Deformation, volume_change};
use crate::ContinuumError;
use crate::error::check_finite;
use crate::tensor::rows::{Rows, difference, identity};

/// The deformation gradient F = ∂x/∂X with 0 < det F, W(14.7–14.8).
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{Deformation, DeformationGradient};
/// let stretch = DeformationGradient::new(Matrix3::new(2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.25))?;
/// assert_eq!(stretch.jacobian(), 0.5);
/// assert!(DeformationGradient::new(-Matrix3::<f64>::identity()).is_err());
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct DeformationGradient<T = f64> {
    matrix: Matrix3<T>,
}

impl<T: Real> DeformationGradient<T> {
    /// From F.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NonPositiveJacobian`], in any lane.
    pub fn new(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
        let rows = rows_of(&matrix);
        check_finite("F", rows.as_flattened())?;
        check_jacobian(determinant(rows))?;
        Ok(Self { matrix })
    }

    /// F as a matrix.
    #[inline(always)]
    #[must_use]
    pub const fn matrix(&self) -> &Matrix3<T> {
        &self.matrix
    }
}

/// 0 < det F in every lane.
#[inline]
pub(crate) fn check_jacobian<T: Real>(determinant: T) -> Result<(), ContinuumError> {
    if T::zero().less_than(determinant).all() {
        return Ok(());
    }
    let positive = |lane: usize| 0.0 < determinant.primal(lane);
    let lane = (0..T::LANES).find(|&lane| !positive(lane)).unwrap_or(0);
    Err(ContinuumError::NonPositiveJacobian { determinant: determinant.primal(lane) })
}

impl<T: Real> Deformation<T> for DeformationGradient<T> {
    #[inline(always)]
    fn gradient_rows(&self) -> Rows<T> {
        rows_of(&self.matrix)
    }
    #[inline(always)]
    fn displacement_rows(&self) -> Rows<T> {
        difference(rows_of(&self.matrix), identity())
    }
    #[inline(always)]
    fn jacobian(&self) -> T {
        determinant(rows_of(&self.matrix))
    }
    #[inline(always)]
    fn volume_change(&self) -> T {
        volume_change(self.displacement_rows())
    }
}
