//! Stress power: the rate of working of the stress, per volume of the deformed or of the reference body.
//!
//! ```text
//! per deformed volume     T : D = tr(T L)                                                  W(20.8)
//! per reference volume    τ : D = P : Ḟ = S : Ė = sym(Rᵀ P) : U̇ = M : F⁻¹ Ḟ   = J tr(T L)   W(20.15)
//! ```
//!
//! | stress | conjugate rate | per deformed volume | per reference volume |
//! |---|---|---|---|
//! | Cauchy T | L = Ḟ F⁻¹ | `power_per_deformed_volume(L)` | times J |
//! | Kirchhoff τ | L | | `power_per_reference_volume(L)` |
//! | first Piola–Kirchhoff P | Ḟ | `power_per_deformed_volume(Ḟ, F)` | `power_per_reference_volume(Ḟ)` |
//! | second Piola–Kirchhoff S | Ė | `power_per_deformed_volume(Ė, F)` | `power_per_reference_volume(Ė)` |
//! | Biot | U̇ | | `power_per_reference_volume(U̇)` |
//! | Mandel M | F⁻¹ Ḟ | | `power_per_reference_volume(F⁻¹ Ḟ)` |
//!
//! Rates are per second, powers in W/m³.
//!
//! # Accuracy
//! 6 ulp of |stress| |rate|.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::rows::double_contraction;

use super::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use crate::rates::strain::GreenStrainRate;
use crate::rates::{GradientRate, VelocityGradient};
use crate::{Deformation, Symmetric};

/// A : sym B for symmetric A.
#[cfg_attr(not(debug_assertions), inline(always))]
fn contraction<T: Real>(stress: &Symmetric<T>, rate: &VelocityGradient<T>) -> T {
    stress.double_contraction(&Symmetric::symmetric_part(rate.rows()))
}

impl<T: Real> CauchyStress<T> {
    /// tr(T L) = T : D, W per deformed m³, for the velocity gradient L, 1/s.
    ///
    /// # Source
    /// W(20.8–20.9).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_deformed_volume(&self, velocity_gradient: &VelocityGradient<T>) -> T {
        contraction(&self.0, velocity_gradient)
    }

    /// J tr(T L), W per reference m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_reference_volume(
        &self,
        velocity_gradient: &VelocityGradient<T>,
        deformation: &impl Deformation<T>,
    ) -> T {
        contraction(&self.0, velocity_gradient) * deformation.jacobian()
    }
}

impl<T: Real> KirchhoffStress<T> {
    /// τ : D = tr(τ L), W per reference m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_reference_volume(&self, velocity_gradient: &VelocityGradient<T>) -> T {
        contraction(&self.0, velocity_gradient)
    }
}

impl<T: Real> FirstPiola<T> {
    /// P : Ḟ, W per reference m³.
    ///
    /// # Source
    /// W(20.15).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_reference_volume(&self, rate: &GradientRate<T>) -> T {
        double_contraction(self.rows(), rate.rows())
    }

    /// P : Ḟ/J, W per deformed m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_deformed_volume(&self, rate: &GradientRate<T>, deformation: &impl Deformation<T>) -> T {
        self.power_per_reference_volume(rate) / deformation.jacobian()
    }
}

impl<T: Real> SecondPiola<T> {
    /// S : Ė, W per reference m³, for the rate of Green's strain:
    /// [`green_rate`](crate::rates::strain::green_rate).
    ///
    /// # Source
    /// W(20.15), B(4.60).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_reference_volume(&self, rate: &GreenStrainRate<T>) -> T {
        self.0.double_contraction(&rate.0)
    }

    /// S : Ė/J, W per deformed m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_deformed_volume(&self, rate: &GreenStrainRate<T>, deformation: &impl Deformation<T>) -> T {
        self.power_per_reference_volume(rate) / deformation.jacobian()
    }
}

impl<T: Real> BiotStress<T> {
    /// sym(Rᵀ P) : U̇, W per reference m³, for the rate of the right stretch:
    /// [`StretchRates::right_stretch`](crate::rates::StretchRates::right_stretch).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_reference_volume(&self, rate: &Symmetric<T>) -> T {
        self.symmetric_part().double_contraction(rate)
    }
}

impl<T: Real> MandelStress<T> {
    /// M : F⁻¹ Ḟ, W per reference m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn power_per_reference_volume(&self, pulled_back_velocity_gradient: &Matrix3<T>) -> T {
        double_contraction(self.rows(), rows_of(pulled_back_velocity_gradient))
    }
}
