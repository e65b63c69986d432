//! Rules of quadrature on the elements and boundary triangles of a mesh.

use nalgebra::Vector3;
use piola_numerics::Real;

use super::TetrahedralMesh;
use crate::FieldsError;
use crate::integral::Quadrature;
use crate::integral::region::{Region, SurfacePoint, VolumePoint, lift};

impl<T: Real> Region<T> for TetrahedralMesh {
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        for (element, &volume) in self.volumes().iter().enumerate() {
            let corners = self.corners(element);
            for (share, weight) in &quadrature.tetrahedron {
                let position = lift(&weighted(share, &corners));
                visit(VolumePoint { position, weight: T::lit(weight * volume), element })?;
            }
        }
        Ok(())
    }

    fn surface_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        for (face, triangle) in self.boundary().iter().enumerate() {
            let corners = triangle.vertices.map(|vertex| self.vertices()[vertex]);
            let (normal, area) = normal_and_area(&corners);
            let normal = lift(&normal);
            for (share, weight) in &quadrature.triangle {
                let position = lift(&weighted(share, &corners));
                visit(SurfacePoint { position, normal, weight: T::lit(weight * area), face })?;
            }
        }
        Ok(())
    }
}

/// The point with barycentric coordinates `share`.
pub(in crate::integral) fn weighted<const N: usize>(share: &[f64; N], corners: &[Vector3<f64>; N]) -> Vector3<f64> {
    share.iter().zip(corners).fold(Vector3::zeros(), |sum, (&share, corner)| sum + corner * share)
}

/// The unit normal, by which the corners run counter-clockwise, and the area.
pub(in crate::integral) fn normal_and_area(corners: &[Vector3<f64>; 3]) -> (Vector3<f64>, f64) {
    let product = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let length = product.norm();
    (product / length, 0.5 * length)
}
