//! Balls, spherical shells and ellipsoids.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::ContinuumError;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{determinant, rows_of};

use super::{Region, SurfacePoint, VolumePoint, check_length, lift, moved_element};
use crate::FieldsError;
use crate::error::check_finite;
use crate::integral::Quadrature;

/// The ball |x − c| ≤ R.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Ball, Quadrature};
/// let ball = Ball::new(Vector3::zeros(), 1.0)?;
/// let second_moment = Quadrature::of_degree(2)?.volume_integral(&ball, |x: &Vector3<f64>| x.z * x.z)?;
/// assert!((second_moment - 4.0 * core::f64::consts::PI / 15.0).abs() < 1e-15);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "([f64; 3], f64)", into = "([f64; 3], f64)"))]
pub struct Ball {
    centre: Vector3<f64>,
    radius: f64,
}

impl Ball {
    /// The ball about `centre` with `radius`, m.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`], [`FieldsError::NotPositive`].
    pub fn new(centre: Vector3<f64>, radius: f64) -> Result<Self, FieldsError> {
        check_finite("centre", centre.as_slice())?;
        check_length("radius", radius)?;
        Ok(Self { centre, radius })
    }
}

impl TryFrom<([f64; 3], f64)> for Ball {
    type Error = FieldsError;
    fn try_from((centre, radius): ([f64; 3], f64)) -> Result<Self, FieldsError> {
        Self::new(centre.into(), radius)
    }
}

impl From<Ball> for ([f64; 3], f64) {
    fn from(ball: Ball) -> Self {
        (ball.centre.into(), ball.radius)
    }
}

/// The spherical shell R₁ ≤ |x − c| ≤ R₂ with 0 < R₁.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Quadrature, SphericalShell};
/// let shell = SphericalShell::new(Vector3::zeros(), [1.0, 2.0])?;
/// let volume = Quadrature::of_degree(0)?.volume_integral(&shell, |_: &Vector3<f64>| 1.0)?;
/// assert!((volume - 28.0 / 3.0 * core::f64::consts::PI).abs() < 1e-13);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "([f64; 3], [f64; 2])", into = "([f64; 3], [f64; 2])"))]
pub struct SphericalShell {
    centre: Vector3<f64>,
    radii: [f64; 2],
}

impl SphericalShell {
    /// The shell about `centre` between two radii, m.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`]; [`FieldsError::NotPositive`] unless 0 < R₁ and 0 < R₂ − R₁.
    pub fn new(centre: Vector3<f64>, radii: [f64; 2]) -> Result<Self, FieldsError> {
        check_finite("centre", centre.as_slice())?;
        check_length("inner radius", radii[0])?;
        check_length("thickness", radii[1] - radii[0])?;
        Ok(Self { centre, radii })
    }
}

impl TryFrom<([f64; 3], [f64; 2])> for SphericalShell {
    type Error = FieldsError;
    fn try_from((centre, radii): ([f64; 3], [f64; 2])) -> Result<Self, FieldsError> {
        Self::new(centre.into(), radii)
    }
}

impl From<SphericalShell> for ([f64; 3], [f64; 2]) {
    fn from(shell: SphericalShell) -> Self {
        (shell.centre.into(), shell.radii)
    }
}

/// The ellipsoid c + A ξ with |ξ| ≤ 1; the columns of A are conjugate semi-diameters, for instance its semi-axes.
///
/// The rule of the boundary is not exact for polynomials, because the area element is none; its error falls
/// exponentially with the degree.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::integral::{Ellipsoid, Quadrature};
/// let semi_axes = Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 3.0));
/// let ellipsoid = Ellipsoid::new(Vector3::zeros(), semi_axes)?;
/// let volume = Quadrature::of_degree(0)?.volume_integral(&ellipsoid, |_: &Vector3<f64>| 1.0)?;
/// assert!((volume - 8.0 * core::f64::consts::PI).abs() < 1e-14);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "([f64; 3], [[f64; 3]; 3])", into = "([f64; 3], [[f64; 3]; 3])"))]
pub struct Ellipsoid {
    centre: Vector3<f64>,
    semi_axes: Matrix3<f64>,
}

impl Ellipsoid {
    /// The ellipsoid about `centre` with the columns of `semi_axes`, m.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`]; [`ContinuumError::NonPositiveJacobian`](piola_continuum::ContinuumError::NonPositiveJacobian) unless 0 < det A.
    pub fn new(centre: Vector3<f64>, semi_axes: Matrix3<f64>) -> Result<Self, FieldsError> {
        check_finite("centre", centre.as_slice())?;
        let rows = rows_of(&semi_axes);
        check_finite("semi-axes", rows.as_flattened())?;
        let determinant = determinant(rows);
        if determinant <= 0.0 {
            return Err(ContinuumError::NonPositiveJacobian { determinant }.into());
        }
        Ok(Self { centre, semi_axes })
    }
}

impl TryFrom<([f64; 3], [[f64; 3]; 3])> for Ellipsoid {
    type Error = FieldsError;
    fn try_from((centre, rows): ([f64; 3], [[f64; 3]; 3])) -> Result<Self, FieldsError> {
        Self::new(centre.into(), piola_numerics::linear::matrix3::from_rows(rows))
    }
}

impl From<Ellipsoid> for ([f64; 3], [[f64; 3]; 3]) {
    fn from(ellipsoid: Ellipsoid) -> Self {
        (ellipsoid.centre.into(), rows_of(&ellipsoid.semi_axes))
    }
}

/// Points ξ of the spherical layer r₁ ≤ |ξ| ≤ r₂ about the origin.
fn layer_points(
    [inner, outer]: [f64; 2],
    quadrature: &Quadrature,
    mut visit: impl FnMut(Vector3<f64>, f64) -> Result<(), FieldsError>,
) -> Result<(), FieldsError> {
    for &(s, a) in &quadrature.radius {
        let radius = inner * (1.0 - s) + outer * s;
        let weight = a * (outer - inner) * radius * radius;
        sphere_points(quadrature, |direction, b| visit(direction * radius, weight * b))?;
    }
    Ok(())
}

/// Directions of the unit sphere: the height μ = cos θ by Gauss–Legendre, the azimuth equally spaced.
fn sphere_points(
    quadrature: &Quadrature,
    mut visit: impl FnMut(Vector3<f64>, f64) -> Result<(), FieldsError>,
) -> Result<(), FieldsError> {
    let share = core::f64::consts::TAU / quadrature.circle.len() as f64;
    for &(s, a) in &quadrature.line {
        let height = 2.0 * s - 1.0;
        let radius = 2.0 * (s * (1.0 - s)).sqrt();
        for &[cosine, sine] in &quadrature.circle {
            visit(Vector3::new(radius * cosine, radius * sine, height), 2.0 * a * share)?;
        }
    }
    Ok(())
}

impl<T: Real> Region<T> for Ball {
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        layer_points([0.0, self.radius], quadrature, |from_centre, weight| {
            visit(VolumePoint { position: lift(&(self.centre + from_centre)), weight: T::lit(weight), element: 0 })
        })
    }

    fn surface_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        sphere_points(quadrature, |normal, weight| {
            let position = lift(&(self.centre + normal * self.radius));
            let weight = T::lit(weight * self.radius * self.radius);
            visit(SurfacePoint { position, normal: lift(&normal), weight, face: 0 })
        })
    }
}

impl<T: Real> Region<T> for SphericalShell {
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        layer_points(self.radii, quadrature, |from_centre, weight| {
            visit(VolumePoint { position: lift(&(self.centre + from_centre)), weight: T::lit(weight), element: 0 })
        })
    }

    fn surface_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let [inner, outer] = self.radii;
        for (face, radius, side) in [(0, outer, 1.0), (1, inner, -1.0)] {
            sphere_points(quadrature, |direction, weight| {
                let position = lift(&(self.centre + direction * radius));
                let weight = T::lit(weight * radius * radius);
                visit(SurfacePoint { position, normal: lift(&(direction * side)), weight, face })
            })?;
        }
        Ok(())
    }
}

impl<T: Real> Region<T> for Ellipsoid {
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let ratio = determinant(rows_of(&self.semi_axes));
        layer_points([0.0, 1.0], quadrature, |of_ball, weight| {
            let position = lift(&(self.centre + self.semi_axes * of_ball));
            visit(VolumePoint { position, weight: T::lit(weight * ratio), element: 0 })
        })
    }

    fn surface_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        let rows = rows_of(&self.semi_axes);
        sphere_points(quadrature, |direction, weight| {
            let position = lift(&(self.centre + self.semi_axes * direction));
            let (normal, ratio) = moved_element(rows, &direction);
            visit(SurfacePoint { position, normal: lift(&normal), weight: T::lit(weight * ratio), face: 0 })
        })
    }
}
