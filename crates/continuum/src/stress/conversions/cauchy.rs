//! Conversions of Cauchy's stress.

use piola_numerics::Real;

use crate::Deformation;
use crate::stress::kernels::{first_piola_of_cauchy, second_piola_of_cauchy};
use crate::stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};

impl<T: Real> CauchyStress<T> {
    /// τ = J T.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{CauchyStress, DeformationGradient};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.kirchhoff(&bar).0.components[0], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(self.0 * deformation.jacobian())
    }

    /// P = T Cof F, W(17.21): force per area before the deformation.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{CauchyStress, DeformationGradient};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.first_piola(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::trusted(first_piola_of_cauchy(deformation.gradient_rows(), &self.0))
    }

    /// S = J F⁻¹ T F⁻ᵀ, B(4.57).
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{CauchyStress, DeformationGradient};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_cauchy(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// M = Fᵀ T Cof F.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{CauchyStress, DeformationGradient};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ T Cof F.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{CauchyStress, DeformationGradient};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}
