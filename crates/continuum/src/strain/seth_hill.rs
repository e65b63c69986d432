//! The family of strains of Seth and Hill, in the material and in space.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_tensor::Slots;
use piola_tensor::spectral::{derivative_array, second_derivative};

use super::lines::{along, along_all, along_both, moving_analysis, partials};
use super::{RightCauchyGreen, SethHill};
use crate::polar::StretchAnalysis;
use crate::{Deformation, Symmetric};

macro_rules! family {
    ($(#[$documentation:meta])* $name:ident $function:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(
            feature = "serde",
            serde(bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>"))
        )]
        pub struct $name<T = f64> {
            /// How stretches are counted.
            pub scale: SethHill,
            /// The components.
            pub tensor: Symmetric<T>,
        }

        impl<T: Real> $name<T> {
            /// The strain of a deformation on a scale.
            ///
            /// To ask for several, make one [`StretchAnalysis`] and use [`from_analysis`](Self::from_analysis).
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn of(deformation: &impl Deformation<T>, scale: SethHill) -> Self {
                Self::from_analysis(&StretchAnalysis::of(deformation), scale)
            }

            /// From the stretches of a deformation that are already known.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn from_analysis(analysis: &StretchAnalysis<T>, scale: SethHill) -> Self {
                Self { scale, tensor: analysis.$function(&scale) }
            }

            /// The derivative along a direction dF; with Ḟ for dF the rate.
            ///
            /// # Accuracy
            /// Finite and accurate where stretches coalesce, too.
            #[inline]
            #[must_use]
            pub fn derivative(
                deformation: &impl Deformation<T>,
                scale: SethHill,
                direction: &Matrix3<T>,
            ) -> Symmetric<T> {
                let moving = $name::from_analysis(&moving_analysis(&along(deformation, direction)), scale);
                Symmetric { components: moving.tensor.components.map(|x| x.tangent) }
            }

            /// The second derivative along two directions d₁F and d₂F.
            ///
            /// # Accuracy
            /// As [`derivative`](Self::derivative).
            #[inline]
            #[must_use]
            pub fn second_derivative(
                deformation: &impl Deformation<T>,
                scale: SethHill,
                first: &Matrix3<T>,
                second: &Matrix3<T>,
            ) -> Symmetric<T> {
                let moving = $name::from_analysis(&moving_analysis(&along_both(deformation, first, second)), scale);
                Symmetric { components: moving.tensor.components.map(|x| x.tangent.tangent) }
            }

            /// The whole derivative with respect to F: rows 11, 22, 33, 12, 23, 13 (shears not doubled), columns 3i + A for
            /// the entry (i, A) of F.
            #[inline]
            #[must_use]
            pub fn derivative_matrix(deformation: &impl Deformation<T>, scale: SethHill) -> [[T; 9]; 6] {
                partials($name::from_analysis(&moving_analysis(&along_all(deformation)), scale).tensor)
            }
        }
    };
}

family! {
    /// A strain of Seth and Hill in the material, (Uᵐ − 1)/m, and ln U for m = 0.
    ///
    /// # Accuracy
    /// 8 ulp × the condition number of its norm; from ∇u nothing cancels at small strain, for any m.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::{SethHill, SethHillStrain};
    /// let bar = DeformationGradient::uniaxial(2.0, 1.0)?;
    /// let strain = SethHillStrain::of(&bar, SethHill::new(-1.0)?);
    /// assert_eq!(strain.tensor.components[0], 0.5); // 1 − 1/2
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    SethHillStrain material_function
}

family! {
    /// A strain of Seth and Hill in space, (Vᵐ − 1)/m, and ln V for m = 0.
    ///
    /// # Accuracy
    /// As [`SethHillStrain`].
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::{SethHill, SpatialSethHillStrain};
    /// let bar = DeformationGradient::uniaxial(2.0, 1.0)?;
    /// let almansi = SpatialSethHillStrain::of(&bar, SethHill::ALMANSI);
    /// assert_eq!(almansi.tensor.components[0], 0.375); // ½ (1 − 1/4)
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    SpatialSethHillStrain spatial_function
}

impl<T: Real> SethHillStrain<T> {
    /// The derivative with respect to C: entry (ij, kl) in the order 11, 22, 33, 12, 23, 13, without factors for shears.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative_by_metric(metric: &RightCauchyGreen<T>, scale: SethHill) -> Slots<T> {
        derivative_array(&scale.of_metric(), &metric.0)
    }

    /// The second derivative with respect to C along two symmetric directions.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_derivative_by_metric(
        metric: &RightCauchyGreen<T>,
        scale: SethHill,
        first: &Symmetric<T>,
        second: &Symmetric<T>,
    ) -> Symmetric<T> {
        second_derivative(&scale.of_metric(), &metric.0, first, second)
    }
}
