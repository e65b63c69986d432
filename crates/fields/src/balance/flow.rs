//! Balances at places, in any orthogonal coordinates.

use nalgebra::Vector3;
use piola_continuum::CauchyStress;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;

use super::{checked, checked_vector, momentum};
use crate::FieldsError;
use crate::coordinates::{Coordinates, divergence_of, gradient_of};
use crate::error::check_finite;
use crate::field::{Field, check_point, finite, local_rate, value_and_partials};
use crate::residual::{Residual, VectorResidual};
use crate::value::TensorValue;

/// A body in motion as fields in space: density and velocity as functions of coordinates q and time, in physical
/// components.
///
/// | symbol | field | unit |
/// |---|---|---|
/// | q | of `coordinates`: [`Cartesian`](crate::Cartesian), [`Cylindrical`](crate::Cylindrical), [`Spherical`](crate::Spherical) or any orthogonal system | m, rad |
/// | ρ | `density` | kg/m³ |
/// | v | `velocity` | m/s |
///
/// # Errors
/// All methods: as [`Coordinates`](Coordinates#errors).
///
/// # Example
/// Water in a turning bucket: p = ½ρω²r² − ρgz balances the centripetal acceleration.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::{CauchyStress, Symmetric};
/// use piola_fields::{Cylindrical, Field, Flow, Uniform};
/// use piola_numerics::Real;
/// struct Turn;
/// impl Field for Turn {
///     type Value = Vector3<f64>;
///     fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> Vector3<T> {
///         Vector3::new(T::lit(0.0), T::lit(2.0) * q[0], T::lit(0.0))
///     }
/// }
/// struct Pressure;
/// impl Field for Pressure {
///     type Value = CauchyStress;
///     fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> CauchyStress<T> {
///         let pressure = T::lit(2000.0) * q[0] * q[0] - T::lit(9810.0) * q[2];
///         CauchyStress(Symmetric::diagonal([-pressure; 3]))
///     }
/// }
/// let bucket = Flow { coordinates: Cylindrical, density: Uniform(1000.0), velocity: Turn };
/// let (gravity, point) = (Uniform(Vector3::new(0.0, 0.0, -9.81)), Vector3::new(0.25, 0.0, 0.5));
/// assert_eq!(bucket.acceleration(&point, 0.0)?.x, -1.0); // −ω² r
/// assert_eq!(bucket.continuity_residual(&point, 0.0)?.value, 0.0);
/// let residual = bucket.momentum_residual(&Pressure, &gravity, &point, 0.0)?;
/// assert!(residual.relative() < 1e-15);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Flow<C, R, V> {
    /// The system of coordinates.
    pub coordinates: C,
    /// ρ(q, t).
    pub density: R,
    /// v(q, t).
    pub velocity: V,
}

impl<C: Coordinates, R: Field<Value = f64>, V: Field<Value = Vector3<f64>>> Flow<C, R, V> {
    /// a = ∂v/∂t + (grad v) v, m/s², W(14.18).
    ///
    /// # Errors
    /// See [the type](Flow#errors).
    pub fn acceleration<T: Real>(&self, coordinates: &Vector3<T>, t: T) -> Result<Vector3<T>, FieldsError> {
        let terms = self.acceleration_terms(coordinates, t)?;
        finite::<Vector3<f64>, T>("acceleration", terms.map(|a| a.value).into())
    }

    /// ρ̇ + ρ div v = ∂ρ/∂t + (grad ρ)·v + ρ div v, kg/(m³ s), W(17.5), B(4.43).
    ///
    /// # Errors
    /// See [the type](Flow#errors).
    pub fn continuity_residual<T: Real>(&self, coordinates: &Vector3<T>, t: T) -> Result<Residual<T>, FieldsError> {
        let (v, gradient) = gradient_of(&self.coordinates, &self.velocity, coordinates, t)?;
        let density = self.density.at(coordinates, t);
        let residual = self.material_rate(&self.density, &v, coordinates, t)?;
        let diagonal = [0, 1, 2].map(|i: usize| gradient[i][i]);
        let residual = diagonal.into_iter().fold(residual, |residual, slope| residual.plus(density * slope));
        checked("continuity", residual)
    }

    /// div T + ρb − ρa, N/m³, W(17.12), W(23.56), W(25.10).
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | T(q, t) | `stress` | Pa |
    /// | b(q, t) | `body_force`, per mass | m/s² |
    ///
    /// # Errors
    /// See [the type](Flow#errors).
    pub fn momentum_residual<T: Real>(
        &self,
        stress: &impl Field<Value = CauchyStress>,
        body_force: &impl Field<Value = Vector3<f64>>,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, FieldsError> {
        let divergence = divergence_of(&self.coordinates, stress, coordinates, t)?;
        let acceleration = self.acceleration_terms(coordinates, t)?;
        let density = self.density.at(coordinates, t);
        let force = body_force.at(coordinates, t);
        momentum(divergence, density, &force, acceleration)
    }

    /// ρε̇ − tr(T L), W/m³: the balance of energy of a body that neither conducts nor receives heat, W(20.8).
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | ε(q, t) | `internal_energy`, per mass | J/kg |
    /// | T(q, t) | `stress` | Pa |
    ///
    /// # Errors
    /// See [the type](Flow#errors).
    pub fn energy_residual<T: Real>(
        &self,
        internal_energy: &impl Field<Value = f64>,
        stress: &impl Field<Value = CauchyStress>,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<Residual<T>, FieldsError> {
        let (v, gradient) = gradient_of(&self.coordinates, &self.velocity, coordinates, t)?;
        let density = self.density.at(coordinates, t);
        let rate = self.material_rate(internal_energy, &v, coordinates, t)?;
        let stress = stress.at(coordinates, t).rows();
        let mut residual = Residual::zero().plus_all(rate, density);
        for (row, slopes) in stress.iter().zip(&gradient) {
            for (component, slope) in row.iter().zip(slopes) {
                residual = residual.plus(-(*component * *slope));
            }
        }
        checked("energy", residual)
    }

    /// ρε̇ − tr(T L) + div q − r, W/m³: the balance of energy with heat, W(20.4).
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | q(q, t) | `heat_flux`, outwards positive | W/m² |
    /// | r(q, t) | `heat_supply`, per volume | W/m³ |
    ///
    /// # Errors
    /// See [the type](Flow#errors).
    pub fn heated_energy_residual<T: Real>(
        &self,
        internal_energy: &impl Field<Value = f64>,
        stress: &impl Field<Value = CauchyStress>,
        heat_flux: &impl Field<Value = Vector3<f64>>,
        heat_supply: &impl Field<Value = f64>,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<Residual<T>, FieldsError> {
        let mechanical = self.energy_residual(internal_energy, stress, coordinates, t)?;
        let flux = gradient_of(&self.coordinates, heat_flux, coordinates, t)?.1;
        let supply = heat_supply.at(coordinates, t);
        checked("energy", mechanical.plus(flux[0][0]).plus(flux[1][1]).plus(flux[2][2]).plus(-supply))
    }

    /// Terms of ∂v/∂t + (grad v) v.
    fn acceleration_terms<T: Real>(&self, coordinates: &Vector3<T>, t: T) -> Result<[Residual<T>; 3], FieldsError> {
        let (v, gradient) = gradient_of(&self.coordinates, &self.velocity, coordinates, t)?;
        let local = local_rate(&self.velocity, coordinates, t);
        Ok([0, 1, 2].map(|i: usize| {
            let row = &gradient[i];
            Residual::zero().plus(local[i]).plus(row[0] * v[0]).plus(row[1] * v[1]).plus(row[2] * v[2])
        }))
    }

    /// Terms of Ψ̇ = ∂Ψ/∂t + (grad Ψ)·v of a scalar.
    fn material_rate<T: Real>(
        &self,
        scalar: &impl Field<Value = f64>,
        v: &Vector3<T>,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<Residual<T>, FieldsError> {
        let partials = value_and_partials(scalar, coordinates, t).1;
        let h = self.coordinates.scale_factors(coordinates)?;
        let local = Residual::zero().plus(local_rate(scalar, coordinates, t));
        Ok((0..3).fold(local, |rate, i| rate.plus(partials[i] / h[i] * v[i])))
    }
}

/// div T + f at rest, N/m³: W(17.12) without acceleration; with a first Piola–Kirchhoff stress in Cartesian
/// coordinates of the reference configuration, Div P + f, B(4.59).
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | T(q, t) | `stress`, any tensor, physical components | Pa |
/// | f(q, t) | `force_per_volume` | N/m³ |
/// | t | `t`, a parameter | s |
///
/// # Errors
/// As [`Coordinates`](Coordinates#errors).
///
/// # Example
/// Lamé's tube: `T_rr` = a − b/r², `T_θθ` = a + b/r² is in equilibrium without force.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::{CauchyStress, Symmetric};
/// use piola_fields::{Cylindrical, Field, Uniform, equilibrium_residual};
/// use piola_numerics::Real;
/// struct Tube;
/// impl Field for Tube {
///     type Value = CauchyStress;
///     fn at<T: Real>(&self, q: &Vector3<T>, _time: T) -> CauchyStress<T> {
///         let (a, b) = (T::lit(3.0), T::lit(4.0) / (q[0] * q[0]));
///         CauchyStress(Symmetric::diagonal([a - b, a + b, T::lit(0.0)]))
///     }
/// }
/// let point = Vector3::new(2.0, 0.0, 0.0);
/// let residual = equilibrium_residual(&Cylindrical, &Tube, &Uniform(Vector3::zeros()), &point, 0.0)?;
/// assert_eq!(residual.value, Vector3::zeros());
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
pub fn equilibrium_residual<T: Real>(
    coordinates: &impl Coordinates,
    stress: &impl Field<Value: TensorValue>,
    force_per_volume: &impl Field<Value = Vector3<f64>>,
    point: &Vector3<T>,
    t: T,
) -> Result<VectorResidual<T>, FieldsError> {
    check_point(point, t)?;
    let divergence = divergence_of(coordinates, stress, point, t)?;
    let force = force_per_volume.at(point, t);
    check_finite("force", force.as_slice())?;
    checked_vector("equilibrium", [0, 1, 2].map(|i: usize| divergence[i].plus(force[i])))
}

/// a·b as a sum of terms.
#[inline]
pub(super) fn dot_terms<T: Real>(a: [T; 3], b: [T; 3]) -> Residual<T> {
    Residual { value: dot(a, b), scale: dot(a.map(T::abs), b.map(T::abs)) }
}
