//! Rates of the measures of strain that are polynomials of F or its inverse.
//!
//! ```text
//! Ċ = Ḟᵀ F + Fᵀ Ḟ = 2 Fᵀ D F        Ė = ½ Ċ = Fᵀ D F
//! J̇ = Cof F : Ḟ = J tr L
//! Ḃ = Ḟ Fᵀ + F Ḟᵀ = L B + B Lᵀ      ė = ½ (Lᵀ B⁻¹ + B⁻¹ L) = D − Lᵀ e − e L
//! ```
//! Those of U, V, ln U and ln V are of [`StretchRates`](super::StretchRates); that of any other function of F comes
//! from the function itself over differentiable scalars, with F + ε Ḟ.
//!
//! # Accuracy
//! Ċ, Ė and Ḃ within 4 ulp of |F| |Ḟ|, without a division; ė within a few ulp × the condition number of F.

use piola_numerics::Real;
use piola_tensor::internal::rows::{double_contraction, product, transpose};

use super::{GradientRate, VelocityGradient};
use crate::measures::{linear_measure, symmetric_measure};
use crate::strain::kernels::{green_derivative, left_cauchy_green_derivative};
use crate::{Deformation, Symmetric};

symmetric_measure! {
    /// Ċ, the rate of the right Cauchy–Green tensor, 1/s: twice Ė, from which it is a type apart.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::rates::strain::{GreenStrainRate, RightCauchyGreenRate};
    /// let rate = RightCauchyGreenRate::new(12.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(rate.green(), GreenStrainRate::new(6.0, 0.0, 0.0, 0.0, 0.0, 0.0)?);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    RightCauchyGreenRate, "rate of C"
}

symmetric_measure! {
    /// Ė, the rate of Green's strain, 1/s: conjugate to the second Piola–Kirchhoff stress.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::SecondPiola;
    /// use piola_continuum::rates::strain::GreenStrainRate;
    /// let rate = GreenStrainRate::new(0.5, 0.0, 0.0, 1.0, 0.0, 0.0)?;
    /// let stress = SecondPiola::new(2.0, 0.0, 0.0, 3.0, 0.0, 0.0)?;
    /// assert_eq!(stress.power_per_reference_volume(&rate), 7.0); // 2·½ + 2·3·1
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    GreenStrainRate, "rate of E"
}

symmetric_measure! {
    /// Ḃ, the rate of the left Cauchy–Green tensor, 1/s.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::rates::strain::LeftCauchyGreenRate;
    /// let rate = LeftCauchyGreenRate::new(1.0, -1.0, 0.0, 0.0, 0.0, 0.0)?; // of any sign
    /// assert_eq!((rate + rate).0.components[0], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    LeftCauchyGreenRate, "rate of B"
}

symmetric_measure! {
    /// ė, the rate of Almansi's strain, 1/s.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::rates::strain::AlmansiStrainRate;
    /// let rate = AlmansiStrainRate::new(1.0, -1.0, 0.0, 0.0, 0.0, 0.0)?; // of any sign
    /// assert_eq!((rate * 3.0).0.components[0], 3.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    AlmansiStrainRate, "rate of e"
}

linear_measure!(RightCauchyGreenRate GreenStrainRate LeftCauchyGreenRate AlmansiStrainRate);

impl<T: Real> RightCauchyGreenRate<T> {
    /// Ė = ½ Ċ, exactly.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn green(&self) -> GreenStrainRate<T> {
        GreenStrainRate(self.0 * T::lit(0.5))
    }
}

impl<T: Real> GreenStrainRate<T> {
    /// Ċ = 2 Ė, exactly.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn right_cauchy_green(&self) -> RightCauchyGreenRate<T> {
        RightCauchyGreenRate(self.0 + self.0)
    }
}

/// J̇ = Cof F : Ḟ = J tr L, 1/s, without a division.
///
/// # Accuracy
/// Within 8 ulp of |Cof F| |Ḟ|.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn jacobian_rate<T: Real>(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> T {
    double_contraction(deformation.cofactor_rows(), rate.rows())
}

/// Ċ = Ḟᵀ F + Fᵀ Ḟ, 1/s.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn right_cauchy_green_rate<T: Real>(
    deformation: &impl Deformation<T>,
    rate: &GradientRate<T>,
) -> RightCauchyGreenRate<T> {
    green_rate(deformation, rate).right_cauchy_green()
}

/// Ė = ½ Ċ = Fᵀ D F, the rate of Green's strain, 1/s.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn green_rate<T: Real>(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> GreenStrainRate<T> {
    GreenStrainRate(green_derivative(deformation.gradient_rows(), rate.rows()))
}

/// Ḃ = Ḟ Fᵀ + F Ḟᵀ, 1/s.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn left_cauchy_green_rate<T: Real>(
    deformation: &impl Deformation<T>,
    rate: &GradientRate<T>,
) -> LeftCauchyGreenRate<T> {
    LeftCauchyGreenRate(left_cauchy_green_derivative(deformation.gradient_rows(), rate.rows()))
}

/// ė = ½ (Lᵀ B⁻¹ + B⁻¹ L), the rate of Almansi's strain e = ½ (1 − B⁻¹), 1/s.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn almansi_rate<T: Real>(
    deformation: &impl Deformation<T>,
    velocity_gradient: &VelocityGradient<T>,
) -> AlmansiStrainRate<T> {
    let inverse_of_b = Symmetric::gram(transpose(deformation.inverse_rows()));
    AlmansiStrainRate(Symmetric::symmetric_part(product(inverse_of_b.rows(), velocity_gradient.rows())))
}
