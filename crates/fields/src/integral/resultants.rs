//! Mass, momentum, angular momentum and energy of a body; forces and moments on it.

use nalgebra::Vector3;
use piola_continuum::FirstPiola;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{cross, dot};
use piola_tensor::internal::rows::apply;

use super::region::lift;
use super::{Quadrature, Region};
use crate::FieldsError;
use crate::integrand::RunningIntegral;
use crate::motion::kernels::velocity;
use crate::{Body, Field, Material, Motion, Spatial};

/// Mass, momentum, angular momentum and kinetic energy of a body.
///
/// ```text
/// m = ∫ ρ dv = ∫ ρ_κ dV                      p = ∫ ρ v dv = ∫ ρ_κ ẋ dV            c = ∫ ρ x dv / m
/// h = ∫ ρ (x − o) × v dv = ∫ ρ_κ (x − o) × ẋ dV                  K = ½ ∫ ρ v·v dv = ½ ∫ ρ_κ ẋ·ẋ dV
/// ```
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Ball, Quadrature, Resultants};
/// use piola_fields::{Body, Rigid, RigidHistory, Uniform};
/// use piola_numerics::Real;
/// struct Spin; // one radian a second about the third axis
/// impl RigidHistory for Spin {
///     fn attitude<T: Real>(&self, t: T) -> [T; 4] {
///         let (s, c) = (T::lit(0.5) * t).sin_cos();
///         [c, T::lit(0.0), T::lit(0.0), s]
///     }
/// }
/// let ball = Ball::new(Vector3::zeros(), 1.0)?;
/// let one_kilogram = Uniform(3.0 / (4.0 * core::f64::consts::PI));
/// let body = Body { motion: Rigid(Spin), reference_density: one_kilogram };
/// let of = Resultants::in_reference(&Quadrature::of_degree(2)?, &ball, &body, &Vector3::zeros(), 0.5)?;
/// assert!((of.angular_momentum.z - 0.4).abs() < 1e-15); // 2/5 m R² ω
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// W(15.8), W(15.12–15.13).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: crate::integrand::Integrand<Scalar = T> + Real + serde::Deserialize<'de>"
    ))
)]
pub struct Resultants<T = f64> {
    /// m, kg.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub mass: T,
    /// ∫ ρ (x − o) dv about the pole o, kg m.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub first_moment: Vector3<T>,
    /// p, kg m/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub momentum: Vector3<T>,
    /// h about the pole o, kg m²/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub angular_momentum: Vector3<T>,
    /// K, J.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub kinetic_energy: T,
}

impl<T: Real> Resultants<T> {
    /// Of a body in motion, by integrals over the reference configuration.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | 𝒫 | `region` in the reference configuration | | |
    /// | x(X, t), `ρ_κ(X)` | `body` | | m, kg/m³ |
    /// | o | `pole` | 3 | m |
    ///
    /// With a time that is a dual variable, the results carry their rates, exact to rounding.
    ///
    /// # Errors
    /// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
    pub fn in_reference(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        pole: &Vector3<f64>,
        t: T,
    ) -> Result<Self, FieldsError> {
        let mut integral = RunningIntegral::new();
        region.volume_points(quadrature, |point| {
            let particle = lift(&point.position);
            let place = body.motion.position(&particle, t)?;
            let density = body.reference_density.at(&particle, t);
            let of_particle = densities(density, place - lift(pole), velocity(&body.motion, &particle, t));
            integral.add(&of_particle, T::lit(point.weight), &particle)
        })?;
        Ok(Self::from_array(&integral.value()?))
    }

    /// Of what is in a region of space at a time, from density and velocity as fields in space.
    ///
    /// The region of a body in motion is a [`MovedRegion`](super::MovedRegion).
    ///
    /// # Errors
    /// [`FieldsError::IntegrandNotFinite`]; what the region refuses.
    pub fn in_space(
        quadrature: &Quadrature,
        region: &impl Region<T>,
        density: &Spatial<impl Field<Value = f64>>,
        velocity: &Spatial<impl Field<Value = Vector3<f64>>>,
        pole: &Vector3<f64>,
        t: T,
    ) -> Result<Self, FieldsError> {
        let mut integral = RunningIntegral::new();
        region.volume_points(quadrature, |point| {
            let place = point.position;
            let of_place = densities(density.0.at(&place, t), place - lift(pole), velocity.0.at(&place, t));
            integral.add(&of_place, point.weight, &place)
        })?;
        Ok(Self::from_array(&integral.value()?))
    }

    /// c, m, for the pole that the resultants were taken about.
    #[must_use]
    pub fn centre_of_mass(&self, pole: &Vector3<f64>) -> Vector3<T> {
        let mass = self.mass;
        lift(pole) + self.first_moment.map(|moment| moment / mass)
    }

    fn from_array(a: &[T; 11]) -> Self {
        Self {
            mass: a[0],
            first_moment: Vector3::new(a[1], a[2], a[3]),
            momentum: Vector3::new(a[4], a[5], a[6]),
            angular_momentum: Vector3::new(a[7], a[8], a[9]),
            kinetic_energy: a[10],
        }
    }
}

/// ρ, ρ r, ρ v, ρ r × v, ½ ρ v·v.
fn densities<T: Real>(density: T, arm: Vector3<T>, velocity: Vector3<T>) -> [T; 11] {
    let (r, v): ([T; 3], [T; 3]) = (arm.into(), velocity.into());
    let p = v.map(|v| density * v);
    let h = cross(r, p);
    let s = r.map(|r| density * r);
    let energy = T::lit(0.5) * dot(p, v);
    [density, s[0], s[1], s[2], p[0], p[1], p[2], h[0], h[1], h[2], energy]
}

/// The force and moment that act on a body and the power they expend.
///
/// ```text
/// f = ∫ ρ_κ b dV + ∮ P N dA,     m = ∫ ρ_κ (x − o) × b dV + ∮ (x − o) × P N dA,     power = ∫ ρ_κ b·ẋ dV + ∮ P N·ẋ dA
/// ```
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::DeformationGradient;
/// use piola_fields::integral::{Cuboid, ForceResultants, Quadrature};
/// use piola_fields::{Affine, Body, Material, Uniform};
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let rest = Affine::new(DeformationGradient::identity(), Vector3::zeros())?;
/// let (body, weight) = (Body { motion: rest, reference_density: Uniform(2.0) }, Vector3::new(0.0, 0.0, -10.0));
/// let (rules, pole) = (Quadrature::of_degree(2)?, Vector3::zeros());
/// let of = ForceResultants::of_body_force(&rules, &unit, &body, &Material(Uniform(weight)), &pole, 0.0)?;
/// assert!((of.force.z + 20.0).abs() < 1e-13 && (of.moment.y - 10.0).abs() < 1e-13); // −(½ m · −20 N)
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// W(15.16), W(15.18), W(21.4).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForceResultants {
    /// f, N.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub force: Vector3<f64>,
    /// m about the pole o, N m.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub moment: Vector3<f64>,
    /// The power, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub power: f64,
}

impl ForceResultants {
    /// Of body forces b(X, t) per unit mass.
    ///
    /// # Errors
    /// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
    pub fn of_body_force(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        pole: &Vector3<f64>,
        t: f64,
    ) -> Result<Self, FieldsError> {
        let mut integral = RunningIntegral::new();
        region.volume_points(quadrature, |point| {
            let particle = &point.position;
            let force = body_force.0.at(particle, t) * body.reference_density.at(particle, t);
            integral.add(&acting(&force, &body.motion, particle, pole, t)?, point.weight, particle)
        })?;
        Ok(Self::from_array(&integral.value()?))
    }

    /// Of the tractions P N of a stress P(X, t) on the boundary.
    ///
    /// # Errors
    /// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
    pub fn of_tractions(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        motion: &impl Motion,
        stress: &Material<impl Field<Value = FirstPiola>>,
        pole: &Vector3<f64>,
        t: f64,
    ) -> Result<Self, FieldsError> {
        Self::of_stress_on_boundary(quadrature, region, motion, |particle| stress.0.at(particle, t), pole, t)
    }

    /// As [`of_tractions`](Self::of_tractions), of any function of the particle.
    pub(super) fn of_stress_on_boundary(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        motion: &impl Motion,
        stress: impl Fn(&Vector3<f64>) -> FirstPiola,
        pole: &Vector3<f64>,
        t: f64,
    ) -> Result<Self, FieldsError> {
        let mut integral = RunningIntegral::new();
        region.surface_points(quadrature, |point| {
            let particle = &point.position;
            let traction = Vector3::from(apply(stress(particle).rows(), point.normal.into()));
            integral.add(&acting(&traction, motion, particle, pole, t)?, point.weight, particle)
        })?;
        Ok(Self::from_array(&integral.value()?))
    }

    fn from_array(a: &[f64; 7]) -> Self {
        Self { force: Vector3::new(a[0], a[1], a[2]), moment: Vector3::new(a[3], a[4], a[5]), power: a[6] }
    }
}

/// f, (x − o) × f, f·ẋ.
fn acting(
    force: &Vector3<f64>,
    motion: &impl Motion,
    particle: &Vector3<f64>,
    pole: &Vector3<f64>,
    t: f64,
) -> Result<[f64; 7], FieldsError> {
    let moment = (motion.position(particle, t)? - pole).cross(force);
    let power = velocity(motion, particle, t).dot(force);
    Ok([force.x, force.y, force.z, moment.x, moment.y, moment.z, power])
}
