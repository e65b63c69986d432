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
use piola_continuum::Deformation;
use piola_numerics::{Dual, Gradient};

use super::region::{moved_element, placed};
use super::{MovedRegion, Quadrature, Region};
use crate::FieldsError;
use crate::integrand::FieldIntegral;
use crate::motion::kernels::{variables, velocity};
use crate::value::map;
use crate::{Body, Field, FieldValue, Motion, Spatial, TensorValue, ValueOf};

/// Both sides of the transport theorem for the part that a motion carries; V is the kind of value of the field.
///
/// # Example
/// The volume of a ball that swells: g = 1.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Ball, Quadrature, transport};
/// use piola_fields::{Motion, Spatial, Uniform};
/// use piola_numerics::Real;
/// struct Swelling;
/// impl Motion for Swelling {
///     fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
///         reference * (T::lit(1.0) + t)
///     }
/// }
/// let ball = Ball::new(Vector3::zeros(), 1.0)?;
/// let sides = transport(&Quadrature::of_degree(4)?, &ball, &Swelling, &Spatial(Uniform(1.0)), 0.0)?;
/// let area = 4.0 * core::f64::consts::PI;
/// assert!((sides.rate - area).abs() < 1e-14 && (sides.flux - area).abs() < 1e-14);
/// assert!(sides.residual.abs() < 1e-14 && sides.flux_residual.abs() < 1e-14);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// B(4.25), W(17.1–17.3).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Transport<V> {
    /// d/dt ∫ g dv, by differentiation of the integral.
    pub rate: V,
    /// ∫ ∂g/∂t dv.
    pub local: V,
    /// ∫ div(g v) dv = ∫ (grad g·v + g div v) dv.
    pub convected: V,
    /// ∮ g v·n da.
    pub flux: V,
    /// d/dt ∫ g dv − ∫ [∂g/∂t + div(g v)] dv.
    pub residual: V,
    /// d/dt ∫ g dv − ∫ ∂g/∂t dv − ∮ g v·n da.
    pub flux_residual: V,
}

/// Both sides of an identity, computed independently.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sides<V> {
    /// As it stands on the left.
    pub left: V,
    /// As it stands on the right.
    pub right: V,
}

/// The terms of the transport theorem for the part whose place in the reference configuration is `region`.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | g(x, t) | `field`: scalar, vector or tensor | that of g |
/// | x(X, t) | `motion` | m |
///
/// The motion need not be that of matter: with that of any moving boundary it is Reynolds' theorem.
///
/// # Errors
/// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
///
/// # Example
/// See [`Transport`].
///
/// # Source
/// B(4.25), W(17.1–17.3).
pub fn transport<F: Field, R: Region<f64> + Region<Dual<f64>>>(
    quadrature: &Quadrature,
    region: &R,
    motion: &impl Motion,
    field: &Spatial<F>,
    t: f64,
) -> Result<Transport<ValueOf<F, f64>>, FieldsError> {
    let moving = MovedRegion { region, motion, time: Dual::variable(t) };
    let mut total = FieldIntegral::<F::Value, Dual<f64>>::new();
    moving.volume_points(quadrature, |point| {
        total.add(&field.0.at(&point.position, moving.time), point.weight, &point.position)
    })?;
    let rate = map::<F::Value, _, _>(&total.value()?, |total: Dual<f64>| total.tangent);

    let (mut local, mut convected) = (FieldIntegral::<F::Value, f64>::new(), FieldIntegral::<F::Value, f64>::new());
    Region::<f64>::volume_points(region, quadrature, |point| {
        let particle = point.position;
        let (place, deformation) = placed(motion, &particle, t)?;
        let volume = point.weight * deformation.jacobian();
        let g = field.0.at(&place_variables(&place), Gradient::variable(t, 3));
        let v = velocity(motion, &particle, t);
        let divergence = motion.velocity_gradient(&particle, t)?.trace();
        let carried = |g: Gradient<f64, 4>| {
            let [x, y, z, _] = g.partials;
            x * v.x + y * v.y + z * v.z + g.value * divergence
        };
        local.add(&map::<F::Value, _, _>(&g, |g: Gradient<f64, 4>| g.partials[3]), volume, &place)?;
        convected.add(&map::<F::Value, _, _>(&g, carried), volume, &place)
    })?;
    let mut flux = FieldIntegral::<F::Value, f64>::new();
    Region::<f64>::surface_points(region, quadrature, |point| {
        let particle = point.position;
        let (place, deformation) = placed(motion, &particle, t)?;
        let (normal, ratio) = moved_element(deformation.gradient_rows(), &point.normal);
        let across = velocity(motion, &particle, t).dot(&normal);
        let through = map::<F::Value, _, _>(&field.0.at(&place, t), |g: f64| g * across);
        flux.add(&through, point.weight * ratio, &place)
    })?;
    let (local, convected, flux) = (local.value()?, convected.value()?, flux.value()?);
    let of = |value: &ValueOf<F, f64>, i: usize| F::Value::component::<f64>(value, i);
    let left_by =
        |other: &ValueOf<F, f64>| F::Value::from_components(|i| of(&rate, i) - (of(&local, i) + of(other, i)));
    let (residual, flux_residual) = (left_by(&convected), left_by(&flux));
    Ok(Transport { rate, local, convected, flux, residual, flux_residual })
}

/// Both sides of d/dt ∫ ρ Φ dv = ∫ ρ Φ̇ dv for a part of a body.
///
/// The left side integrates ρ Φ over the moving region, with ρ = `ρ_κ/J`, and differentiates; the right side
/// integrates `ρ_κ` (∂Φ/∂t + grad Φ·v) over the reference configuration.
///
/// # Errors
/// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
///
/// # Example
/// The height Φ of a body that rises at 2 m/s: the mass times that.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Cuboid, Quadrature, transport_of_mass};
/// use piola_fields::{Body, Field, Motion, Spatial, Uniform};
/// use piola_numerics::Real;
/// struct Rise;
/// impl Motion for Rise {
///     fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
///         reference + Vector3::new(T::lit(0.0), T::lit(0.0), T::lit(2.0) * t)
///     }
/// }
/// struct Height;
/// impl Field for Height {
///     type Value = f64;
///     fn at<T: Real>(&self, place: &Vector3<T>, _: T) -> T {
///         place.z
///     }
/// }
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let body = Body { motion: Rise, reference_density: Uniform(3.0) };
/// let sides = transport_of_mass(&Quadrature::of_degree(2)?, &unit, &body, &Spatial(Height), 1.0)?;
/// assert!((sides.left - 6.0).abs() < 1e-14 && (sides.right - 6.0).abs() < 1e-14);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// W(15.4).
pub fn transport_of_mass<F: Field, R: Region<f64> + Region<Dual<f64>>>(
    quadrature: &Quadrature,
    region: &R,
    body: &Body<impl Motion, impl Field<Value = f64>>,
    field: &Spatial<F>,
    t: f64,
) -> Result<Sides<ValueOf<F, f64>>, FieldsError> {
    let (motion, now) = (&body.motion, Dual::variable(t));
    let mut left = FieldIntegral::<F::Value, Dual<f64>>::new();
    Region::<Dual<f64>>::volume_points(region, quadrature, |point| {
        let particle = point.position;
        let (place, deformation) = placed(motion, &particle, now)?;
        let jacobian = deformation.jacobian();
        let density = body.reference_density.at(&particle, now) / jacobian;
        let weighted = map::<F::Value, _, _>(&field.0.at(&place, now), |phi: Dual<f64>| density * phi);
        left.add(&weighted, point.weight * jacobian, &place)
    })?;
    let mut right = FieldIntegral::<F::Value, f64>::new();
    Region::<f64>::volume_points(region, quadrature, |point| {
        let particle = point.position;
        let place = motion.position(&particle, t)?;
        let phi = field.0.at(&place_variables(&place), Gradient::variable(t, 3));
        let v = velocity(motion, &particle, t);
        let material = |phi: Gradient<f64, 4>| {
            let [x, y, z, rate] = phi.partials;
            rate + (x * v.x + y * v.y + z * v.z)
        };
        let density = body.reference_density.at(&particle, t);
        right.add(&map::<F::Value, _, _>(&phi, material), point.weight * density, &particle)
    })?;
    let left = map::<F::Value, _, _>(&left.value()?, |total: Dual<f64>| total.tangent);
    Ok(Sides { left, right: right.value()? })
}

/// The coordinates of a place as the first three of four variables.
fn place_variables(place: &Vector3<f64>) -> Vector3<Gradient<f64, 4>> {
    Vector3::from_fn(|i, _| Gradient::variable(place[i], i))
}

/// Both sides of the divergence theorem for a vector field, ∫ div g dv and ∮ g·n da.
///
/// # Errors
/// [`FieldsError::IntegrandNotFinite`]; what the region refuses.
pub fn divergence_theorem(
    quadrature: &Quadrature,
    region: &impl Region<f64>,
    field: &Spatial<impl Field<Value = Vector3<f64>>>,
    t: f64,
) -> Result<Sides<f64>, FieldsError> {
    let left = quadrature.volume_integral(region, |place: &Vector3<f64>| {
        let g = field.0.at(&variables(place), Gradient::constant(t));
        g.x.partials[0] + g.y.partials[1] + g.z.partials[2]
    })?;
    let right = quadrature.surface_integral(region, |point| field.0.at(&point.position, t).dot(&point.normal))?;
    Ok(Sides { left, right })
}

/// Both sides of the divergence theorem for a tensor field, ∫ div T dv and ∮ T n da; div contracts the last index.
///
/// With [`FirstPiola`](piola_continuum::FirstPiola) on a region of the reference configuration it is ∫ Div P dV = ∮ P N dA.
///
/// # Errors
/// [`FieldsError::IntegrandNotFinite`]; what the region refuses.
pub fn tensor_divergence_theorem<V: TensorValue>(
    quadrature: &Quadrature,
    region: &impl Region<f64>,
    field: &Spatial<impl Field<Value = V>>,
    t: f64,
) -> Result<Sides<Vector3<f64>>, FieldsError> {
    let left = quadrature.volume_integral(region, |place: &Vector3<f64>| {
        let rows = V::rows(&field.0.at(&variables(place), Gradient::constant(t)));
        Vector3::from_fn(|i, _| rows[i][0].partials[0] + rows[i][1].partials[1] + rows[i][2].partials[2])
    })?;
    let right = quadrature.surface_integral(region, |point| {
        Vector3::from(piola_tensor::internal::rows::apply(
            V::rows(&field.0.at(&point.position, t)),
            point.normal.into(),
        ))
    })?;
    Ok(Sides { left, right })
}
