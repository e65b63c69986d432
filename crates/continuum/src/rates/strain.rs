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
use piola_numerics::linear::matrix3::{adjugate, inverse_and_determinant};

use super::kernels::doubled_symmetric_part;
use super::{GradientRate, VelocityGradient};
use crate::tensor::rows::{double_contraction, product, product_transposed, transpose, transposed_product};
use crate::{Deformation, Symmetric};

/// J̇ = Cof F : Ḟ = J tr L, 1/s, without a division.
///
/// # Accuracy
/// Within 8 ulp of |Cof F| |Ḟ|.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, rates::{GradientRate, strain}};
/// let f = DeformationGradient::new(Matrix3::from_diagonal_element(2.0))?;
/// let rate = GradientRate::new(Matrix3::from_diagonal_element(3.0))?;
/// assert_eq!(strain::jacobian_rate(&f, &rate), 36.0); // (λ³)˙ = 3 λ² λ̇
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn jacobian_rate<T: Real>(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> T {
    double_contraction(transpose(adjugate(deformation.gradient_rows())), rate.rows())
}

/// Ċ = Ḟᵀ F + Fᵀ Ḟ, 1/s.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, rates::{GradientRate, strain}};
/// let f = DeformationGradient::new(Matrix3::from_diagonal_element(2.0))?;
/// let rate = GradientRate::new(Matrix3::from_diagonal_element(3.0))?;
/// assert_eq!(strain::right_cauchy_green_rate(&f, &rate).components[0], 12.0); // (λ²)˙ = 2 λ λ̇
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn right_cauchy_green_rate<T: Real>(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> Symmetric<T> {
    doubled_symmetric_part(transposed_product(deformation.gradient_rows(), rate.rows()))
}

/// Ė = ½ Ċ = Fᵀ D F, the rate of Green's strain, 1/s.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DisplacementGradient, rates::{GradientRate, strain}};
/// let still = DisplacementGradient::new(Matrix3::<f64>::zeros())?;
/// let shear = GradientRate::new(Matrix3::new(0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
/// assert_eq!(strain::green_rate(&still, &shear).components[3], 1.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn green_rate<T: Real>(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> Symmetric<T> {
    Symmetric::symmetric_part(transposed_product(deformation.gradient_rows(), rate.rows()))
}

/// Ḃ = Ḟ Fᵀ + F Ḟᵀ, 1/s.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, rates::{GradientRate, strain}};
/// let f = DeformationGradient::new(Matrix3::from_diagonal_element(2.0))?;
/// let rate = GradientRate::new(Matrix3::from_diagonal_element(3.0))?;
/// assert_eq!(strain::left_cauchy_green_rate(&f, &rate).components[0], 12.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn left_cauchy_green_rate<T: Real>(deformation: &impl Deformation<T>, rate: &GradientRate<T>) -> Symmetric<T> {
    doubled_symmetric_part(product_transposed(rate.rows(), deformation.gradient_rows()))
}

/// ė = ½ (Lᵀ B⁻¹ + B⁻¹ L), the rate of Almansi's strain e = ½ (1 − B⁻¹), 1/s.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, rates::{VelocityGradient, strain}};
/// // e = ½ (1 − λ⁻²): ė = λ⁻² λ̇/λ = ¼ · 3.
/// let f = DeformationGradient::new(Matrix3::from_diagonal_element(2.0))?;
/// let growth = VelocityGradient::new(Matrix3::from_diagonal_element(3.0))?;
/// assert_eq!(strain::almansi_rate(&f, &growth).components[0], 0.75);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn almansi_rate<T: Real>(
    deformation: &impl Deformation<T>,
    velocity_gradient: &VelocityGradient<T>,
) -> Symmetric<T> {
    let inverse = inverse_and_determinant(deformation.gradient_rows()).0;
    let metric = transposed_product(inverse, inverse);
    Symmetric::symmetric_part(product(metric, velocity_gradient.rows()))
}
