//! First derivatives of the invariants of stress, as flow rules need them.
//!
//! ```text
//! ∂J₂/∂T = D        ∂J₃/∂T = dev(D²)        ∂σᵥ/∂T = (3/2) D/σᵥ        ∂θ/∂T = −E/(|E| |D|)
//! ∂(σ₁ − σ₃)/∂T = (2/√3) [cos θₛ ∂σᵥ/∂T − σᵥ sin θₛ ∂θₛ/∂T],   ∂θₛ = −∂θ
//! ```
//! with E = dev(D²) − (D : dev(D²)/D : D) D. Each is the symmetric G with df = G : dT, shears not doubled.
//!
//! # Where there is no derivative
//! At the deviator zero von Mises' stress has a corner, and the Lode angle does not exist; where two principal
//! stresses coincide (to 32 ulp of sin 3θ), the Lode angle, and with it Tresca's stress, has a corner. There the subgradient of least
//! size is returned for von Mises' stress, zero, and zero for the Lode angle: Tresca's is then the mean of those of
//! the two planes that meet. Nothing is NaN.
//!
//! # Accuracy
//! A few ulp of the gradient's norm for J₂, J₃ and von Mises; those of the Lode angle, and of Tresca's stress, by
//! the ratio of the stresses' differences, as their directions depend on them.

use piola_numerics::Real;

use super::deviator::{self, Coordinates};
use super::invariants;
use crate::Symmetric;

/// ∂J₂/∂T = D, Pa.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn j2<T: Real>(stress: &Symmetric<T>) -> Symmetric<T> {
    invariants::deviator(stress)
}

/// ∂J₃/∂T = dev(D²) = D² − ⅔ J₂ 1, Pa².
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn j3<T: Real>(stress: &Symmetric<T>) -> Symmetric<T> {
    deviator::deviatoric_square(stress)
}

/// ∂σᵥ/∂T = (3/2) D/σᵥ of von Mises' stress; of norm √(3/2), and zero at the deviator zero.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn von_mises<T: Real>(stress: &Symmetric<T>) -> Symmetric<T> {
    Coordinates::of(stress).direction() * T::lit(1.5)
}

/// ∂θ/∂T of the [Lode angle](invariants::lode_angle), 1/Pa; of norm 1/√(2 J₂), and zero at θ = 0, θ = π/3 and the
/// deviator zero. That of θₛ is its negative.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn lode_angle<T: Real>(stress: &Symmetric<T>) -> Symmetric<T> {
    Coordinates::of(stress).angle_gradient()
}

/// ∂(σ₁ − σ₃)/∂T of [Tresca's stress](invariants::tresca): n₁⊗n₁ − n₃⊗n₃ where the principal stresses differ.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn tresca<T: Real>(stress: &Symmetric<T>) -> Symmetric<T> {
    let coordinates = Coordinates::of(stress);
    let (sine, cosine) = coordinates.triple_angle();
    let (sine, cosine) = (cosine.atan2(sine) / T::lit(3.0)).sin_cos();
    let factor = T::lit(2.0 / 1.732_050_807_568_877_2);
    let radial = coordinates.direction() * (T::lit(1.5) * factor * cosine);
    radial + coordinates.angle_gradient() * (factor * coordinates.von_mises() * sine)
}
