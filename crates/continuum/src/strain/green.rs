//! Green's and Almansi's strains: polynomials of ∇u and of F⁻¹ ∇u, without spectral theory.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::rows::product;

use super::RightCauchyGreen;
use super::kernels;
use super::lines::derivatives_of_measure;
use crate::measures::{linear_measure, symmetric_measure};
use crate::{Deformation, Symmetric};

symmetric_measure! {
    /// Green–St. Venant's strain E = ½ (C − 1) = ½ (∇u + ∇uᵀ + ∇uᵀ ∇u).
    ///
    /// Half the change of the square of a material line's length for each square of it; zero exactly for rigid motions.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::GreenStrain;
    /// let bar = DeformationGradient::uniaxial(2.0, 1.0)?;
    /// assert_eq!(GreenStrain::of(&bar).0.components[0], 1.5); // ½ (2² − 1)
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// B(4.33), whose ½ the scan has lost.
    GreenStrain, "E", "1 + 2E", |e| e + e + Symmetric::identity()
}

symmetric_measure! {
    /// Almansi's strain e = ½ (1 − B⁻¹), in the deformed configuration.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::AlmansiStrain;
    /// let bar = DeformationGradient::uniaxial(2.0, 1.0)?;
    /// assert_eq!(AlmansiStrain::of(&bar).0.components[0], 0.375); // ½ (1 − 1/4)
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    AlmansiStrain, "e", "1 - 2e", |e| Symmetric::identity() - e - e
}

linear_measure!(GreenStrain AlmansiStrain);

derivatives_of_measure!(GreenStrain, whole);
derivatives_of_measure!(AlmansiStrain, whole);

impl<T: Real> GreenStrain<T> {
    /// E = ½ (∇u + ∇uᵀ + ∇uᵀ ∇u).
    ///
    /// # Accuracy
    /// 2 ulp of its norm at small strain, 3 ulp at large strain; for a rotation 3 ulp of 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self(kernels::green(deformation.displacement_rows()))
    }

    /// C = 1 + 2E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn right_cauchy_green(&self) -> RightCauchyGreen<T> {
        RightCauchyGreen(self.0 + self.0 + Symmetric::identity())
    }

    /// dE = sym(Fᵀ dF) along the direction dF; with Ḟ for dF the rate Ė = Fᵀ D F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative(deformation: &impl Deformation<T>, direction: &Matrix3<T>) -> Symmetric<T> {
        kernels::green_derivative(deformation.gradient_rows(), rows_of(direction))
    }

    /// d²E = sym(d₁Fᵀ d₂F), the same at every deformation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_derivative(first: &Matrix3<T>, second: &Matrix3<T>) -> Symmetric<T> {
        kernels::green_derivative(rows_of(first), rows_of(second))
    }
}

impl<T: Real> AlmansiStrain<T> {
    /// e = ½ (G + Gᵀ − Gᵀ G) with G = F⁻¹ ∇u.
    ///
    /// # Accuracy
    /// A few ulp × the condition number of F, of its own norm: nothing cancels at small strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self(kernels::almansi(deformation.spatial_displacement_rows()))
    }

    /// de = sym(F⁻ᵀ F⁻¹ dF F⁻¹) along the direction dF; with Ḟ for dF the rate of e.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative(deformation: &impl Deformation<T>, direction: &Matrix3<T>) -> Symmetric<T> {
        kernels::almansi_derivative(deformation.inverse_rows(), rows_of(direction))
    }

    /// d²e along two directions.
    ///
    /// ```text
    /// d²e = −½ d²(F⁻ᵀ F⁻¹) = −F⁻ᵀ sym(a b + b a + aᵀ b) F⁻¹,        a = F⁻¹ d₁F,   b = F⁻¹ d₂F
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_derivative(
        deformation: &impl Deformation<T>,
        first: &Matrix3<T>,
        second: &Matrix3<T>,
    ) -> Symmetric<T> {
        let inverse = deformation.inverse_rows();
        let (a, b) = (product(inverse, rows_of(first)), product(inverse, rows_of(second)));
        let middle = Symmetric::symmetric_part(product(a, b))
            + Symmetric::symmetric_part(product(b, a))
            + kernels::green_derivative(a, b);
        -middle.transposed_congruence(inverse)
    }
}
