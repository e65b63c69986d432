//! Conversions of Kirchhoff's stress.

use piola_numerics::Real;

use crate::Deformation;
use crate::stress::kernels::first_piola_of_kirchhoff;
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};

impl<T: Real> KirchhoffStress<T> {
    /// T = τ/J.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.cauchy(&bar).0.components[0], 8.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(self.0 * deformation.jacobian().recip())
    }

    /// P = τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.first_piola(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::trusted(first_piola_of_kirchhoff(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// S = F⁻¹ τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(self.0.congruence(deformation.inverse_rows()))
    }

    /// M = Fᵀ τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}
