//! Hencky's logarithmic strains.

use piola_numerics::Real;
use piola_tensor::Slots;
use piola_tensor::spectral::{derivative_array, second_derivative};

use super::lines::derivatives_of_measure;
use super::stretch::of_stretch_analysis;
use super::{GreenStrain, RightCauchyGreen, SethHill};
use crate::measures::{linear_measure, symmetric_measure};
use crate::polar::StretchAnalysis;
use crate::{Deformation, Symmetric};

symmetric_measure! {
    /// Hencky's strain ln U in the material: its trace is ln J, and coaxial stretches add.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::HenckyStrain;
    /// let bar = DeformationGradient::uniaxial(2.0, 1.0)?;
    /// assert_eq!(HenckyStrain::of(&bar).0.components[0], 2.0_f64.ln());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    HenckyStrain, "ln U", "1", |_strain| Symmetric::<T>::identity()
}

symmetric_measure! {
    /// Hencky's strain ln V = R ln U Rᵀ in space.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::SpatialHenckyStrain;
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert_eq!(SpatialHenckyStrain::of(&turned).0.components[1], 2.0_f64.ln());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    SpatialHenckyStrain, "ln V", "1", |_strain| Symmetric::<T>::identity()
}

linear_measure!(HenckyStrain SpatialHenckyStrain);

of_stretch_analysis!(
    /// ln U.
    ///
    /// # Accuracy
    /// A few ulp × λ₁/λ₃ of its norm; at small strain, from ∇u, a few ulp of its norm.
    HenckyStrain hencky_material,
    /// ln V.
    ///
    /// # Accuracy
    /// As ln U.
    SpatialHenckyStrain hencky_spatial
);
derivatives_of_measure!(HenckyStrain);
derivatives_of_measure!(SpatialHenckyStrain);

impl<T: Real> HenckyStrain<T> {
    /// ∂ ln U/∂C: entry (ij, kl) in the order 11, 22, 33, 12, 23, 13, without factors for shears.
    ///
    /// # Accuracy
    /// A few ulp × the condition number of C; finite where stretches coalesce.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative_by_metric(metric: &RightCauchyGreen<T>) -> Slots<T> {
        derivative_array(&SethHill::HENCKY.of_metric(), &metric.0)
    }

    /// ∂ ln U/∂E = 2 ∂ ln U/∂C.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative_by_green(strain: &GreenStrain<T>) -> Slots<T> {
        Self::derivative_by_metric(&strain.right_cauchy_green()).map(|row| row.map(|x| x + x))
    }

    /// ∂² ln U/∂C² along two symmetric directions.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_derivative_by_metric(
        metric: &RightCauchyGreen<T>,
        first: &Symmetric<T>,
        second: &Symmetric<T>,
    ) -> Symmetric<T> {
        second_derivative(&SethHill::HENCKY.of_metric(), &metric.0, first, second)
    }
}
