//! Conversions of the second Piola–Kirchhoff stress.

use piola_numerics::Real;
use piola_tensor::internal::rows::product;

use crate::strain::RightCauchyGreen;
use crate::stress::kernels::cauchy_of_second_piola;
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use crate::{Deformation, Symmetric};

impl<T: Real> SecondPiola<T> {
    /// T = F S Fᵀ/J, B(4.57).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(cauchy_of_second_piola(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// τ = F S Fᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(self.0.congruence(deformation.gradient_rows()))
    }

    /// P = F S, B(4.57).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::trusted(product(deformation.gradient_rows(), self.rows()))
    }

    /// M = C S, as Fᵀ (F S).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// M = C S where the right Cauchy–Green tensor is all that is known.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mandel_of_right_cauchy_green(&self, right_cauchy_green: &RightCauchyGreen<T>) -> MandelStress<T> {
        MandelStress::trusted(product(right_cauchy_green.rows(), self.rows()))
    }

    /// Biot's stress U S, as Rᵀ (F S).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }

    /// Biot's stress U S where the right stretch is all that is known.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn biot_of_right_stretch(&self, right_stretch: &Symmetric<T>) -> BiotStress<T> {
        BiotStress::trusted(product(right_stretch.rows(), self.rows()))
    }
}
