//! The image of a region under a motion.

use nalgebra::Vector3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::{Region, SurfacePoint, VolumePoint, moved_element};
use crate::FieldsError;
use crate::Motion;
use crate::integral::Quadrature;
use crate::motion::check_event;
use crate::motion::kernels::place_and_gradient;

/// The region that a motion makes of another one at a time: χ(𝒫, t).
///
/// ```text
/// ∫ g dv over χ(𝒫, t) = ∫ g(χ(X, t)) J dV over 𝒫,        n da = J F⁻ᵀ N dA
/// ```
///
/// With a time that is a [`Dual`](piola_numerics::Dual) variable, an integral over it carries its derivative with
/// respect to time, exact to rounding: the rate of change of an integral over a moving region.
///
/// # Errors
/// Visiting its points refuses, with [`ContinuumError::NonPositiveJacobian`](piola_continuum::ContinuumError::NonPositiveJacobian), places where 0 < J is violated, and
/// whatever the motion refuses.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::Motion;
/// use piola_fields::integral::{Ball, MovedRegion, Quadrature};
/// use piola_numerics::{Dual, Real};
/// struct Swelling;
/// impl Motion for Swelling {
///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
///         reference * (T::lit(1.0) + time)
///     }
/// }
/// let ball = Ball::new(Vector3::zeros(), 1.0)?;
/// let moved = MovedRegion { region: &ball, motion: &Swelling, time: Dual::variable(1.0) };
/// let volume = Quadrature::of_degree(0)?.volume_integral(&moved, |_: &_| Dual::lit(1.0))?;
/// let unit = 4.0 / 3.0 * core::f64::consts::PI;
/// assert!((volume.value - 8.0 * unit).abs() < 1e-13); // (1 + t)³
/// assert!((volume.tangent - 12.0 * unit).abs() < 1e-13); // 3 (1 + t)²
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct MovedRegion<'a, R, M, T = f64> {
    /// The region in the reference configuration.
    pub region: &'a R,
    /// The motion.
    pub motion: &'a M,
    /// The time, s.
    pub time: T,
}

impl<T: Real, R: Region<T>, M: Motion> Region<T> for MovedRegion<'_, R, M, T> {
    fn volume_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(VolumePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        self.region.volume_points(quadrature, |point| {
            let (position, deformation) = placed(self.motion, &point.position, self.time)?;
            visit(VolumePoint { position, weight: point.weight * deformation.jacobian(), element: point.element })
        })
    }

    fn surface_points(
        &self,
        quadrature: &Quadrature,
        mut visit: impl FnMut(SurfacePoint<T>) -> Result<(), FieldsError>,
    ) -> Result<(), FieldsError> {
        self.region.surface_points(quadrature, |point| {
            let (position, deformation) = placed(self.motion, &point.position, self.time)?;
            let (normal, ratio) = moved_element(deformation.gradient_rows(), &point.normal);
            visit(SurfacePoint { position, normal, weight: point.weight * ratio, face: point.face })
        })
    }
}

/// (x, F) of a particle, checked, in one pass.
#[inline]
pub(in crate::integral) fn placed<T: Real>(
    motion: &impl Motion,
    particle: &Vector3<T>,
    t: T,
) -> Result<(Vector3<T>, DeformationGradient<T>), FieldsError> {
    check_event(motion, particle, t)?;
    let (place, gradient) = place_and_gradient(motion, particle, t);
    Ok((place, DeformationGradient::new(from_rows(gradient))?))
}
