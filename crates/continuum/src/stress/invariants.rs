//! Invariants of a stress: mean, deviator, J₂, J₃, von Mises, Tresca, Lode angle.
//!
//! ```text
//! m = ⅓ tr T = −p        D = T − m 1        J₂ = ½ D : D        J₃ = det D
//! von Mises  √(3 J₂)     octahedral shear  √(⅔ J₂)              Tresca  σ₁ − σ₃ = 2 √J₂ cos θₛ
//! ```
//!
//! # Lode angle
//! Two conventions are in use, both found here by the arctangent of two numbers without cancellation:
//!
//! | | definition | triaxial extension σ₁ > σ₂ = σ₃ | pure shear | triaxial compression σ₁ = σ₂ > σ₃ |
//! |---|---|---|---|---|
//! | [`lode_angle`] | cos 3θ = (3√3/2) J₃/J₂^(3/2) | 0 | π/6 | π/3 |
//! | [`lode_angle_from_shear`] | sin 3θₛ = (3√3/2) J₃/J₂^(3/2) | π/6 | 0 | −π/6 |
//!
//! θₛ = π/6 − θ. Some texts give θₛ the opposite sign. Tension is positive throughout.
//!
//! # Accuracy
//! All deviatoric quantities are made of differences of stresses: they keep their digits under any pressure. Those
//! of the dimension of a stress are scaled by powers of two, so that they neither overflow nor vanish for
//! stresses of 10⁻³⁰⁰ or 10³⁰⁰ Pa. They and
//! the principal stresses are finite wherever they can be represented; below 10⁻³⁰⁷ Pa two bits are lost.
//!
//! # Derivatives
//! Over differentiable numbers the functions have the derivatives of [`gradients`](super::gradients), with zero
//! where the function has a corner: √J₂ at the deviator zero and the Lode angle at its ends.
//!
//! # References
//! W. Lode, *Versuche über den Einfluß der mittleren Hauptspannung auf das Fließen der Metalle*, Z. Physik 36
//! (1926); R. Hill, *The Mathematical Theory of Plasticity* (1950), II.1.

use piola_numerics::{Mask, Real};
use piola_tensor::internal::check_range;

use super::deviator::{self, Coordinates};
use crate::error::check_finite;
use crate::{ContinuumError, Symmetric};

pub use piola_tensor::principal_invariants;

/// The mean stress m = ⅓ tr T, Pa.
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, stress::invariants::mean};
/// assert_eq!(mean(&Symmetric::diagonal([1.0, 2.0, 6.0])), 3.0);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn mean<T: Real>(stress: &Symmetric<T>) -> T {
    // Of a quarter, so that no sum overflows.
    (*stress * T::lit(0.25)).mean() * T::lit(4.0)
}

/// The deviator D = T − m 1, Pa, from differences of stresses.
///
/// # Accuracy
/// 2 ulp of the largest difference of stresses, whatever the mean.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn deviator<T: Real>(stress: &Symmetric<T>) -> Symmetric<T> {
    (*stress * T::lit(0.25)).deviator() * T::lit(4.0)
}

/// J₂ = ½ D : D, Pa².
///
/// # Accuracy
/// 6 ulp; over- and underflows where the number itself does.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn j2<T: Real>(stress: &Symmetric<T>) -> T {
    deviator::j2(stress)
}

/// J₃ = det D = ⅓ tr D³, Pa³.
///
/// # Accuracy
/// A few ulp of J₂^(3/2); over- and underflows where the number itself does.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn j3<T: Real>(stress: &Symmetric<T>) -> T {
    deviator::j3(stress)
}

/// Von Mises' stress √(3 J₂), Pa: the tension of a bar with the same J₂.
///
/// # Accuracy
/// 4 ulp at any pressure, for stresses of any size.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn von_mises<T: Real>(stress: &Symmetric<T>) -> T {
    Coordinates::of(stress).von_mises()
}

/// The octahedral shear stress √(⅔ J₂), Pa: the shear on the planes that meet all principal axes at equal angles.
///
/// # Accuracy
/// As [`von_mises`], and an ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn octahedral_shear<T: Real>(stress: &Symmetric<T>) -> T {
    von_mises(stress) * T::lit(core::f64::consts::SQRT_2 / 3.0)
}

/// Tresca's stress σ₁ − σ₃, Pa: twice the largest shear.
///
/// ```text
/// σ₁ − σ₃ = 2 √J₂ cos θₛ
/// ```
///
/// # Accuracy
/// 8 ulp at any pressure, for stresses of any size, coalescent ones too.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn tresca<T: Real>(stress: &Symmetric<T>) -> T {
    let coordinates = Coordinates::of(stress);
    let (sine, cosine) = coordinates.triple_angle();
    let from_shear = cosine.atan2(sine) / T::lit(3.0);
    coordinates.von_mises() * from_shear.cos() * T::lit(TWO_OVER_ROOT_3)
}

/// 2/√3.
const TWO_OVER_ROOT_3: f64 = 1.154_700_538_379_251_5;

/// The largest shear stress ½ (σ₁ − σ₃), Pa, over all planes.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn maximum_shear<T: Real>(stress: &Symmetric<T>) -> T {
    tresca(stress) * T::lit(0.5)
}

/// The Lode angle θ ∈ [0, π/3], counted from triaxial extension: cos 3θ = (3√3/2) J₃/J₂^(3/2).
///
/// For the deviator zero, where there is no angle, it is 0.
///
/// # Accuracy
/// A few ulp of one, near 0 and π/3 too, where the arccosine keeps only half of the digits.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn lode_angle<T: Real>(stress: &Symmetric<T>) -> T {
    let (sine, cosine) = Coordinates::of(stress).triple_angle();
    sine.atan2(cosine) / T::lit(3.0)
}

/// The Lode angle θₛ ∈ [−π/6, π/6], counted from pure shear towards extension: sin 3θₛ = (3√3/2) J₃/J₂^(3/2).
///
/// θₛ = π/6 − θ with [`lode_angle`]'s θ; for the deviator zero it is π/6.
///
/// # Accuracy
/// A few ulp of one; near pure shear a few ulp of J₃/J₂^(3/2) with the error of [`j3`].
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn lode_angle_from_shear<T: Real>(stress: &Symmetric<T>) -> T {
    let (sine, cosine) = Coordinates::of(stress).triple_angle();
    cosine.atan2(sine) / T::lit(3.0)
}

/// Triaxiality: the mean stress over von Mises' stress.
///
/// # Errors
/// [`ContinuumError::ZeroDeviator`] when, in any lane, von Mises' stress is zero.
///
/// # Accuracy
/// That of [`mean`], and 5 ulp.
pub fn triaxiality<T: Real>(stress: &Symmetric<T>) -> Result<T, ContinuumError> {
    let (mean, von_mises) = (mean(stress), von_mises(stress));
    let exists = T::zero().less_than(von_mises);
    if exists.all() {
        return Ok(mean / von_mises);
    }
    let lane = (0..T::LANES).find(|&lane| von_mises.primal(lane) <= 0.0).unwrap_or(0);
    Err(ContinuumError::ZeroDeviator { mean: mean.primal(lane) })
}

/// Haigh's and Westergaard's coordinates of a stress: cylindrical ones about the axis σ₁ = σ₂ = σ₃.
///
/// ```text
/// ξ = tr T/√3        ρ = |D| = √(2 J₂)        θ the Lode angle
/// σₖ = ξ/√3 + √⅔ ρ cos(θ − 2πk/3),   k = 0, 1, 2, descending
/// ```
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, stress::invariants::HaighWestergaard};
/// let point = HaighWestergaard::of(&Symmetric::diagonal([3.0, 0.0, 0.0]));
/// assert_eq!(point.lode_angle, 0.0);
/// assert!((point.hydrostatic - 3.0_f64.sqrt()).abs() <= 4.0 * f64::EPSILON);
/// assert!((point.deviatoric - 6.0_f64.sqrt()).abs() <= 4.0 * f64::EPSILON);
/// assert!((point.principal_values()[0] - 3.0).abs() <= 8.0 * f64::EPSILON);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "[T; 3]",
        into = "[T; 3]",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct HaighWestergaard<T = f64> {
    /// ξ = tr T/√3, Pa: the distance along the hydrostatic axis.
    pub hydrostatic: T,
    /// ρ = √(2 J₂), Pa: the distance from that axis.
    pub deviatoric: T,
    /// θ ∈ [0, π/3].
    pub lode_angle: T,
}

impl<T: Real> HaighWestergaard<T> {
    /// From (ξ, ρ, θ).
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`]; [`TensorError::OutOfRange`](piola_tensor::TensorError::OutOfRange) unless 0 ≤ ρ and 0 ≤ θ ≤ π/3.
    pub fn new(hydrostatic: T, deviatoric: T, lode_angle: T) -> Result<Self, ContinuumError> {
        check_finite("Haigh-Westergaard coordinate", &[hydrostatic, deviatoric, lode_angle])?;
        check_range("deviatoric coordinate", deviatoric, f64::INFINITY)?;
        check_range("Lode angle", lode_angle, T::lit(core::f64::consts::PI).primal(0) / 3.0)?;
        Ok(Self { hydrostatic, deviatoric, lode_angle })
    }

    /// Of a stress.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(stress: &Symmetric<T>) -> Self {
        let coordinates = Coordinates::of(stress);
        let (sine, cosine) = coordinates.triple_angle();
        Self {
            hydrostatic: (*stress * T::lit(0.25)).trace() * T::lit(4.0 / ROOT_3),
            deviatoric: coordinates.von_mises() * T::lit(ROOT_2_3),
            lode_angle: sine.atan2(cosine) / T::lit(3.0),
        }
    }

    /// The principal stresses, descending, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn principal_values(&self) -> [T; 3] {
        let (mean, radius) = (self.hydrostatic * T::lit(1.0 / ROOT_3), self.deviatoric * T::lit(ROOT_2_3));
        let turn = T::lit(2.0 * core::f64::consts::FRAC_PI_3);
        let value = |angle: T| mean + radius * angle.cos();
        [value(self.lode_angle), value(self.lode_angle - turn), value(self.lode_angle + turn)]
    }
}

impl<T: Real> TryFrom<[T; 3]> for HaighWestergaard<T> {
    type Error = ContinuumError;
    fn try_from([hydrostatic, deviatoric, lode_angle]: [T; 3]) -> Result<Self, ContinuumError> {
        Self::new(hydrostatic, deviatoric, lode_angle)
    }
}

impl<T> From<HaighWestergaard<T>> for [T; 3] {
    fn from(point: HaighWestergaard<T>) -> Self {
        [point.hydrostatic, point.deviatoric, point.lode_angle]
    }
}

/// √3.
const ROOT_3: f64 = 1.732_050_807_568_877_2;
/// √⅔.
const ROOT_2_3: f64 = 0.816_496_580_927_726;
