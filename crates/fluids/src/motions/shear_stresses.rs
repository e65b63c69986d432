//! The stresses of a shear flow at one time.

use piola_continuum::Symmetric;
use piola_numerics::Real;

/// Shear stress and normal stress differences at one time of a shear flow, Pa.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ShearStresses<T = f64> {
    /// T₁₂.
    pub shear: T,
    /// N₁ = T₂₂ − T₁₁.
    pub first: T,
    /// N₂ = T₁₁ − T₃₃.
    pub second: T,
}

impl<T: Real> ShearStresses<T> {
    /// Of a stress, or of an extra stress.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(stress: &Symmetric<T>) -> Self {
        let [t11, t22, t33, t12, ..] = stress.components;
        Self { shear: t12, first: t22 - t11, second: t11 - t33 }
    }
}
