//! Conversions of the first Piola–Kirchhoff stress.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::product_symmetrized;
use piola_tensor::internal::rows::transposed_product;
use piola_tensor::rotation::check_rotation;

use crate::polar::StretchAnalysis;
use crate::stress::kernels::{cauchy_of_first_piola, second_piola_of_first_piola};
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use crate::{ContinuumError, Deformation};

impl<T: Real> FirstPiola<T> {
    /// T = sym(P Fᵀ)/J, W(17.21).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.cauchy(&bar).0.components[0], 8.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(cauchy_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// τ = sym(P Fᵀ).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.kirchhoff(&bar).0.components[0], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(product_symmetrized(self.rows(), deformation.gradient_rows()))
    }

    /// S = sym(F⁻¹ P), B(4.57).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// M = Fᵀ P.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        MandelStress::trusted(transposed_product(deformation.gradient_rows(), self.rows()))
    }

    /// Biot's stress Rᵀ P; its rotation R is computed, see [`StretchAnalysis`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.biot_of_analysis(&StretchAnalysis::of(deformation))
    }

    /// Biot's stress Rᵀ P where the stretches are known already.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::polar::StretchAnalysis;
    /// use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.biot_of_analysis(&StretchAnalysis::of(&bar)).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot_of_analysis(&self, stretches: &StretchAnalysis<T>) -> BiotStress<T> {
        BiotStress::trusted(transposed_product(stretches.rotation(), self.rows()))
    }

    /// Biot's stress Rᵀ P where the rotation R of F is known.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::FirstPiola;
    /// let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0); // e₁ to e₂
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.biot_of_rotation(&turn)?.0[(1, 0)], -2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn biot_of_rotation(&self, rotation: &Matrix3<T>) -> Result<BiotStress<T>, ContinuumError> {
        check_rotation(rotation)?;
        Ok(BiotStress::trusted(transposed_product(rows_of(rotation), self.rows())))
    }
}
