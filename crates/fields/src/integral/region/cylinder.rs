//! Circular cylinders, solid or hollow.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;

use super::{Region, SurfacePoint, VolumePoint, basis_of_axis, check_length, lift};
use crate::FieldsError;
use crate::error::check_finite;
use crate::integral::Quadrature;

/// A circular cylinder R₁ ≤ r ≤ R₂ over the segment from its base along its axis; R₁ = 0 when it is solid.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Cylinder, Quadrature};
/// let tube = Cylinder::new(Vector3::zeros(), Vector3::new(0.0, 0.0, 5.0), [1.0, 2.0])?;
/// let volume = Quadrature::of_degree(0)?.volume_integral(&tube, |_: &Vector3<f64>| 1.0)?;
/// assert!((volume - 15.0 * core::f64::consts::PI).abs() < 1e-13);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "WrittenCylinder", into = "WrittenCylinder"))]
pub struct Cylinder {
    base: Vector3<f64>,
    axis: Vector3<f64>,
    radii: [f64; 2],
}

/// (centre of the base, axis, radii).
type WrittenCylinder = ([f64; 3], [f64; 3], [f64; 2]);

impl Cylinder {
    /// The cylinder from the centre of its base along `axis`, which has its height, between two radii, m.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`]; [`FieldsError::NotPositive`] unless 0 < |axis|, 0 ≤ R₁, R₁ < R₂.
    pub fn new(base: Vector3<f64>, axis: Vector3<f64>, radii: [f64; 2]) -> Result<Self, FieldsError> {
        check_finite("centre of the base", base.as_slice())?;
        check_finite("axis", axis.as_slice())?;
        check_finite("radius", &radii)?;
        check_length("height", axis.norm())?;
        if radii[0] < 0.0 {
            return Err(FieldsError::NotPositive { quantity: "inner radius", index: 0, value: radii[0] });
        }
        check_length("thickness", radii[1] - radii[0])?;
        Ok(Self { base, axis, radii })
    }

    fn height(&self) -> f64 {
        self.axis.norm()
    }

    fn basis(&self) -> Matrix3<f64> {
        basis_of_axis(&(self.axis / self.height()))
    }

    /// Points of the cross-section: across the axis from it, with shares of the area.
    fn section_points(
        &self,
        quadrature: &Quadrature,
        basis: &Matrix3<f64>,
        mut visit: impl FnMut(Vector3<f64>, f64) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let [inner, outer] = self.radii;
        for &(s, a) in &quadrature.radius {
            let radius = inner * (1.0 - s) + outer * s;
            let weight = a * (outer - inner) * radius;
            circle_points(quadrature, basis, |direction, b| visit(direction * radius, weight * b))?;
        }
        Ok(())
    }
}

/// Unit vectors across the axis, with shares of 2π.
fn circle_points(
    quadrature: &Quadrature,
    basis: &Matrix3<f64>,
    mut visit: impl FnMut(Vector3<f64>, f64) -> Result<(), FieldsError>,
) -> Result<(), FieldsError> {
    let share = core::f64::consts::TAU / quadrature.circle.len() as f64;
    for &[cosine, sine] in &quadrature.circle {
        visit(basis.column(0) * cosine + basis.column(1) * sine, share)?;
    }
    Ok(())
}

impl<T: Real> Region<T> for Cylinder {
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let (basis, height) = (self.basis(), self.height());
        for &(s, a) in &quadrature.line {
            let on_axis = self.base + self.axis * s;
            self.section_points(quadrature, &basis, |across, weight| {
                let weight = T::lit(a * height * weight);
                visit(VolumePoint { position: lift(&(on_axis + across)), weight, element: 0 })
            })?;
        }
        Ok(())
    }

    fn surface_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let (basis, height) = (self.basis(), self.height());
        for (face, end) in [(0, 0.0), (1, 1.0)] {
            let normal = lift(&(basis.column(2) * (2.0 * end - 1.0)));
            let on_axis = self.base + self.axis * end;
            self.section_points(quadrature, &basis, |across, weight| {
                visit(SurfacePoint { position: lift(&(on_axis + across)), normal, weight: T::lit(weight), face })
            })?;
        }
        let [inner, outer] = self.radii;
        for (face, radius, side) in [(2, outer, 1.0), (3, inner, -1.0)] {
            if radius <= 0.0 {
                continue; // a solid cylinder has no inner face
            }
            for &(s, a) in &quadrature.line {
                let on_axis = self.base + self.axis * s;
                circle_points(quadrature, &basis, |direction, b| {
                    let position = lift(&(on_axis + direction * radius));
                    let weight = T::lit(a * height * radius * b);
                    visit(SurfacePoint { position, normal: lift(&(direction * side)), weight, face })
                })?;
            }
        }
        Ok(())
    }
}

impl TryFrom<WrittenCylinder> for Cylinder {
    type Error = FieldsError;
    fn try_from((base, axis, radii): WrittenCylinder) -> Result<Self, FieldsError> {
        Self::new(base.into(), axis.into(), radii)
    }
}

impl From<Cylinder> for WrittenCylinder {
    fn from(cylinder: Cylinder) -> Self {
        (cylinder.base.into(), cylinder.axis.into(), cylinder.radii)
    }
}
