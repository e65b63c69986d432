//! Tangents of objective rates that have no tangent type of their own.
//!
//! ```text
//! D ↦ τ°/J = (c/J : D) + K(D)          D ↦ T° = τ°/J − T tr D
//! ```
//! | rate | K(D) |
//! |---|---|
//! | upper-convected (Oldroyd), Truesdell | 0 |
//! | Jaumann | D T + T D |
//! | lower-convected (Cotter–Rivlin) | 2 (D T + T D) |
//! | Green–Naghdi, logarithmic | D T + T D − (Z T − T Z), Ω = W + Z(D) |
//!
//! Ω is the spin of the rate. Z is taken from the rates of the stretches for the six unit rates of deformation, so it is
//! exact at coalescent stretches.

use piola_numerics::Real;
use piola_tensor::{Minor, MinorSymmetric, PairSymmetric, Skew, Symmetry};

use super::TruesdellTangent;
use super::spatial::stretching_terms;
use crate::polar::StretchAnalysis;
use crate::rates::{GradientRate, StretchRates, VelocityGradient};
use crate::{CauchyStress, Deformation, Symmetric};

/// An objective rate of stress, by name: see [`rates`](crate::stress::rates).
///
/// # Example
/// ```
/// use piola_continuum::stress::tangents::{ObjectiveRate, TruesdellTangent};
/// use piola_continuum::{CauchyStress, DeformationGradient};
/// use piola_tensor::{MajorSymmetric, PairSymmetric};
/// let truesdell: TruesdellTangent = TruesdellTangent(MajorSymmetric::isotropic(1.0, 3.0));
/// let stress = CauchyStress::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
/// let still = DeformationGradient::identity();
/// let lower = truesdell.of_kirchhoff_rate(ObjectiveRate::LowerConvected, &stress, &still);
/// assert_eq!(lower.entry(0, 0, 0, 0), 47.0); // 7 + 4·10
/// let upper = truesdell.of_cauchy_rate(ObjectiveRate::UpperConvected, &stress, &still);
/// assert_eq!((upper.entry(0, 0, 1, 1), upper.entry(1, 1, 0, 0)), (-9.0, 1.0)); // λ − T₁₁, λ − T₂₂
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ObjectiveRate {
    /// Oldroyd's rate Ṫ − L T − T Lᵀ.
    UpperConvected,
    /// Zaremba's and Jaumann's rate Ṫ − W T + T W.
    Jaumann,
    /// Cotter's and Rivlin's rate Ṫ + Lᵀ T + T L.
    LowerConvected,
    /// Ṫ − Ω T + T Ω with Ω = Ṙ Rᵀ.
    GreenNaghdi,
    /// Ṫ − Ω T + T Ω with the spin for which (ln V)° = D.
    Logarithmic,
}

/// T ⊗ 1: D ↦ T tr D.
#[cfg_attr(not(debug_assertions), inline(always))]
fn volume_terms<T: Real>(stress: &CauchyStress<T>) -> MinorSymmetric<T> {
    MinorSymmetric::dyad(&stress.0, &Symmetric::identity())
}

/// D ↦ Z(D) T − T Z(D), from the analysis of the stretches.
fn turning_terms<T: Real>(
    stress: &CauchyStress<T>,
    deformation: &impl Deformation<T>,
    logarithmic: bool,
) -> MinorSymmetric<T> {
    let analysis = StretchAnalysis::of(deformation);
    let mut images = [Symmetric::zero(); 6];
    for (slot, image) in images.iter_mut().enumerate() {
        let mut unit = Symmetric::zero();
        unit.components[slot] = T::one();
        let rate = GradientRate::of(deformation, &VelocityGradient::trusted(unit.rows()));
        let rates = StretchRates::of_analysis(analysis, &rate);
        let axial = if logarithmic { rates.logarithmic_spin().axial.into() } else { rates.polar_spin().axial.into() };
        *image = Skew { axial }.turning(&stress.0);
    }
    MinorSymmetric::from_images(&images)
}

impl<T: Real, Y: Symmetry> TruesdellTangent<T, Y> {
    /// D ↦ τ°/J, Pa, of a rate of Kirchhoff's stress.
    #[must_use]
    pub fn of_kirchhoff_rate(
        &self,
        rate: ObjectiveRate,
        stress: &CauchyStress<T>,
        deformation: &impl Deformation<T>,
    ) -> MinorSymmetric<T> {
        match rate {
            ObjectiveRate::UpperConvected => self.0.minor(),
            ObjectiveRate::Jaumann => self.jaumann(stress).0.minor(),
            ObjectiveRate::LowerConvected => self.0.minor() + (stretching_terms(stress) * T::lit(2.0)).minor(),
            ObjectiveRate::GreenNaghdi => self.jaumann(stress).0.minor() - turning_terms(stress, deformation, false),
            ObjectiveRate::Logarithmic => self.jaumann(stress).0.minor() - turning_terms(stress, deformation, true),
        }
    }

    /// D ↦ T°, Pa, of a rate of Cauchy's stress.
    #[must_use]
    pub fn of_cauchy_rate(
        &self,
        rate: ObjectiveRate,
        stress: &CauchyStress<T>,
        deformation: &impl Deformation<T>,
    ) -> MinorSymmetric<T> {
        self.of_kirchhoff_rate(rate, stress, deformation) - volume_terms(stress)
    }
}

impl<T: Real> TruesdellTangent<T, Minor> {
    /// c/J from D ↦ τ°/J, undoing [`of_kirchhoff_rate`](TruesdellTangent::of_kirchhoff_rate).
    #[must_use]
    pub fn from_kirchhoff_rate(
        tangent: &MinorSymmetric<T>,
        rate: ObjectiveRate,
        stress: &CauchyStress<T>,
        deformation: &impl Deformation<T>,
    ) -> Self {
        let stretching = || stretching_terms(stress).minor();
        Self(match rate {
            ObjectiveRate::UpperConvected => *tangent,
            ObjectiveRate::Jaumann => *tangent - stretching(),
            ObjectiveRate::LowerConvected => *tangent - stretching() * T::lit(2.0),
            ObjectiveRate::GreenNaghdi => *tangent + turning_terms(stress, deformation, false) - stretching(),
            ObjectiveRate::Logarithmic => *tangent + turning_terms(stress, deformation, true) - stretching(),
        })
    }

    /// c/J from D ↦ T°, undoing [`of_cauchy_rate`](TruesdellTangent::of_cauchy_rate).
    #[must_use]
    pub fn from_cauchy_rate(
        tangent: &MinorSymmetric<T>,
        rate: ObjectiveRate,
        stress: &CauchyStress<T>,
        deformation: &impl Deformation<T>,
    ) -> Self {
        Self::from_kirchhoff_rate(&(*tangent + volume_terms(stress)), rate, stress, deformation)
    }
}
