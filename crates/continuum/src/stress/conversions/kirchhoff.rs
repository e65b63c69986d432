//! Conversions of Kirchhoff's stress.

use piola_numerics::Real;

use crate::Deformation;
use crate::stress::kernels::first_piola_of_kirchhoff;
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};

impl<T: Real> KirchhoffStress<T> {
    /// T = τ/J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(self.0 * deformation.jacobian().recip())
    }

    /// P = τ F⁻ᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::trusted(first_piola_of_kirchhoff(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// S = F⁻¹ τ F⁻ᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(self.0.congruence(deformation.inverse_rows()))
    }

    /// M = Fᵀ τ F⁻ᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ τ F⁻ᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}
