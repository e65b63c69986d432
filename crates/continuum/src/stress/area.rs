//! Areas, forces per area and forces per volume carried from the reference to the deformed body.
//!
//! ```text
//! n da = J F⁻ᵀ N dA = Cof F N dA        N dA = J⁻¹ Fᵀ n da                  Nanson
//! g = J |F⁻ᵀ N| g̃                       f = J f̃                             B(4.39), B(4.38)
//! ```
//! with g̃, f̃ per deformed area and volume and g, f per reference area and volume.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_tensor::internal::rows::{apply, transpose};
use piola_tensor::internal::scale::norm;

use super::normal::normalized;
use super::{ReferenceNormal, UnitNormal};
use crate::{ContinuumError, Deformation};

/// What a deformation makes of a unit of area, by Nanson's formula.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_continuum::{DeformationGradient, ReferenceNormal};
/// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 3.0, 4.0].into()))?;
/// let area = ReferenceNormal::new(Vector3::x())?.deformed(&stretch);
/// assert_eq!(area.vector, Vector3::new(12.0, 0.0, 0.0)); // a face of 1 by 1 has become one of 3 by 4
/// assert_eq!((area.ratio, area.normal.vector()), (12.0, Vector3::x()));
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// B(4.39).
///
/// With serde it is the vector alone.
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
pub struct DeformedArea<T = f64> {
    /// n da/dA = J F⁻ᵀ N.
    pub vector: Vector3<T>,
    /// da/dA = J |F⁻ᵀ N|.
    pub ratio: T,
    /// n.
    pub normal: UnitNormal<T>,
}

impl<T: Real> ReferenceNormal<T> {
    /// n da = J F⁻ᵀ N dA: the deformed area for each unit of reference area, see [`DeformedArea`].
    ///
    /// # Accuracy
    /// A few ulp of |F|² for the vector; no division, so also for nearly flattened bodies.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn deformed(&self, deformation: &impl Deformation<T>) -> DeformedArea<T> {
        DeformedArea::of_vector(apply(deformation.cofactor_rows(), self.components()))
    }
}

impl<T: Real> DeformedArea<T> {
    /// The ratio and the normal of an area vector that is not zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_vector(vector: [T; 3]) -> Self {
        Self { vector: Vector3::from(vector), ratio: norm(vector), normal: UnitNormal::trusted(normalized(vector)) }
    }
}

/// From the vector n da/dA.
///
/// # Errors
/// [`ContinuumError::NotFinite`], [`ContinuumError::ZeroNormal`].
impl<T: Real> TryFrom<[T; 3]> for DeformedArea<T> {
    type Error = ContinuumError;
    fn try_from(vector: [T; 3]) -> Result<Self, ContinuumError> {
        UnitNormal::new(Vector3::from(vector))?;
        Ok(Self::of_vector(vector))
    }
}

impl<T: Real> From<DeformedArea<T>> for [T; 3] {
    fn from(area: DeformedArea<T>) -> Self {
        [area.vector[0], area.vector[1], area.vector[2]]
    }
}

impl<T: Real> UnitNormal<T> {
    /// N and dA/da of the surface that the deformation has brought here: N dA = J⁻¹ Fᵀ n da.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn reference(&self, deformation: &impl Deformation<T>) -> (ReferenceNormal<T>, T) {
        let f = deformation.gradient_rows();
        let vector = apply(transpose(f), self.components());
        (ReferenceNormal::trusted(normalized(vector)), norm(vector) / deformation.jacobian())
    }
}

/// g = J |F⁻ᵀ N| g̃: a surface force per deformed area, as one per reference area.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | F | `deformation` | 3×3 | – |
/// | N | `normal` | 3, unit | – |
/// | g̃ | `force` | 3 | N per deformed m² |
/// | g | returned | 3 | N per reference m² |
///
/// # Source
/// B(4.39).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn reference_surface_force<T: Real>(
    deformation: &impl Deformation<T>,
    normal: &ReferenceNormal<T>,
    force: &Vector3<T>,
) -> Vector3<T> {
    let ratio = norm(apply(deformation.cofactor_rows(), normal.components()));
    Vector3::new(force[0] * ratio, force[1] * ratio, force[2] * ratio)
}

/// f = J f̃: a force per deformed volume, N/m³, as one per reference volume.
///
/// It is not the body force b, which is per mass and the same in both.
///
/// # Source
/// B(4.38).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn reference_force_per_volume<T: Real>(
    deformation: &impl Deformation<T>,
    force_per_volume: &Vector3<T>,
) -> Vector3<T> {
    let jacobian = deformation.jacobian();
    Vector3::from(core::array::from_fn::<T, 3, _>(|i| force_per_volume[i] * jacobian))
}
