//! Tractions on surfaces, and Cauchy's tetrahedron.
//!
//! ```text
//! t = T n   W(16.4)          tₙ = n·T n,   t_s = t − tₙ n           per deformed area
//! P N                                                               per reference area
//! t(n) = Σ nᵢ t(eᵢ)   W(16.9)
//! ```
//!
//! The normal and the shear traction are computed from the deviator, so that shear of 1 Pa under a pressure of
//! 10⁹ Pa keeps all its digits.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;
use piola_tensor::internal::rows::apply;
use piola_tensor::internal::scale::norm;

use super::invariants::{deviator, mean};
use super::{CauchyStress, FirstPiola, ReferenceNormal, UnitNormal};
use crate::ContinuumError;

impl<T: Real> CauchyStress<T> {
    /// The traction t = T n, Pa: the force per deformed area on the side from which n points.
    ///
    /// # Accuracy
    /// 3 ulp of |T|.
    ///
    /// # Source
    /// W(16.4).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn traction(&self, normal: &UnitNormal<T>) -> Vector3<T> {
        Vector3::from(self.0.apply(normal.components()))
    }

    /// The normal traction n·T n, Pa, positive in tension.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn normal_traction(&self, normal: &UnitNormal<T>) -> T {
        let n = normal.components();
        mean(&self.0) + dot(n, deviator(&self.0).apply(n))
    }

    /// The shear traction t − (n·t) n, Pa: the part of the traction along the surface.
    ///
    /// # Accuracy
    /// A few ulp of the deviator's norm, whatever the pressure.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn shear_traction(&self, normal: &UnitNormal<T>) -> Vector3<T> {
        Vector3::from(self.shear_traction_components(normal))
    }

    /// |t − (n·t) n|, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn shear_traction_size(&self, normal: &UnitNormal<T>) -> T {
        norm(self.shear_traction_components(normal))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_traction_components(&self, normal: &UnitNormal<T>) -> [T; 3] {
        let n = normal.components();
        let t = deviator(&self.0).apply(n);
        let along = dot(n, t);
        [t[0] - along * n[0], t[1] - along * n[1], t[2] - along * n[2]]
    }

    /// The stress whose tractions on the planes with normals e₁, e₂, e₃ are given: T eᵢ = tᵢ.
    ///
    /// # Errors
    /// As [`from_matrix`](Self::from_matrix): tractions measured independently need not balance in moment.
    ///
    /// # Source
    /// W(16.8–16.9).
    pub fn of_coordinate_tractions(tractions: &[Vector3<T>; 3]) -> Result<Self, ContinuumError> {
        Self::from_matrix(&Matrix3::from_fn(|i, j| tractions[j][i]))
    }
}

impl<T: Real> FirstPiola<T> {
    /// The traction P N, Pa: the force per reference area.
    ///
    /// # Source
    /// W(17.21).
    #[doc(alias = "nominal traction")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn traction(&self, normal: &ReferenceNormal<T>) -> Vector3<T> {
        Vector3::from(apply(self.rows(), normal.components()))
    }
}

/// The mean traction on the oblique face of Cauchy's tetrahedron, exact for any stress field.
///
/// The tetrahedron has three faces normal to −e₁, −e₂, −e₃ and one with normal n = (n₁, n₂, n₃), 0 < nᵢ, at height h
/// from its vertex. Its momentum balances when
///
/// ```text
/// t̄(n) = Σ nᵢ t̄(eᵢ) − ⅓ h f̄,    f̄ = mean of ρ (b − a);      t(n) = Σ nᵢ t(eᵢ) for h → 0
/// ```
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | t̄(eᵢ) | `coordinate_tractions` | 3 vectors | Pa: mean tractions *with* normals +eᵢ |
/// | n | `normal` | 3, unit | – |
/// | h | `height` | 1 | m |
/// | f̄ | `force_per_volume`, inertia ρ a taken off | 3 | N/m³ |
///
/// With height zero it is Cauchy's theorem: the traction on any plane through a point from those on three, for
/// normals into any octant.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::UnitNormal;
/// use piola_continuum::stress::oblique_traction;
/// let water = [Vector3::x() * -5.0, Vector3::y() * -5.0, Vector3::z() * -5.0];
/// let normal = UnitNormal::new(Vector3::new(0.0, 3.0, 4.0))?;
/// // Pressure is the same on every plane ...
/// assert_eq!(oblique_traction(&water, &normal, 0.0, &Vector3::zeros()), Vector3::new(0.0, -3.0, -4.0));
/// // ... of a small piece: the weight of 6 m of a fluid of 2 N/m³ bears on the face.
/// let weight = Vector3::new(0.0, 0.0, -2.0);
/// assert_eq!(oblique_traction(&water, &normal, 6.0, &weight), Vector3::new(0.0, -3.0, 0.0));
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(16.5–16.9).
#[inline]
#[must_use]
pub fn oblique_traction<T: Real>(
    coordinate_tractions: &[Vector3<T>; 3],
    normal: &UnitNormal<T>,
    height: T,
    force_per_volume: &Vector3<T>,
) -> Vector3<T> {
    let n = normal.components();
    let third = height / T::lit(3.0);
    let [t1, t2, t3] = coordinate_tractions;
    Vector3::from(core::array::from_fn::<T, 3, _>(|i| dot(n, [t1[i], t2[i], t3[i]]) - third * force_per_volume[i]))
}
