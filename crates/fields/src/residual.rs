//! What is left of a balance, with the size of its terms.

use nalgebra::Vector3;
use piola_numerics::Real;

/// What a balance leaves at a point, and its scale: the sum of the moduli of the terms.
///
/// A balance holds to rounding when the residual is a few ulp of the scale; the residual alone says nothing.
///
/// # Example
/// ```
/// use piola_fields::Residual;
/// let residual = Residual::zero().plus(1e9).plus(-1e9).plus(1.0);
/// assert_eq!((residual.value, residual.scale), (1.0, 2e9 + 1.0));
/// assert!(residual.relative() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: serde::Serialize",
        deserialize = "T: crate::integrand::Integrand<Scalar = T> + Real + serde::Deserialize<'de>"
    ))
)]
pub struct Residual<T = f64> {
    /// The sum of the terms.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub value: T,
    /// The sum of their moduli.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub scale: T,
}

impl<T: Real> Residual<T> {
    /// The empty sum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn zero() -> Self {
        Self { value: T::zero(), scale: T::zero() }
    }
    /// With one more term.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn plus(self, term: T) -> Self {
        Self { value: self.value + term, scale: self.scale + term.abs() }
    }
    /// With the terms of another sum, each times a factor.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn plus_all(self, other: Self, factor: T) -> Self {
        Self { value: self.value + other.value * factor, scale: self.scale + other.scale * factor.abs() }
    }
    /// |value|/scale ∈ [0, 1]; zero when all terms are.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn relative(&self) -> T {
        ratio(self.value.abs(), self.scale)
    }
}

/// The residual of a vector balance: three [`Residual`]s.
///
/// # Example
/// ```
/// use piola_fields::{Residual, VectorResidual};
/// let (balanced, left) = (Residual::zero().plus(2.0).plus(-2.0), Residual::zero().plus(1.0));
/// assert_eq!(VectorResidual::from([balanced, balanced, left]).relative(), 0.25); // 1/4
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct VectorResidual<T = f64> {
    /// The sums of the terms.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub value: Vector3<T>,
    /// The sums of their moduli, component by component.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub scale: Vector3<T>,
}

impl<T: Real> VectorResidual<T> {
    /// The largest component divided by the largest scale, ∈ [0, 1]; zero when all terms are.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn relative(&self) -> T {
        let largest = |v: &Vector3<T>| v[0].abs().max(v[1].abs()).max(v[2].abs());
        ratio(largest(&self.value), largest(&self.scale))
    }
}

impl<T: Real> From<[Residual<T>; 3]> for VectorResidual<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from(components: [Residual<T>; 3]) -> Self {
        Self { value: components.map(|c| c.value).into(), scale: components.map(|c| c.scale).into() }
    }
}

/// a/b, or zero when b is.
#[cfg_attr(not(debug_assertions), inline(always))]
fn ratio<T: Real>(a: T, b: T) -> T {
    let zero = T::zero();
    T::select(b.at_most(zero), zero, a / T::select(b.at_most(zero), T::one(), b))
}
