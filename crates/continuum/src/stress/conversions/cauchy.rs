//! Conversions of Cauchy's stress.

use piola_numerics::Real;

use crate::Deformation;
use crate::stress::kernels::{first_piola_of_cauchy, second_piola_of_cauchy};
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};

impl<T: Real> CauchyStress<T> {
    /// τ = J T.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(self.0 * deformation.jacobian())
    }

    /// P = T Cof F, W(17.21): force per area before the deformation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::trusted(first_piola_of_cauchy(deformation.gradient_rows(), &self.0))
    }

    /// S = J F⁻¹ T F⁻ᵀ, B(4.57).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_cauchy(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// M = Fᵀ T Cof F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ T Cof F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}
