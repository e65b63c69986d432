//! A change of shape and a change of volume, each with its energy: one formula for the stress and tangent of all.

use piola_continuum::Deformation;
use piola_continuum::strain::invariants;
use piola_numerics::{Mask, Real};

use super::invariant::{Curvatures, InvariantEnergy, Invariants, Slopes, hyperelastic_of_invariants};
use super::isochoric::{self, Isochoric};
use super::isochoric_factor::Unimodular;
use super::volumetric::{Quadratic, Volumetric};
use crate::SolidsError;
use crate::error::check_bound;

/// An isotropic solid W = W̄(Ī₁, Ī₂) + U(J) of any [`Isochoric`] and any [`Volumetric`] energy.
///
/// ```text
/// P = s F⁻ᵀ + (2 w₁ + 4 w₂)(F − F⁻ᵀ) + 2 w₂ F ((I₁ − 3) 1 − (C − 1))        w₁ = W̄₁ J^(−2/3),  w₂ = W̄₂ J^(−4/3)
/// s = −⅔ w₁ (I₁ − 3) − 4/3 w₂ (I₂ − 3) + J U′
/// ```
/// The reference is free of stress. Its shear modulus is 2 (W̄₁ + W̄₂), its bulk modulus U″(1).
///
/// # Accuracy
/// P, S, τ relative 1e-13 down to ∇u = 1e-16, while the bulk modulus is not far below the shear modulus; tangents a few
/// ulp of their norm.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solids::volumetric::Quadratic;
/// use piola_solids::{Compressible, Hyperelastic};
/// use piola_continuum::DeformationGradient;
/// let rubber = Compressible::new(NeoHookean::new(2.0)?, Quadratic::new(10.0)?);
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// assert_eq!(rubber.cauchy(&shear).0.components[3], 1.0); // μ k
/// let grown: f64 = rubber.cauchy(&DeformationGradient::dilatation(2.0)?).0.components[0];
/// assert!((grown - 70.0).abs() < 1e-13); // κ (J − 1)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.63), W(24.12) by the chain rule; Flory 1961.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Written<I, U>",
        bound(deserialize = "I: Isochoric + serde::Deserialize<'de>, U: Volumetric + serde::Deserialize<'de>")
    )
)]
pub struct Compressible<I, U> {
    pub(super) isochoric: I,
    pub(super) volumetric: U,
}

/// W = ½ μ (Ī₁ − 3) + ½ κ (J − 1)².
pub type NeoHookeanIsochoric = Compressible<isochoric::NeoHookean, Quadratic>;

/// W = C₁₀ (Ī₁ − 3) + C₀₁ (Ī₂ − 3) + ½ κ (J − 1)².
pub type MooneyRivlinIsochoric = Compressible<isochoric::MooneyRivlin, Quadratic>;

impl<I, U> Compressible<I, U> {
    /// W̄.
    #[must_use]
    pub const fn isochoric(&self) -> &I {
        &self.isochoric
    }

    /// U.
    #[must_use]
    pub const fn volumetric(&self) -> &U {
        &self.volumetric
    }
}

impl<I: Isochoric, U: Volumetric> Compressible<I, U> {
    /// W̄ + U.
    ///
    /// A part whose bulk modulus may be negative, [`Lame`](super::volumetric::Lame) or one that was read from a file, is refused by
    /// the compiler: see [`checked`](Self::checked).
    #[must_use]
    pub const fn new(isochoric: I, volumetric: U) -> Self {
        const { assert!(!U::EITHER_SIGN, "this bulk modulus may be negative: use `Compressible::checked`") };
        Self { isochoric, volumetric }
    }

    /// W̄ + U, of any part U.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`] where U″(1), the bulk modulus, is negative: W̄ does not resist a change of volume.
    pub fn checked(isochoric: I, volumetric: U) -> Result<Self, SolidsError> {
        let bulk = volumetric.bulk_modulus();
        check_bound("compressible", "U″(1)", bulk, "0 ≤ U″(1)", 0.0 <= bulk)?;
        Ok(Self { isochoric, volumetric })
    }

    /// W̄ + U, of any parts as they are: also of a negative bulk modulus.
    #[must_use]
    pub const fn unchecked(isochoric: I, volumetric: U) -> Self {
        Self { isochoric, volumetric }
    }

    /// The shear modulus of the reference, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.isochoric.shear_modulus()
    }

    /// The bulk modulus of the reference, Pa.
    #[must_use]
    pub fn bulk_modulus(&self) -> f64 {
        self.volumetric.bulk_modulus()
    }
}

/// Ī₁ − 3 and Ī₂ − 3 within a few ulp of themselves.
#[cfg_attr(not(debug_assertions), inline(always))]
fn shape_of<T: Real, I: Isochoric>(deformation: &impl Deformation<T>) -> [T; 2] {
    if I::SECOND {
        invariants::isochoric_minus_three(deformation)
    } else {
        [invariants::isochoric_first_minus_three(deformation), T::zero()]
    }
}

/// g = J^(−2/3), Ī₁ − 3 and Ī₂ − 3 within an ulp of the strain.
#[cfg_attr(not(debug_assertions), inline(always))]
fn isochoric_of<T: Real, I: Isochoric>(invariants: &Invariants<T>) -> (T, T, T) {
    let three = T::lit(3.0);
    let Unimodular { two_thirds: power, two_thirds_change: power_change, .. } =
        Unimodular::of(invariants.change, invariants.jacobian);
    let mut first = power * invariants.first + three * power_change;
    let mut second = T::zero();
    if I::SECOND {
        second = power * power * invariants.second + three * power_change * (power + T::one());
    }
    // Of a body that is compressed to nearly nothing, or blown up, nothing is left of differences from the reference.
    let beside = invariants.change.abs().at_most(T::lit(0.875));
    if !beside.all() {
        first = T::select(beside, first, power * invariants.first_whole - three);
        if I::SECOND {
            second = T::select(beside, second, power * power * invariants.second_whole - three);
        }
    }
    (power, first, second)
}

impl<I: Isochoric, U: Volumetric> InvariantEnergy for Compressible<I, U> {
    const SECOND: bool = I::SECOND;
    const CURVED: bool = true;
    const REFUSED_IS_NOT_FINITE: bool = I::REFUSED_IS_NOT_FINITE;
    const STRAIGHT: bool = I::STRAIGHT && U::STRAIGHT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let [first, second] = shape_of::<T, I>(deformation);
        self.isochoric.energy(first, second)
            + self.volumetric.energy(deformation.volume_change(), deformation.jacobian())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        let [first, second] = shape_of::<T, I>(deformation);
        isochoric::check_lanes(&self.isochoric, first, second)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        let (power, x, y) = isochoric_of::<T, I>(invariants);
        self.slopes_of(invariants, power, self.isochoric.slopes(x, y))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        self.slopes_and_curvatures(invariants).1
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_and_curvatures<T: Real>(&self, invariants: &Invariants<T>) -> (Slopes<T>, Curvatures<T>) {
        let (power, x, y) = isochoric_of::<T, I>(invariants);
        let ([a, b], [xx, xy, yy]) = self.isochoric.slopes_and_curvatures(x, y);
        let reciprocal = invariants.jacobian.recip();
        let square = power * power;
        // ∂x/∂J and ∂y/∂J, of J^(−2/3) I₁ and J^(−4/3) I₂.
        let three = T::lit(3.0);
        let first_rate = T::lit(-2.0 / 3.0) * (x + three) * reciprocal;
        let second_rate = if I::SECOND { T::lit(-4.0 / 3.0) * (y + three) * reciprocal } else { T::zero() };
        let (first_turn, second_turn) = (xx * first_rate + xy * second_rate, xy * first_rate + yy * second_rate);
        // ∂²x/∂J² = −(5/3) ∂x/∂J / J, ∂²y/∂J² = −(7/3) ∂y/∂J / J.
        let bending = T::lit(-5.0 / 3.0) * (a * first_rate) + T::lit(-7.0 / 3.0) * (b * second_rate);
        let curvatures = Curvatures {
            first_first: xx * square,
            first_second: xy * (square * power),
            second_second: yy * (square * square),
            first_volume: (first_turn + T::lit(-2.0 / 3.0) * (a * reciprocal)) * power,
            second_volume: (second_turn + T::lit(-4.0 / 3.0) * (b * reciprocal)) * square,
            volume_volume: first_turn * first_rate
                + second_turn * second_rate
                + bending * reciprocal
                + self.volumetric.curvature(invariants.change, invariants.jacobian),
        };
        (self.slopes_of(invariants, power, [a, b]), curvatures)
    }
}

impl<I: Isochoric, U: Volumetric> Compressible<I, U> {
    /// The slopes, given J^(−2/3) and those of W̄.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_of<T: Real>(&self, invariants: &Invariants<T>, power: T, [a, b]: [T; 2]) -> Slopes<T> {
        let first = a * power;
        let volume = self.volumetric.mean_kirchhoff(invariants.change, invariants.jacobian);
        let (two_thirds, four_thirds) = (T::lit(2.0 / 3.0), T::lit(4.0 / 3.0));
        let beside = volume - two_thirds * (first * invariants.first);
        let whole = volume - two_thirds * (first * invariants.first_whole);
        if !I::SECOND {
            return Slopes { first, second: T::zero(), residual: beside, volume: whole };
        }
        let second = b * (power * power);
        Slopes {
            first,
            second,
            residual: beside - four_thirds * (second * invariants.second),
            volume: whole - four_thirds * (second * invariants.second_whole),
        }
    }
}

hyperelastic_of_invariants!([I: Isochoric, U: Volumetric] Compressible<I, U>);

read_with!(checked of Compressible<I: Isochoric, U: Volumetric> { isochoric: I, volumetric: U });
