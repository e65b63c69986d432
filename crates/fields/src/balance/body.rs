//! Balances at particles, from the motion.

use nalgebra::Vector3;
use piola_continuum::internal::check_jacobian;
use piola_continuum::{CauchyStress, FirstPiola};
use piola_numerics::linear::matrix3::{determinant, inverse_and_determinant};
use piola_numerics::{Dual, Gradient, Real};
use piola_tensor::internal::rows::Rows;

use super::flow::dot_terms;
use super::identities::{divergence, two_point_symmetry};
use super::{checked, checked_vector, momentum};
use crate::FieldsError;
use crate::error::check_finite;
use crate::field::{Field, along, local_rate};
use crate::frames::{Material, Spatial};
use crate::motion::{Motion, check_event, kernels};
use crate::residual::{Residual, VectorResidual};

/// A body as a motion x(X, t) with the density `ρ_κ(X)` of its reference configuration. Cartesian components.
///
/// Fields of particles are [`Material`], fields of places [`Spatial`]: they cannot be exchanged by accident.
///
/// # Errors
/// All methods: what the motion refuses; [`FieldsError::NotFinite`] for a particle, time or result;
/// [`ContinuumError::NonPositiveJacobian`](piola_continuum::ContinuumError::NonPositiveJacobian) where J is divided by.
///
/// # Example
/// A gas that expands freely, x = (1 + t) X: its density falls as (1 + t)⁻³.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::{AffineHistory, Body, Field, Homogeneous, Spatial, Uniform};
/// use piola_numerics::Real;
/// struct Expansion;
/// impl AffineHistory for Expansion {
///     fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
///         Matrix3::from_diagonal(&Vector3::repeat(T::lit(1.0) + t))
///     }
/// }
/// struct Density;
/// impl Field for Density {
///     type Value = f64;
///     fn at<T: Real>(&self, _place: &Vector3<T>, t: T) -> T {
///         T::lit(8.0) / (T::lit(1.0) + t).powi(3)
///     }
/// }
/// let gas = Body { motion: Homogeneous(Expansion), reference_density: Uniform(8.0) };
/// let particle = Vector3::new(1.0, 0.0, 0.0);
/// assert_eq!(gas.density(&particle, 1.0)?, 1.0);
/// assert_eq!(gas.continuity_residual(&Spatial(Density), &particle, 1.0)?.value, 0.0);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Body<M, R> {
    /// x(X, t).
    pub motion: M,
    /// `ρ_κ(X)`, kg/m³ of the reference configuration.
    pub reference_density: R,
}

impl<M: Motion, R: Field<Value = f64>> Body<M, R> {
    /// `ρ = ρ_κ/det F`, kg/m³, W(17.7), B(4.40).
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn density<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<T, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let jacobian = determinant(kernels::gradient(&self.motion, reference, t));
        check_jacobian(jacobian)?;
        let density = self.reference_density.at(reference, t) / jacobian;
        check_finite("density", &[density])?;
        Ok(density)
    }

    /// ρ det F − `ρ_κ`, kg/m³, W(17.7), B(4.40), of a density given in space.
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn density_residual<T: Real>(
        &self,
        density: &Spatial<impl Field<Value = f64>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<Residual<T>, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let (place, gradient) = kernels::place_and_gradient(&self.motion, reference, t);
        let now = density.0.at(&place, t) * determinant(gradient);
        checked("density", Residual::zero().plus(now).plus(-self.reference_density.at(reference, t)))
    }

    /// ρ̇ + ρ div v, kg/(m³ s), W(17.5), B(4.43), of a density given in space, with ρ̇ = ∂ρ/∂t + (grad ρ)·v and
    /// div v = tr(Ḟ F⁻¹).
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn continuity_residual<T: Real>(
        &self,
        density: &Spatial<impl Field<Value = f64>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<Residual<T>, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let (gradient, rate) = kernels::gradient_and_rate(&self.motion, reference, t);
        check_jacobian(determinant(gradient))?;
        let inverse = inverse_and_determinant(gradient).0;
        let x = self.motion.place(&reference.map(Dual::constant), Dual::variable(t));
        let (place, velocity) = (x.map(|x| x.value), x.map(|x| x.tangent));
        let (value, material_rate) = along(&density.0, &place, &velocity, t);
        let mut residual = Residual::zero().plus(material_rate);
        for i in 0..3 {
            let slope = dot_terms(rate[i], [inverse[0][i], inverse[1][i], inverse[2][i]]);
            residual = residual.plus_all(slope, value);
        }
        checked("continuity", residual)
    }

    /// Div P + `ρ_κ` b − `ρ_κ` a, N/m³ of the reference configuration, W(17.29), B(4.54).
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | P(X, t) | `stress` | Pa |
    /// | b(X, t) | `body_force`, per mass | m/s² |
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn momentum_residual<T: Real>(
        &self,
        stress: &Material<impl Field<Value = FirstPiola>>,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let divergence = referential_divergence(stress, reference, t);
        let density = self.reference_density.at(reference, t);
        let force = body_force.0.at(reference, t);
        let acceleration = single_terms(&kernels::acceleration(&self.motion, reference, t));
        momentum(divergence, density, &force, acceleration)
    }

    /// div T + ρb − ρa, N/m³, W(17.12), at the place of the particle, with `ρ = ρ_κ/det F`.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | T(x, t) | `stress` | Pa |
    /// | b(x, t) | `body_force`, per mass | m/s² |
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn spatial_momentum_residual<T: Real>(
        &self,
        stress: &Spatial<impl Field<Value = CauchyStress>>,
        body_force: &Spatial<impl Field<Value = Vector3<f64>>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, FieldsError> {
        let density = self.density(reference, t)?;
        let place = self.motion.place(reference, t);
        let tensor = stress.0.at(&kernels::variables(&place), Gradient::constant(t)).rows();
        let force = body_force.0.at(&place, t);
        let acceleration = single_terms(&kernels::acceleration(&self.motion, reference, t));
        let divergence = divergence(&tensor);
        momentum(divergence, density, &force, acceleration)
    }

    /// `ρ_κ` ü + c u̇ − f − Div P, N/m³ of the reference configuration: damped motion, B(4.58).
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | P(X, t) | `stress` | Pa |
    /// | f(X, t) | `force_per_volume`, of the reference configuration | N/m³ |
    /// | c(X, t) | `damping`, a field ([`Uniform`](crate::Uniform) when constant) | kg/(m³ s) |
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn damped_residual<T: Real>(
        &self,
        stress: &Material<impl Field<Value = FirstPiola>>,
        force_per_volume: &Material<impl Field<Value = Vector3<f64>>>,
        damping: &Material<impl Field<Value = f64>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let divergence = referential_divergence(stress, reference, t);
        let density = self.reference_density.at(reference, t);
        let (damping, force) = (damping.0.at(reference, t), force_per_volume.0.at(reference, t));
        let (velocity, acceleration) = kernels::velocity_and_acceleration(&self.motion, reference, t);
        let component = |i: usize| {
            let inertia = Residual::zero().plus(density * acceleration[i]).plus(damping * velocity[i]);
            inertia.plus(-force[i]).plus_all(divergence[i], -T::one())
        };
        checked_vector("damped momentum", [component(0), component(1), component(2)])
    }

    /// Div P + f, N/m³ of the reference configuration: statics, B(4.59).
    ///
    /// Only the domain of the motion is evaluated.
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn equilibrium_residual<T: Real>(
        &self,
        stress: &Material<impl Field<Value = FirstPiola>>,
        force_per_volume: &Material<impl Field<Value = Vector3<f64>>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let divergence = referential_divergence(stress, reference, t);
        let force = force_per_volume.0.at(reference, t);
        checked_vector("equilibrium", [0, 1, 2].map(|i: usize| divergence[i].plus(force[i])))
    }

    /// P Fᵀ − F Pᵀ as the vector of its entries 32, 13, 21, Pa, with its scale: zero by the balance of moment of
    /// momentum, W(17.35).
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn symmetry_residual<T: Real>(
        &self,
        stress: &Material<impl Field<Value = FirstPiola>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let gradient = kernels::gradient(&self.motion, reference, t);
        checked_vector("moment", two_point_symmetry(&stress.0.at(reference, t).rows(), &gradient))
    }

    /// `ρ_κ` ε̇ − P : Ḟ, W/m³ of the reference configuration: the balance of energy of a body that neither conducts
    /// nor receives heat, W(20.4), W(20.9).
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | ε(X, t) | `internal_energy`, per mass | J/kg |
    /// | P(X, t) | `stress` | Pa |
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn energy_residual<T: Real>(
        &self,
        internal_energy: &Material<impl Field<Value = f64>>,
        stress: &Material<impl Field<Value = FirstPiola>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<Residual<T>, FieldsError> {
        check_event(&self.motion, reference, t)?;
        let rate = kernels::gradient_and_rate(&self.motion, reference, t).1;
        let stress: Rows<T> = stress.0.at(reference, t).rows();
        let density = self.reference_density.at(reference, t);
        let stored = density * local_rate(&internal_energy.0, reference, t);
        let power = |i: usize| dot_terms(stress[i], rate[i]);
        let residual = (0..3).fold(Residual::zero().plus(stored), |sum, i| sum.plus_all(power(i), -T::one()));
        checked("energy", residual)
    }

    /// `ρ_κ` ε̇ − P : Ḟ + Div Q − R, W/m³ of the reference configuration: the balance of energy with heat, W(20.4).
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | Q(X, t) | `heat_flux`, J F⁻¹ q, per area of the reference configuration | W/m² |
    /// | R(X, t) | `heat_supply`, per volume of the reference configuration | W/m³ |
    ///
    /// # Errors
    /// See [the type](Body#errors).
    pub fn heated_energy_residual<T: Real>(
        &self,
        internal_energy: &Material<impl Field<Value = f64>>,
        stress: &Material<impl Field<Value = FirstPiola>>,
        heat_flux: &Material<impl Field<Value = Vector3<f64>>>,
        heat_supply: &Material<impl Field<Value = f64>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<Residual<T>, FieldsError> {
        let mechanical = self.energy_residual(internal_energy, stress, reference, t)?;
        let flux = heat_flux.0.at(&kernels::variables(reference), Gradient::constant(t));
        let residual = (0..3).fold(mechanical, |sum, a| sum.plus(flux[a].partials[a]));
        checked("energy", residual.plus(-heat_supply.0.at(reference, t)))
    }
}

/// Terms of Div P.
#[inline]
fn referential_divergence<T: Real>(
    stress: &Material<impl Field<Value = FirstPiola>>,
    reference: &Vector3<T>,
    t: T,
) -> [Residual<T>; 3] {
    divergence(&stress.0.at(&kernels::variables(reference), Gradient::constant(t)).rows())
}

/// A vector as sums of one term each.
#[cfg_attr(not(debug_assertions), inline(always))]
fn single_terms<T: Real>(vector: &Vector3<T>) -> [Residual<T>; 3] {
    [0, 1, 2].map(|i: usize| Residual::zero().plus(vector[i]))
}
