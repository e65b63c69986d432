//! Conversions of Biot's stress, and its symmetric part.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::rows::product;
use piola_tensor::rotation::check_rotation;

use crate::polar::StretchAnalysis;
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use crate::{ContinuumError, Deformation, Symmetric};

impl<T: Real> BiotStress<T> {
    /// P = R Biot; the rotation R is computed, see [`StretchAnalysis`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.first_piola_of_analysis(&StretchAnalysis::of(deformation))
    }

    /// P = R Biot where the stretches are known already.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola_of_analysis(&self, stretches: &StretchAnalysis<T>) -> FirstPiola<T> {
        FirstPiola::trusted(product(stretches.rotation(), self.rows()))
    }

    /// T = sym(R Biot Fᵀ)/J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.first_piola(deformation).cauchy(deformation)
    }

    /// τ = sym(R Biot Fᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        self.first_piola(deformation).kirchhoff(deformation)
    }

    /// S = sym(U⁻¹ Biot), as F⁻¹ (R Biot).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.first_piola(deformation).second_piola(deformation)
    }

    /// M = U Biot, as Fᵀ (R Biot).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// P = R Biot where the rotation R of F is known.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
    pub fn first_piola_of_rotation(&self, rotation: &Matrix3<T>) -> Result<FirstPiola<T>, ContinuumError> {
        check_rotation(rotation)?;
        Ok(FirstPiola::trusted(product(rows_of(rotation), self.rows())))
    }

    /// Its symmetric part, conjugate to U: ½ (Rᵀ P + Pᵀ R) = ½ (U S + S U).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symmetric_part(&self) -> Symmetric<T> {
        Symmetric::symmetric_part(self.rows())
    }
}
