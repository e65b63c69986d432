//! Conversions of Mandel's stress.

use piola_numerics::Real;

use crate::Deformation;
use crate::stress::kernels::first_piola_of_mandel;
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};

impl<T: Real> MandelStress<T> {
    /// P = F⁻ᵀ M.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::trusted(first_piola_of_mandel(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// T = sym(F⁻ᵀ M Fᵀ)/J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.first_piola(deformation).cauchy(deformation)
    }

    /// τ = sym(F⁻ᵀ M Fᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        self.first_piola(deformation).kirchhoff(deformation)
    }

    /// Biot's stress U⁻¹ M, as Rᵀ (F⁻ᵀ M).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }

    /// S = sym(C⁻¹ M), as F⁻¹ (F⁻ᵀ M).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.first_piola(deformation).second_piola(deformation)
    }
}
