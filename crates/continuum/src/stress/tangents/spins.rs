//! Tangents of the rates whose spin depends on the stretch: Green and Naghdi's, and the logarithmic one.
//!
//! ```text
//! Ω = W + Z(D), Z linear:   τ°/J with Ω = (τ°/J of Jaumann) − (Z T − T Z)
//! ```
//! Z is taken from the rates of the stretches for the six unit stretchings, so it is exact at coalescent stretches.

use piola_numerics::Real;
use piola_tensor::{Minor, MinorSymmetric, PairSymmetric, Skew, Symmetry};

use super::spatial::volume_terms;
use super::{
    CauchyGreenNaghdiTangent, CauchyLogarithmicTangent, GreenNaghdiTangent, JaumannTangent, LogarithmicTangent,
};
use crate::polar::StretchAnalysis;
use crate::rates::{GradientRate, StretchRates, VelocityGradient};
use crate::{CauchyStress, Deformation, Symmetric};

/// D ↦ Z T − T Z for the two spins Z of the stretch rates: polar, and logarithmic.
#[inline(always)]
fn turning_terms<T: Real, const LOGARITHMIC: bool>(
    stress: &CauchyStress<T>,
    deformation: &impl Deformation<T>,
    analysis: StretchAnalysis<T>,
) -> MinorSymmetric<T> {
    let mut images = [Symmetric::zero(); 6];
    for (slot, image) in images.iter_mut().enumerate() {
        let mut stretching = Symmetric::zero();
        stretching.components[slot] = T::one();
        let rate = GradientRate::of(deformation, &VelocityGradient::trusted(stretching.rows()));
        let rates = StretchRates::of_analysis(analysis, &rate);
        let axial = if LOGARITHMIC { rates.logarithmic_spin().axial.into() } else { rates.polar_spin().axial.into() };
        *image = Skew { axial }.turning(&stress.0);
    }
    MinorSymmetric::from_images(&images)
}

/// Of a rate with the polar and of one with the logarithmic spin.
macro_rules! spinning {
    ($name:ident, $cauchy:ident, $of_jaumann:ident, $of_analysis:ident, $logarithmic:literal) => {
        impl<T: Real, Y: Symmetry> JaumannTangent<T, Y> {
            /// The tangent of the rate of τ, over J, with the spin of the stretch: less D ↦ Z T − T Z.
            ///
            /// # Example
            /// ```
            /// use piola_continuum::stress::tangents::JaumannTangent;
            /// use piola_tensor::MajorSymmetric;
            /// use piola_continuum::{CauchyStress, DeformationGradient};
            /// let jaumann: JaumannTangent = JaumannTangent(MajorSymmetric::isotropic(1.0, 3.0));
            /// let stress = CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
            #[doc = concat!("let tangent = jaumann.", stringify!($of_jaumann), "(&stress, &DeformationGradient::identity());")]
            /// // where nothing is stretched, all spins are one
            /// assert!((tangent.entry(0, 1, 0, 1) - 3.0_f64).abs() < 1e-14);
            /// # Ok::<(), piola_continuum::ContinuumError>(())
            /// ```
            #[must_use]
            pub fn $of_jaumann(&self, stress: &CauchyStress<T>, deformation: &impl Deformation<T>) -> $name<T> {
                self.$of_analysis(stress, deformation, StretchAnalysis::of(deformation))
            }

            /// The same with the stretches known.
            #[inline(always)]
            pub(crate) fn $of_analysis(
                &self,
                stress: &CauchyStress<T>,
                deformation: &impl Deformation<T>,
                analysis: StretchAnalysis<T>,
            ) -> $name<T> {
                $name(self.0.minor() - turning_terms::<T, $logarithmic>(stress, deformation, analysis))
            }
        }

        impl<T: Real> $name<T> {
            /// The tangent of Jaumann's rate of τ, over J.
            ///
            /// # Example
            /// ```
            #[doc = concat!("use piola_continuum::{CauchyStress, DeformationGradient, stress::tangents::", stringify!($name), "};")]
            /// use piola_tensor::{MajorSymmetric, PairSymmetric};
            #[doc = concat!("let tangent = ", stringify!($name), "(MajorSymmetric::isotropic(1.0, 3.0).minor());")]
            /// let stress = CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
            /// let jaumann = tangent.jaumann(&stress, &DeformationGradient::identity());
            /// // where nothing is stretched, all spins are one
            /// assert!((jaumann.entry(0, 1, 0, 1) - 3.0_f64).abs() < 1e-14);
            /// # Ok::<(), piola_continuum::ContinuumError>(())
            /// ```
            #[must_use]
            pub fn jaumann(
                &self,
                stress: &CauchyStress<T>,
                deformation: &impl Deformation<T>,
            ) -> JaumannTangent<T, Minor> {
                self.jaumann_of_analysis(stress, deformation, StretchAnalysis::of(deformation))
            }

            /// The same with the stretches known.
            #[inline(always)]
            pub(crate) fn jaumann_of_analysis(
                &self,
                stress: &CauchyStress<T>,
                deformation: &impl Deformation<T>,
                analysis: StretchAnalysis<T>,
            ) -> JaumannTangent<T, Minor> {
                JaumannTangent(self.0 + turning_terms::<T, $logarithmic>(stress, deformation, analysis))
            }

            /// The tangent of the same rate of Cauchy's stress: less T ⊗ 1.
            ///
            /// # Example
            /// ```
            #[doc = concat!("use piola_tensor::MinorSymmetric; use piola_continuum::{CauchyStress, stress::tangents::", stringify!($name), "};")]
            /// let stress = CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
            #[doc = concat!("let tangent = ", stringify!($name), "(MinorSymmetric::zero()).cauchy(&stress);")]
            /// assert_eq!((tangent.entry(0, 0, 1, 1), tangent.entry(1, 1, 0, 0)), (-10.0, 0.0)); // −T₁₁, −T₂₂
            /// # Ok::<(), piola_continuum::ContinuumError>(())
            /// ```
            #[inline(always)]
            #[must_use]
            pub fn cauchy(&self, stress: &CauchyStress<T>) -> $cauchy<T> {
                $cauchy(self.0 - volume_terms(stress))
            }
        }

        impl<T: Real> $cauchy<T> {
            /// The tangent of the same rate of τ, over J: with T ⊗ 1.
            ///
            /// # Example
            /// ```
            #[doc = concat!("use piola_tensor::MinorSymmetric; use piola_continuum::{CauchyStress, stress::tangents::", stringify!($cauchy), "};")]
            /// let stress = CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
            #[doc = concat!("let tangent = ", stringify!($cauchy), "(MinorSymmetric::zero()).kirchhoff(&stress);")]
            /// assert_eq!((tangent.entry(0, 0, 1, 1), tangent.entry(1, 1, 0, 0)), (10.0, 0.0)); // T₁₁, T₂₂
            /// # Ok::<(), piola_continuum::ContinuumError>(())
            /// ```
            #[inline(always)]
            #[must_use]
            pub fn kirchhoff(&self, stress: &CauchyStress<T>) -> $name<T> {
                $name(self.0 + volume_terms(stress))
            }
        }
    };
}

spinning!(GreenNaghdiTangent, CauchyGreenNaghdiTangent, green_naghdi, green_naghdi_of_analysis, false);
spinning!(LogarithmicTangent, CauchyLogarithmicTangent, logarithmic, logarithmic_of_analysis, true);
