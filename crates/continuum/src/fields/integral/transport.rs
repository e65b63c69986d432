//! The transport theorem: rates of integrals over moving regions, computed in independent ways.
//!
//! ```text
//! d/dt ∫ g dv  =  ∫ [∂g/∂t + div(g v)] dv  =  ∫ ∂g/∂t dv + ∮ g v·n da             B(4.25), W(17.1–17.3)
//! d/dt ∫ ρ Φ dv = ∫ ρ Φ̇ dv                                                        W(15.4)
//! ```
//!
//! The left side differentiates the integral over the moving region with respect to time by dual numbers; the
//! right sides integrate the spatial derivatives of g and the velocity gradient L, or the flux through the boundary.

use nalgebra::Vector3;
use piola_numerics::{Dual, Gradient, Real};

use super::integrand::RunningIntegral;
use super::region::lift;
use super::{MovedRegion, Quadrature, Region};
use crate::ContinuumError;
use crate::fields::Motion;
use crate::fields::motion::kernels::velocity;

/// A field of N components over space and time, stated once over any scalar.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::fields::integral::SpatialField;
/// use piola_numerics::Real;
/// struct Wave;
/// impl SpatialField<1> for Wave {
///     fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> [T; 1] {
///         [(place.x - time).sin()]
///     }
/// }
/// assert_eq!(Wave.at(&Vector3::new(2.0, 0.0, 0.0), 2.0), [0.0]);
/// ```
pub trait SpatialField<const N: usize> {
    /// g(x, t).
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> [T; N];
}

/// Both sides of the transport theorem for the part that a motion carries.
///
/// # Example
/// The volume of a ball that swells: g = 1.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::fields::Motion;
/// use piola_continuum::fields::integral::{Ball, Quadrature, SpatialField, Transport};
/// use piola_numerics::Real;
/// struct Swelling;
/// impl Motion for Swelling {
///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
///         reference * (T::lit(1.0) + time)
///     }
/// }
/// struct One;
/// impl SpatialField<1> for One {
///     fn at<T: Real>(&self, _: &Vector3<T>, _: T) -> [T; 1] {
///         [T::lit(1.0)]
///     }
/// }
/// let ball = Ball::new(Vector3::zeros(), 1.0)?;
/// let sides = Transport::new(&Quadrature::of_degree(4)?, &ball, &Swelling, &One, 0.0)?;
/// let area = 4.0 * core::f64::consts::PI;
/// assert!((sides.rate[0] - area).abs() < 1e-14 && (sides.flux[0] - area).abs() < 1e-14);
/// assert!(sides.residual()[0].abs() < 1e-14 && sides.flux_residual()[0].abs() < 1e-14);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// B(4.25), W(17.1–17.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transport<const N: usize> {
    /// d/dt ∫ g dv, by differentiation of the integral.
    pub rate: [f64; N],
    /// ∫ ∂g/∂t dv.
    pub local: [f64; N],
    /// ∫ div(g v) dv = ∫ (grad g·v + g div v) dv.
    pub convected: [f64; N],
    /// ∮ g v·n da.
    pub flux: [f64; N],
}

impl<const N: usize> Transport<N> {
    /// The terms for the part whose place in the reference configuration is `region`.
    ///
    /// The motion need not be that of matter: with the velocity of any moving boundary it is Reynolds' theorem.
    ///
    /// # Errors
    /// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
    pub fn new<R: Region<f64> + Region<Dual<f64>>>(
        quadrature: &Quadrature,
        region: &R,
        motion: &impl Motion,
        field: &impl SpatialField<N>,
        time: f64,
    ) -> Result<Self, ContinuumError> {
        let moving = MovedRegion { region, motion, time: Dual::variable(time) };
        let total: [Dual<f64>; N] =
            quadrature.volume_integral(&moving, |place: &Vector3<Dual<f64>>| field.at(place, moving.time))?;

        let (mut local, mut convected) = (RunningIntegral::new(), RunningIntegral::new());
        Region::<f64>::volume_points(region, quadrature, |point| {
            let particle = point.position;
            let volume = point.weight * crate::Deformation::jacobian(&motion.deformation_gradient(&particle, time)?);
            let place = motion.place(&particle, time);
            let (g, rate, gradient) = value_and_derivatives(field, &place, time);
            let v = velocity(motion, &particle, time);
            let divergence = motion.velocity_gradient(&particle, time)?.trace();
            let along: [f64; N] = core::array::from_fn(|k| gradient[k].dot(&v) + g[k] * divergence);
            local.add(&rate, volume, &place)?;
            convected.add(&along, volume, &place)
        })?;
        let mut flux = RunningIntegral::new();
        Region::<f64>::surface_points(region, quadrature, |point| {
            let particle = point.position;
            let gradient = motion.deformation_gradient(&particle, time)?;
            let rows = crate::Deformation::gradient_rows(&gradient);
            let (normal, ratio) = super::region::moved_element(rows, &point.normal);
            let place = motion.place(&particle, time);
            let across = velocity(motion, &particle, time).dot(&normal);
            flux.add(&field.at(&place, time).map(|g| g * across), point.weight * ratio, &place)
        })?;
        let rate = total.map(|g| g.tangent);
        Ok(Self { rate, local: local.value(), convected: convected.value(), flux: flux.value() })
    }

    /// d/dt ∫ g dv − ∫ [∂g/∂t + div(g v)] dv.
    #[must_use]
    pub fn residual(&self) -> [f64; N] {
        core::array::from_fn(|k| self.rate[k] - (self.local[k] + self.convected[k]))
    }

    /// d/dt ∫ g dv − ∫ ∂g/∂t dv − ∮ g v·n da.
    #[must_use]
    pub fn flux_residual(&self) -> [f64; N] {
        core::array::from_fn(|k| self.rate[k] - (self.local[k] + self.flux[k]))
    }
}

/// Both sides of d/dt ∫ ρ Φ dv = ∫ ρ Φ̇ dv for a body with the density ρ_κ(X): (left, right).
///
/// The left side integrates ρ Φ over the moving region, with ρ = ρ_κ/J, and differentiates; the right side
/// integrates ρ_κ (∂Φ/∂t + grad Φ·v) over the reference configuration.
///
/// # Errors
/// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
///
/// # Source
/// W(15.4).
pub fn transport_of_mass<const N: usize, R: Region<f64> + Region<Dual<f64>>>(
    quadrature: &Quadrature,
    region: &R,
    motion: &impl Motion,
    mut density: impl FnMut(&Vector3<f64>) -> f64,
    field: &impl SpatialField<N>,
    time: f64,
) -> Result<([f64; N], [f64; N]), ContinuumError> {
    let now = Dual::variable(time);
    let mut left = RunningIntegral::new();
    Region::<Dual<f64>>::volume_points(region, quadrature, |point| {
        let particle = point.position;
        let jacobian = crate::Deformation::jacobian(&motion.deformation_gradient(&particle, now)?);
        let present = Dual::constant(density(&particle.map(|x| x.value))) / jacobian;
        let place = motion.place(&particle, now);
        left.add(&field.at(&place, now).map(|phi| present * phi), point.weight * jacobian, &place)
    })?;
    let mut right = RunningIntegral::new();
    Region::<f64>::volume_points(region, quadrature, |point| {
        let particle = point.position;
        let place = motion.position(&particle, time)?;
        let (_, rate, gradient) = value_and_derivatives(field, &place, time);
        let v = velocity(motion, &particle, time);
        let material: [f64; N] = core::array::from_fn(|k| rate[k] + gradient[k].dot(&v));
        right.add(&material, point.weight * density(&particle), &particle)
    })?;
    Ok((left.value().map(|total| total.tangent), right.value()))
}

/// g, ∂g/∂t, grad g.
fn value_and_derivatives<const N: usize>(
    field: &impl SpatialField<N>,
    place: &Vector3<f64>,
    time: f64,
) -> ([f64; N], [f64; N], [Vector3<f64>; N]) {
    let variable = |i: usize| Gradient::<f64, 4>::variable(place[i], i);
    let g = field.at(&Vector3::new(variable(0), variable(1), variable(2)), Gradient::variable(time, 3));
    let gradient = |g: &Gradient<f64, 4>| Vector3::new(g.partials[0], g.partials[1], g.partials[2]);
    (g.map(|g| g.value), g.map(|g| g.partials[3]), core::array::from_fn(|k| gradient(&g[k])))
}

/// Both sides of the divergence theorem for fields of N vectors, (∫ div g dv, ∮ g n da); field 3k + j is
/// component j of vector k, so that N = 3 with the rows of a tensor gives ∫ div T dv = ∮ T n da.
///
/// # Errors
/// [`ContinuumError::NonFiniteIntegrand`]; what the region refuses.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::fields::integral::{Ball, Quadrature, SpatialField, divergence_theorem};
/// use piola_numerics::Real;
/// struct Place;
/// impl SpatialField<3> for Place {
///     fn at<T: Real>(&self, place: &Vector3<T>, _: T) -> [T; 3] {
///         (*place).into()
///     }
/// }
/// let ball = Ball::new(Vector3::zeros(), 1.0)?;
/// let ([inside], [through]) = divergence_theorem(&Quadrature::of_degree(2)?, &ball, &Place, 0.0)?;
/// assert!((inside - 4.0 * core::f64::consts::PI).abs() < 1e-14 && (inside - through).abs() < 1e-14);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub fn divergence_theorem<const N: usize, const M: usize>(
    quadrature: &Quadrature,
    region: &impl Region<f64>,
    field: &impl SpatialField<N>,
    time: f64,
) -> Result<([f64; M], [f64; M]), ContinuumError> {
    const { assert!(N == 3 * M, "three components for each vector") };
    let mut inside = RunningIntegral::new();
    region.volume_points(quadrature, |point| {
        let (_, _, gradient) = value_and_derivatives(field, &point.position, time);
        let divergence: [f64; M] = core::array::from_fn(|k| (0..3).map(|j| gradient[3 * k + j][j]).sum());
        inside.add(&divergence, point.weight, &point.position)
    })?;
    let mut through = RunningIntegral::new();
    region.surface_points(quadrature, |point| {
        let g = field.at(&lift(&point.position), time);
        let across: [f64; M] = core::array::from_fn(|k| (0..3).map(|j| g[3 * k + j] * point.normal[j]).sum());
        through.add(&across, point.weight, &point.position)
    })?;
    Ok((inside.value(), through.value()))
}
