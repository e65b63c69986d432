//! Principal stresses, their directions, and Mohr's circles.
//!
//! ```text
//! T nₖ = σₖ nₖ,   σ₁ ≥ σ₂ ≥ σ₃        T = Σ σₖ nₖ ⊗ nₖ
//! σₖ = m + dₖ,   dₖ the principal values of the deviator
//! ```
//! The deviator is decomposed, not the stress: differences of principal stresses, the circles' radii and the
//! directions keep their digits under any pressure.

use piola_numerics::Real;
#[cfg(feature = "serde")]
use piola_tensor::internal::check_range;
use piola_tensor::internal::rows::Rows;
#[cfg(feature = "serde")]
use piola_tensor::internal::spectral::check_principal;
use piola_tensor::spectral::decompose;

use super::invariants::mean;
use super::{CauchyStress, KirchhoffStress, UnitNormal};
use crate::Symmetric;
#[cfg(feature = "serde")]
use crate::{ContinuumError, error::check_finite};

/// Principal stresses and directions of a symmetric stress tensor.
///
/// # Accuracy
/// `deviatoric` within 4 ulp of the deviator's norm and the axes orthonormal to 2 ulp, each within a few ulp of that
/// norm over its gap. Where principal stresses coincide, some axes of their plane or of space.
///
/// # Derivatives
/// As of [`decompose`]: single values and axes have them where the principal stresses differ.
///
/// # Example
/// ```
/// use piola_continuum::CauchyStress;
/// // Shear of 3 Pa between directions 1 and 2, under a pressure.
/// let principal = CauchyStress::new(-1e9, -1e9, -1e9, 3.0, 0.0, 0.0)?.principal();
/// let [d1, d2, d3]: [f64; 3] = principal.deviatoric;
/// assert!((d1 - 3.0).abs() <= 1e-15 && d2.abs() <= 1e-15 && (d3 + 3.0).abs() <= 1e-15);
/// assert!((principal.maximum_shear() - 3.0).abs() <= 1e-15);
/// assert_eq!(principal.values()[0], -1e9 + 3.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Unchecked<T>",
        bound(serialize = "T: serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct PrincipalStresses<T = f64> {
    /// The mean stress m, Pa.
    pub mean: T,
    /// The principal values of the deviator, descending, Pa.
    pub deviatoric: [T; 3],
    /// `axes[k]` is the unit vector along which the stress k acts; together they are right-handed.
    pub axes: Rows<T>,
}

/// One of Mohr's circles, in the plane of normal and shear traction.
///
/// # Example
/// ```
/// use piola_continuum::CauchyStress;
/// let circles = CauchyStress::new(6.0, 0.0, 2.0, 0.0, 0.0, 0.0)?.principal().mohr_circles();
/// let outer = circles[0];
/// assert!((outer.centre - 3.0_f64).abs() <= 1e-15 && (outer.radius - 3.0).abs() <= 1e-15); // from 0 to 6 Pa
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "UncheckedCircle<T>",
        bound(serialize = "T: serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct MohrCircle<T = f64> {
    /// The normal traction at the centre, Pa.
    pub centre: T,
    /// The largest shear traction, Pa.
    pub radius: T,
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked<T> {
    mean: T,
    deviatoric: [T; 3],
    axes: Rows<T>,
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Unchecked<T>> for PrincipalStresses<T> {
    type Error = ContinuumError;

    fn try_from(Unchecked { mean, deviatoric, axes }: Unchecked<T>) -> Result<Self, ContinuumError> {
        check_finite("mean stress", &[mean])?;
        check_principal(&deviatoric, axes)?;
        Ok(Self { mean, deviatoric, axes })
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct UncheckedCircle<T> {
    centre: T,
    radius: T,
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<UncheckedCircle<T>> for MohrCircle<T> {
    type Error = ContinuumError;

    fn try_from(UncheckedCircle { centre, radius }: UncheckedCircle<T>) -> Result<Self, ContinuumError> {
        check_finite("circle", &[centre, radius])?;
        check_range("radius", radius, f64::INFINITY)?;
        Ok(Self { centre, radius })
    }
}

impl<T: Real> PrincipalStresses<T> {
    /// Of a symmetric stress tensor.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(stress: &Symmetric<T>) -> Self {
        // Of a quarter, so that nothing overflows.
        let quarter = *stress * T::lit(0.25);
        let decomposition = decompose(&quarter.deviator());
        let [first, second, third] = decomposition.values;
        let four = T::lit(4.0);
        Self {
            mean: mean(stress),
            deviatoric: [first * four, second * four, third * four],
            axes: decomposition.vectors,
        }
    }

    /// σ₁ ≥ σ₂ ≥ σ₃, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn values(&self) -> [T; 3] {
        let [first, second, third] = self.deviatoric;
        [self.mean + first, self.mean + second, self.mean + third]
    }

    /// The directions n₁, n₂, n₃: normals of the planes without shear.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn directions(&self) -> [UnitNormal<T>; 3] {
        let [first, second, third] = self.axes;
        [UnitNormal::trusted(first), UnitNormal::trusted(second), UnitNormal::trusted(third)]
    }

    /// nₖ ⊗ nₖ, which unlike nₖ have no sign to choose.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn projectors(&self) -> [Symmetric<T>; 3] {
        let square =
            |n: [T; 3]| Symmetric::new(n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[0] * n[2]);
        [square(self.axes[0]), square(self.axes[1]), square(self.axes[2])]
    }

    /// ½ (σ₁ − σ₃), Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn maximum_shear(&self) -> T {
        T::lit(0.5) * (self.deviatoric[0] - self.deviatoric[2])
    }

    /// Mohr's circles: first the outer one of σ₁ and σ₃, then those of σ₁ and σ₂ and of σ₂ and σ₃.
    ///
    /// The normal and shear tractions of all planes lie in the outer circle and outside of the others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mohr_circles(&self) -> [MohrCircle<T>; 3] {
        let half = T::lit(0.5);
        let [first, second, third] = self.deviatoric;
        let circle = |upper: T, lower: T| MohrCircle {
            centre: self.mean + half * (upper + lower),
            radius: half * (upper - lower),
        };
        [circle(first, third), circle(first, second), circle(second, third)]
    }
}

impl<T: Real> CauchyStress<T> {
    /// Principal stresses and directions: see [`PrincipalStresses`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn principal(&self) -> PrincipalStresses<T> {
        PrincipalStresses::of(&self.0)
    }
}

impl<T: Real> KirchhoffStress<T> {
    /// Principal stresses and directions: see [`PrincipalStresses`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn principal(&self) -> PrincipalStresses<T> {
        PrincipalStresses::of(&self.0)
    }
}
