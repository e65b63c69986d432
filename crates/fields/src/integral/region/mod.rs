//! Regions of space with rules of quadrature inside and on their boundary.
//!
//! | region | interior exact for polynomials | boundary exact for polynomials |
//! |---|---|---|
//! | [`Cuboid`] | yes | yes |
//! | [`Ball`], [`SphericalShell`] | yes | yes |
//! | [`Ellipsoid`] | yes | no: exponentially convergent |
//! | [`Cylinder`] (solid or hollow) | yes | yes |
//! | [`TetrahedralMesh`](super::TetrahedralMesh) | yes | yes |
//! | [`MovedRegion`]: the image of a region under a motion | with J times the integrand a polynomial of X | |
//!
//! A region is a set of places of a body or of space; it is given by numbers, and its points are asked for over
//! any scalar `T`, so that a moved region can carry derivatives with respect to time.

mod cuboid;
mod cylinder;
mod moved;
mod round;

pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use moved::MovedRegion;
pub(super) use moved::placed;
pub use round::{Ball, Ellipsoid, SphericalShell};

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;

use super::Quadrature;
use crate::FieldsError;
use crate::error::check_finite;
use piola_tensor::internal::rows::cofactor;
use piola_tensor::internal::rows::{Rows, apply};

/// A point of a rule inside a region.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: crate::integrand::Integrand<Scalar = T> + Real + serde::Deserialize<'de>"
    ))
)]
pub struct VolumePoint<T = f64> {
    /// The place, m.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub position: Vector3<T>,
    /// Its share of the volume, m³.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub weight: T,
    /// The element of a mesh that it lies in; 0 elsewhere.
    pub element: usize,
}

/// A point of a rule on the boundary of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: crate::integrand::Integrand<Scalar = T> + Real + serde::Deserialize<'de>"
    ))
)]
pub struct SurfacePoint<T = f64> {
    /// The place, m.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub position: Vector3<T>,
    /// The outward unit normal.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub normal: Vector3<T>,
    /// Its share of the area, m².
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub weight: T,
    /// The face it lies on: that of a box in the order −x, +x, −y, +y, −z, +z; of a cylinder bottom, top, outer,
    /// inner; of a shell outer, inner; the boundary triangle of a mesh.
    pub face: usize,
}

/// A region of space that knows its rules of quadrature.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Ball, Quadrature, Region, VolumePoint};
/// let ball = Ball::new(Vector3::zeros(), 2.0)?;
/// let mut count = 0;
/// ball.volume_points(&Quadrature::of_degree(1)?, |_: VolumePoint<f64>| {
///     count += 1;
///     Ok(())
/// })?;
/// assert_eq!(count, 2 * 1 * 2); // radius × height × circle
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
pub trait Region<T: Real = f64> {
    /// Visits the points of the rule of the interior, until the visitor returns an error.
    ///
    /// # Errors
    /// The visitor's; that of a place where the region is not regular.
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError>;

    /// Visits the points of the rule of the boundary, until the visitor returns an error.
    ///
    /// # Errors
    /// As [`volume_points`](Self::volume_points).
    fn surface_points(
        &self,
        quadrature: &Quadrature,
        visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError>;
}

/// A constant vector over another scalar.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn lift<T: Real>(vector: &Vector3<f64>) -> Vector3<T> {
    vector.map(T::lit)
}

/// The image of a surface element under a map with gradient F: the unit normal n and da/dA.
///
/// ```text
/// n da = (Cof F) N dA        B(4.39)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn moved_element<T: Real>(gradient: Rows<T>, normal: &Vector3<T>) -> (Vector3<T>, T) {
    let moved = apply(cofactor(gradient), [normal.x, normal.y, normal.z]);
    let ratio = dot(moved, moved).sqrt();
    let scale = ratio.recip();
    (Vector3::from(moved.map(|component| component * scale)), ratio)
}

/// 0 < a length, finite.
fn check_length(quantity: &'static str, value: f64) -> Result<(), FieldsError> {
    check_finite(quantity, &[value])?;
    if 0.0 < value { Ok(()) } else { Err(FieldsError::NotPositive { quantity, index: 0, value }) }
}

/// A right-handed orthonormal basis (as columns) whose third vector is the given unit vector.
fn basis_of_axis(axis: &Vector3<f64>) -> Matrix3<f64> {
    // Across the axis's smallest component, where the product is longest.
    let smallest = axis.iamin();
    let mut across = Vector3::zeros();
    across[smallest] = 1.0;
    let first = across.cross(axis).normalize();
    Matrix3::from_columns(&[first, axis.cross(&first), *axis])
}
