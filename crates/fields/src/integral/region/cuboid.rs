//! Boxes with edges along the axes.

use nalgebra::Vector3;
use piola_numerics::Real;

use super::{Region, SurfacePoint, VolumePoint, lift};
use crate::FieldsError;
use crate::error::check_finite;
use crate::integral::Quadrature;

/// The box a ≤ x ≤ b, component by component.
///
/// Rules are exact for polynomials of the rule's degree in each coordinate.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Cuboid, Quadrature, SurfacePoint};
/// let brick = Cuboid::new(Vector3::zeros(), Vector3::new(1.0, 2.0, 3.0))?;
/// let area = Quadrature::of_degree(0)?.surface_integral(&brick, |_: &SurfacePoint<f64>| 1.0)?;
/// assert_eq!(area, 22.0);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[[f64; 3]; 2]", into = "[[f64; 3]; 2]"))]
pub struct Cuboid {
    lower: Vector3<f64>,
    upper: Vector3<f64>,
}

impl Cuboid {
    /// The box between two corners, m.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`]; [`FieldsError::NotPositive`] of the edge that is not positive.
    pub fn new(lower: Vector3<f64>, upper: Vector3<f64>) -> Result<Self, FieldsError> {
        check_finite("lower corner", lower.as_slice())?;
        check_finite("upper corner", upper.as_slice())?;
        let edges = upper - lower;
        check_finite("edge", edges.as_slice())?;
        for (index, &value) in edges.iter().enumerate() {
            if value <= 0.0 {
                return Err(FieldsError::NotPositive { quantity: "edge", index, value });
            }
        }
        Ok(Self { lower, upper })
    }

    /// The corner with the smallest coordinates.
    #[must_use]
    pub fn lower(&self) -> Vector3<f64> {
        self.lower
    }

    /// The corner with the largest coordinates.
    #[must_use]
    pub fn upper(&self) -> Vector3<f64> {
        self.upper
    }

    /// The point with coordinates `s` relative to the edges.
    fn at(&self, s: [f64; 3]) -> Vector3<f64> {
        Vector3::from_fn(|i, _| self.lower[i] * (1.0 - s[i]) + self.upper[i] * s[i])
    }
}

impl<T: Real> Region<T> for Cuboid {
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let edges = self.upper - self.lower;
        let volume = edges.x * edges.y * edges.z;
        for &(x, a) in &quadrature.line {
            for &(y, b) in &quadrature.line {
                for &(z, c) in &quadrature.line {
                    let weight = T::lit(a * b * c * volume);
                    visit(VolumePoint { position: lift(&self.at([x, y, z])), weight, element: 0 })?;
                }
            }
        }
        Ok(())
    }

    fn surface_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let edges = self.upper - self.lower;
        for face in 0..6 {
            let (across, end) = (face / 2, (face % 2) as f64);
            let (first, second) = ((across + 1) % 3, (across + 2) % 3);
            let mut normal = Vector3::zeros();
            normal[across] = 2.0 * end - 1.0;
            for &(u, a) in &quadrature.line {
                for &(v, b) in &quadrature.line {
                    let mut s = [end; 3];
                    (s[first], s[second]) = (u, v);
                    let weight = T::lit(a * b * edges[first] * edges[second]);
                    visit(SurfacePoint { position: lift(&self.at(s)), normal: lift(&normal), weight, face })?;
                }
            }
        }
        Ok(())
    }
}

impl TryFrom<[[f64; 3]; 2]> for Cuboid {
    type Error = FieldsError;
    fn try_from([lower, upper]: [[f64; 3]; 2]) -> Result<Self, FieldsError> {
        Self::new(lower.into(), upper.into())
    }
}

impl From<Cuboid> for [[f64; 3]; 2] {
    fn from(cuboid: Cuboid) -> Self {
        [cuboid.lower.into(), cuboid.upper.into()]
    }
}
