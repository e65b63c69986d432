//! The equation of Navier and Stokes, and the stress of a viscous fluid as a field.

use nalgebra::Vector3;
use piola_continuum::CauchyStress;
use piola_continuum::rates::VelocityGradient;
use piola_fields::{Coordinates, Field, FieldsError, Flow, Residual, ValueOf, VectorResidual};
use piola_numerics::{Gradient, Real};

use crate::{FluidsError, LinearViscous, ViscousFluid};

/// T = −p 1 + V(grad v) of a flow, as a field in any orthogonal coordinates: what [`Flow::momentum_residual`] takes.
///
/// | field | is | unit |
/// |---|---|---|
/// | `velocity` | v, physical components | m/s |
/// | `pressure` | p | Pa |
///
/// Where the coordinates have no basis the stress is NaN, which the residual names.
///
/// # Example
/// Poiseuille's flow in a pipe, v = c (R² − r²)/(4 μ) along z, p = −c z, is in equilibrium:
/// ```
/// use nalgebra::Vector3;
/// use piola_fluids::{LinearViscous, ViscousStress};
/// use piola_fields::{Cylindrical, Field, Flow, Uniform};
/// use piola_numerics::Real;
/// struct Velocity;
/// impl Field for Velocity {
///     type Value = Vector3<f64>;
///     fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> Vector3<T> {
///         Vector3::new(T::zero(), T::zero(), T::lit(3.0) * (T::one() - q[0] * q[0]) / T::lit(4.0 * 0.5))
///     }
/// }
/// struct Pressure;
/// impl Field for Pressure {
///     type Value = f64;
///     fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> T {
///         T::lit(-3.0) * q[2]
///     }
/// }
/// let stress = ViscousStress { fluid: LinearViscous::new(0.25, 0.5)?, coordinates: Cylindrical, velocity: Velocity, pressure: Pressure };
/// let flow = Flow { coordinates: Cylindrical, density: Uniform(1000.0), velocity: Velocity };
/// let residual = flow.momentum_residual(&stress, &Uniform(Vector3::zeros()), &Vector3::new(0.5, 0.0, 0.25), 0.0)?;
/// assert!(residual.relative() < 1e-15);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// B(4.82–4.83), W(23.56).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscousStress<F, C, V, P> {
    /// The fluid.
    pub fluid: F,
    /// The coordinates.
    pub coordinates: C,
    /// v.
    pub velocity: V,
    /// p.
    pub pressure: P,
}

impl<F, C, V, P> Field for ViscousStress<F, C, V, P>
where
    F: ViscousFluid,
    C: Coordinates,
    V: Field<Value = Vector3<f64>>,
    P: Field<Value = f64>,
{
    type Value = CauchyStress;

    fn at<T: Real>(&self, place: &Vector3<T>, t: T) -> CauchyStress<T> {
        let gradient = self.coordinates.vector_gradient(&self.velocity, place, t);
        let l = gradient
            .map_or_else(|_| VelocityGradient(nalgebra::Matrix3::from_element(T::lit(f64::NAN))), VelocityGradient);
        self.fluid.cauchy(self.pressure.at(place, t), &l)
    }
}

/// ρ v̇ − f + ∇p − μ Δv − (λ + μ) ∇(∇·v), N/m³, of a flow in Cartesian coordinates.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | ρ, v | `flow` | kg/m³, m/s |
/// | p | `pressure` | Pa |
/// | f | `force_per_volume` | N/m³ |
///
/// With derivatives of v to the second order in place, exact. It equals −[`Flow::momentum_residual`] of [`ViscousStress`].
///
/// # Errors
/// [`FluidsError::Fields`]: the place, the time, or a term.
///
/// # Accuracy
/// A few ulp of the scale of the residual.
///
/// # Example
/// See [`ViscousStress`].
///
/// # Source
/// B(4.84).
pub fn navier_stokes_residual<C, R, V, T>(
    fluid: &LinearViscous,
    flow: &Flow<C, R, V>,
    pressure: &impl Field<Value = f64>,
    force_per_volume: &impl Field<Value = Vector3<f64>>,
    place: &Vector3<T>,
    t: T,
) -> Result<VectorResidual<T>, FluidsError>
where
    C: CartesianCoordinates,
    R: Field<Value = f64>,
    V: Field<Value = Vector3<f64>>,
    T: Real,
{
    let acceleration = flow.acceleration(place, t)?;
    let density = flow.density.at(place, t);
    // Second derivatives: partials of partials.
    let q = Vector3::from_fn(|i, _| Gradient::<Gradient<T, 3>, 3> {
        value: Gradient::variable(place[i], i),
        partials: core::array::from_fn(|j| if i == j { Gradient::lit(1.0) } else { Gradient::lit(0.0) }),
    });
    let v: ValueOf<V, _> = flow.velocity.at(&q, Gradient::constant(Gradient::constant(t)));
    let slopes = pressure.at(&q.map(|x| x.value), Gradient::constant(t)).partials;
    let force = force_per_volume.at(place, t);
    let (mu, both) = (T::lit(fluid.shear_viscosity()), T::lit(fluid.second_viscosity() + fluid.shear_viscosity()));
    let residual = core::array::from_fn(|i| {
        let mut residual = Residual::zero().plus(density * acceleration[i]).plus(-force[i]).plus(slopes[i]);
        for j in 0..3 {
            residual = residual.plus(-(mu * v[i].partials[j].partials[j]));
            residual = residual.plus(-(both * v[j].partials[j].partials[i]));
        }
        residual
    });
    let residual = VectorResidual::from(residual);
    for (index, x) in residual.value.iter().enumerate() {
        if !piola_numerics::Mask::all(x.is_finite()) {
            let value = x.primal(0);
            return Err(FieldsError::NotFinite { quantity: "residual of momentum", index, value }.into());
        }
    }
    Ok(residual)
}

/// Coordinates whose gradients are plain derivatives.
pub trait CartesianCoordinates: Coordinates {}

impl CartesianCoordinates for piola_fields::Cartesian {}
