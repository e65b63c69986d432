//! The right and left Cauchy–Green tensors.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::product_symmetrized;

use super::kernels;
use super::lines::derivatives_of_measure;
use crate::measures::symmetric_measure;
use crate::{Deformation, Symmetric};

symmetric_measure! {
    /// The right Cauchy–Green tensor C = Fᵀ F = U²: squares of lengths of material lines, |dx|² = dX · C dX.
    ///
    /// A rigid motion leaves it 1, and unchanged when it follows a deformation, B(4.32).
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::RightCauchyGreen;
    /// let shear = DeformationGradient::simple_shear(2.0)?;
    /// assert_eq!(RightCauchyGreen::of(&shear), RightCauchyGreen::new(5.0, 1.0, 1.0, 2.0, 0.0, 0.0)?);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(14.11), B(4.29).
    RightCauchyGreen, "C", "C", |c| c
}

symmetric_measure! {
    /// The left Cauchy–Green tensor B = F Fᵀ = V².
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::LeftCauchyGreen;
    /// let shear = DeformationGradient::simple_shear(2.0)?;
    /// assert_eq!(LeftCauchyGreen::of(&shear), LeftCauchyGreen::new(1.0, 5.0, 1.0, 2.0, 0.0, 0.0)?);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(14.11).
    LeftCauchyGreen, "B", "B", |b| b
}

derivatives_of_measure!(RightCauchyGreen, whole);
derivatives_of_measure!(LeftCauchyGreen, whole);

impl<T: Real> RightCauchyGreen<T> {
    /// C = Fᵀ F.
    ///
    /// # Accuracy
    /// 3 ulp of its norm.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self(kernels::right_cauchy_green(deformation.gradient_rows()))
    }

    /// C − 1 = 2 E = ∇u + ∇uᵀ + ∇uᵀ ∇u, without cancellation.
    ///
    /// # Accuracy
    /// 2 ulp of its norm at small strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn minus_one(deformation: &impl Deformation<T>) -> Symmetric<T> {
        kernels::right_cauchy_green_minus_one(deformation.displacement_rows())
    }

    /// dC = 2 sym(Fᵀ dF) along the direction dF; with Ḟ for dF the rate Ċ = 2 Fᵀ D F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative(deformation: &impl Deformation<T>, direction: &Matrix3<T>) -> Symmetric<T> {
        kernels::green_derivative(deformation.gradient_rows(), rows_of(direction)) * T::lit(2.0)
    }

    /// d²C = 2 sym(d₁Fᵀ d₂F), the same at every deformation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_derivative(first: &Matrix3<T>, second: &Matrix3<T>) -> Symmetric<T> {
        kernels::green_derivative(rows_of(first), rows_of(second)) * T::lit(2.0)
    }
}

impl<T: Real> LeftCauchyGreen<T> {
    /// B = F Fᵀ.
    ///
    /// # Accuracy
    /// 3 ulp of its norm.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self(kernels::left_cauchy_green(deformation.gradient_rows()))
    }

    /// B − 1 = ∇u + ∇uᵀ + ∇u ∇uᵀ, without cancellation.
    ///
    /// # Accuracy
    /// 2 ulp of its norm at small strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn minus_one(deformation: &impl Deformation<T>) -> Symmetric<T> {
        kernels::left_cauchy_green_minus_one(deformation.displacement_rows())
    }

    /// dB = 2 sym(dF Fᵀ) along the direction dF; with Ḟ for dF the rate Ḃ = L B + B Lᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative(deformation: &impl Deformation<T>, direction: &Matrix3<T>) -> Symmetric<T> {
        kernels::left_cauchy_green_derivative(deformation.gradient_rows(), rows_of(direction))
    }

    /// d²B = 2 sym(d₁F d₂Fᵀ), the same at every deformation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_derivative(first: &Matrix3<T>, second: &Matrix3<T>) -> Symmetric<T> {
        product_symmetrized(rows_of(first), rows_of(second)) * T::lit(2.0)
    }
}

impl<T: Real> RightCauchyGreen<T> {
    /// The principal invariants of C, which are those of B; see [`invariants`](super::invariants).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn principal_invariants(&self) -> [T; 3] {
        super::invariants::principal_invariants(&self.0)
    }
}
