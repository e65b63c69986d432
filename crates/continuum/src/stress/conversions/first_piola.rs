//! Conversions of the first Piola–Kirchhoff stress.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::product_symmetrized;
use piola_tensor::internal::rows::transposed_product;
use piola_tensor::rotation::check_rotation;

use crate::polar::StretchAnalysis;
use crate::stress::kernels::{cauchy_of_first_piola, second_piola_of_first_piola};
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use crate::{ContinuumError, Deformation};

impl<T: Real> FirstPiola<T> {
    /// T = sym(P Fᵀ)/J, W(17.21).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(cauchy_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// τ = sym(P Fᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(product_symmetrized(self.rows(), deformation.gradient_rows()))
    }

    /// S = sym(F⁻¹ P), B(4.57).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// M = Fᵀ P.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        MandelStress::trusted(transposed_product(deformation.gradient_rows(), self.rows()))
    }

    /// Biot's stress Rᵀ P; its rotation R is computed, see [`StretchAnalysis`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.biot_of_analysis(&StretchAnalysis::of(deformation))
    }

    /// Biot's stress Rᵀ P where the stretches are known already.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn biot_of_analysis(&self, stretches: &StretchAnalysis<T>) -> BiotStress<T> {
        BiotStress::trusted(transposed_product(stretches.rotation(), self.rows()))
    }

    /// Biot's stress Rᵀ P where the rotation R of F is known.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
    pub fn biot_of_rotation(&self, rotation: &Matrix3<T>) -> Result<BiotStress<T>, ContinuumError> {
        check_rotation(rotation)?;
        Ok(BiotStress::trusted(transposed_product(rows_of(rotation), self.rows())))
    }
}
