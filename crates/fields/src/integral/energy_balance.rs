//! Stored energy of hyperelastic bodies, and the balance of energy of a part of one.
//!
//! ```text
//! d/dt [½ ∫ ρ_κ ẋ·ẋ dV + ∫ W(F) dV] = ∫ ρ_κ b·ẋ dV + ∮ P N·ẋ dA,     P = ∂W/∂F            W(20.4)
//! ```

use nalgebra::{Matrix3, Vector3};
use piola_continuum::FirstPiola;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_numerics::{Dual, Gradient, Real};

use super::region::lift;
use super::{ForceResultants, Quadrature, Region, Resultants};
use crate::FieldsError;
use crate::integrand::RunningIntegral;
use crate::motion::kernels::gradient;
use crate::{Body, Field, Material, Motion, Residual};

/// Stored energy of a hyperelastic body, stated once over any scalar.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::integral::StoredEnergy;
/// use piola_numerics::Real;
/// /// ½ |F − 1|², Pa.
/// struct Springs;
/// impl StoredEnergy for Springs {
///     fn density<T: Real>(&self, _: &Vector3<f64>, gradient: &Matrix3<T>) -> T {
///         let one = |i: usize| if i % 4 == 0 { T::lit(1.0) } else { T::lit(0.0) };
///         let squares = gradient.iter().enumerate().map(|(i, &f)| (f - one(i)) * (f - one(i)));
///         squares.fold(T::lit(0.0), |sum, square| sum + square) * T::lit(0.5)
///     }
/// }
/// let stress = Springs.stress(&Vector3::zeros(), &Matrix3::from_diagonal_element(3.0));
/// assert_eq!(stress.matrix()[(1, 1)], 2.0); // P = ∂W/∂F = F − 1
/// ```
pub trait StoredEnergy {
    /// W(X, F), J per reference m³.
    fn density<T: Real>(&self, reference: &Vector3<f64>, gradient: &Matrix3<T>) -> T;

    /// P = ∂W/∂F, W(20.13), by exact derivatives.
    fn stress<T: Real>(&self, reference: &Vector3<f64>, gradient: &Matrix3<T>) -> FirstPiola<T> {
        let rows = rows_of(gradient);
        let variable = |i: usize, j: usize| Gradient::<T, 9>::variable(rows[i][j], 3 * i + j);
        let energy = self.density(reference, &Matrix3::from_fn(variable));
        FirstPiola::trusted(core::array::from_fn(|i| core::array::from_fn(|j| energy.partials[3 * i + j])))
    }
}

/// ∫ W(F) dV, the strain energy of a body in motion, J.
///
/// With a time that is a dual variable it carries its rate.
///
/// # Errors
/// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
///
/// # Example
/// See [`EnergyBalance`].
///
/// # Source
/// B(4.61).
pub fn strain_energy<T: Real>(
    quadrature: &Quadrature,
    region: &impl Region<f64>,
    motion: &impl Motion,
    energy: &impl StoredEnergy,
    t: T,
) -> Result<T, FieldsError> {
    let mut integral = RunningIntegral::new();
    region.volume_points(quadrature, |point| {
        let particle = lift(&point.position);
        let deformation = motion.deformation_gradient(&particle, t)?;
        let density = energy.density(&point.position, deformation.matrix());
        integral.add(&[density], T::lit(point.weight), &particle)
    })?;
    let [total] = integral.value()?;
    Ok(total)
}

/// The terms of the balance of energy of a hyperelastic body, P = ∂W/∂F.
///
/// ```text
/// d/dt [½ ∫ ρ_κ ẋ·ẋ dV + ∫ W(F) dV] = ∫ ρ_κ b·ẋ dV + ∮ P N·ẋ dA
/// ```
///
/// # Example
/// A body that is stretched by its boundary without inertia to speak of, W = ½ |F − 1|².
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::integral::{Cuboid, EnergyBalance, Quadrature, StoredEnergy};
/// use piola_fields::{Body, Material, Motion, Uniform};
/// use piola_numerics::Real;
/// struct Springs;
/// impl StoredEnergy for Springs {
///     fn density<T: Real>(&self, _: &Vector3<f64>, gradient: &Matrix3<T>) -> T {
///         let one = |i: usize| if i % 4 == 0 { T::lit(1.0) } else { T::lit(0.0) };
///         let squares = gradient.iter().enumerate().map(|(i, &f)| (f - one(i)) * (f - one(i)));
///         squares.fold(T::lit(0.0), |sum, square| sum + square) * T::lit(0.5)
///     }
/// }
/// struct Pull;
/// impl Motion for Pull {
///     fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
///         Vector3::new(reference.x * (T::lit(1.0) + t), reference.y, reference.z)
///     }
/// }
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let body = Body { motion: Pull, reference_density: Uniform(1.0) };
/// let none = Material(Uniform(Vector3::zeros()));
/// let terms = EnergyBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &Springs, &none, 3.0)?;
/// assert!((terms.stored.value - 4.5).abs() < 1e-14 && (terms.stored.tangent - 3.0).abs() < 1e-14);
/// assert!((terms.surface_power - 3.0).abs() < 1e-14 && terms.residual().relative() < 1e-15);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// W(20.4).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnergyBalance {
    /// Kinetic energy K and K̇, J, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub kinetic: Dual<f64>,
    /// Stored energy ∫ W dV and its rate, J, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub stored: Dual<f64>,
    /// Of body forces, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub body_power: f64,
    /// Of tractions, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub surface_power: f64,
}

impl EnergyBalance {
    /// The terms for the part `region`.
    ///
    /// # Errors
    /// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
    pub fn of(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        energy: &impl StoredEnergy,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        t: f64,
    ) -> Result<Self, FieldsError> {
        let (motion, pole, now) = (&body.motion, Vector3::zeros(), Dual::variable(t));
        let stress = |particle: &Vector3<f64>| energy.stress(particle, &from_rows(gradient(motion, particle, t)));
        let forces = ForceResultants::of_body_force(quadrature, region, body, body_force, &pole, t)?;
        let tractions = ForceResultants::of_stress_on_boundary(quadrature, region, motion, stress, &pole, t)?;
        Ok(Self {
            kinetic: Resultants::in_reference(quadrature, region, body, &pole, now)?.kinetic_energy,
            stored: strain_energy(quadrature, region, motion, energy, now)?,
            body_power: forces.power,
            surface_power: tractions.power,
        })
    }

    /// d/dt (K + ∫ W dV) − power of body forces and tractions, W.
    #[must_use]
    pub fn residual(&self) -> Residual {
        let rates = Residual::zero().plus(self.kinetic.tangent).plus(self.stored.tangent);
        rates.plus(-self.body_power).plus(-self.surface_power)
    }
}
