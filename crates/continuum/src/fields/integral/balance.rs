//! The balances of mass, momentum, moment of momentum and energy of a part of a body, as integrals.
//!
//! ```text
//! d/dt ∫ ρ dv = 0
//! d/dt ∫ ρ_κ ẋ dV            = ∫ ρ_κ b dV + ∮ P N dA                              W(15.16)
//! d/dt ∫ ρ_κ (x − o) × ẋ dV  = ∫ ρ_κ (x − o) × b dV + ∮ (x − o) × P N dA          W(15.18)
//! d/dt ½ ∫ ρ_κ ẋ·ẋ dV + ∫ P : Ḟ dV  =  ∫ ρ_κ b·ẋ dV + ∮ P N·ẋ dA                 W(21.4)
//! d/dt [½ ∫ ρ_κ ẋ·ẋ dV + ∫ W(F) dV] =  the same power, when P = ∂W/∂F            W(20.4)
//! ```
//!
//! Rates are derivatives of the integrals with respect to time by dual numbers, not integrals of the
//! acceleration. The divergence of the stress is nowhere taken: what the balances state is independent of the
//! residuals at points.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_numerics::{Dual, Gradient, Real};

use super::integrand::RunningIntegral;
use super::region::lift;
use super::{Estimate, EstimatedQuadrature, ForceResultants, MovedRegion, Quadrature, Region, Resultants};
use crate::fields::motion::kernels::{gradient, gradient_and_rate};
use crate::fields::{Body, Field, Material, Motion, Residual, Spatial, VectorResidual};
use crate::tensor::rows::double_contraction;
use crate::{ContinuumError, FirstPiola};

/// Stored energy of a hyperelastic body, stated once over any scalar.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_continuum::fields::integral::StoredEnergy;
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

/// The terms of the balances of a part of a body at a time.
///
/// # Example
/// See [`of`](Self::of).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IntegralBalance {
    /// Mass, momenta and kinetic energy, with their rates.
    pub resultants: Resultants<Dual<f64>>,
    /// Of body forces.
    pub body: ForceResultants,
    /// Of tractions.
    pub surface: ForceResultants,
    /// ∫ P : Ḟ dV, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::fields::reading::finite"))]
    pub stress_power: f64,
}

impl IntegralBalance {
    /// The terms for the part of a body whose place in the reference configuration is `region`.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | x(X, t), `ρ_κ(X)` | `body` | m, kg/m³ |
    /// | P(X, t) | `stress` | Pa |
    /// | b(X, t) | `body_force`, per unit mass | m/s² |
    /// | o | `pole` | m |
    ///
    /// # Errors
    /// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::FirstPiola;
    /// use piola_continuum::fields::integral::{Cuboid, IntegralBalance, Quadrature};
    /// use piola_continuum::fields::{Body, Material, Motion, Uniform};
    /// use piola_numerics::Real;
    /// struct Fall;
    /// impl Motion for Fall {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         reference - Vector3::new(T::lit(0.0), T::lit(0.0), T::lit(5.0) * time * time)
    ///     }
    /// }
    /// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
    /// let body = Body { motion: Fall, reference_density: Uniform(1.0) };
    /// let (free, weight) = (Material(Uniform(FirstPiola::zero())), Material(Uniform(Vector3::new(0.0, 0.0, -10.0))));
    /// let (rules, pole) = (Quadrature::of_degree(2)?, Vector3::zeros());
    /// let terms = IntegralBalance::of(&rules, &unit, &body, &free, &weight, &pole, 1.0)?;
    /// assert!((terms.body.power - 100.0).abs() < 1e-12); // 10 N at 10 m/s
    /// assert!(terms.momentum_residual().relative() < 1e-15 && terms.power_residual().relative() < 1e-15);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn of(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        stress: &Material<impl Field<Value = FirstPiola>>,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        pole: &Vector3<f64>,
        time: f64,
    ) -> Result<Self, ContinuumError> {
        Ok(Self {
            resultants: Resultants::in_reference(quadrature, region, body, pole, Dual::variable(time))?,
            body: ForceResultants::of_body_force(quadrature, region, body, body_force, pole, time)?,
            surface: ForceResultants::of_tractions(quadrature, region, &body.motion, stress, pole, time)?,
            stress_power: stress_power(quadrature, region, &body.motion, stress, time)?,
        })
    }

    /// d/dt ∫ `ρ_κ` ẋ dV − f, N, W(15.16).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::FirstPiola;
    /// use piola_continuum::fields::integral::{Cuboid, IntegralBalance, Quadrature};
    /// use piola_continuum::fields::{Body, Material, Motion, Uniform};
    /// use piola_numerics::Real;
    /// struct Fall; // 5 m after a second
    /// impl Motion for Fall {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         reference - Vector3::new(T::zero(), T::zero(), T::lit(5.0) * time * time)
    ///     }
    /// }
    /// let (unit, pole) = (Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?, Vector3::zeros());
    /// let body = Body { motion: Fall, reference_density: Uniform(1.0) };
    /// let (free, weight) = (Material(Uniform(FirstPiola::zero())), Material(Uniform(Vector3::new(0.0, 0.0, -10.0))));
    /// let terms = IntegralBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &free, &weight, &pole, 1.0)?;
    /// let residual = terms.momentum_residual();
    /// // 10 N against 1 kg · 10 m/s²
    /// assert!(residual.value.norm() < 1e-13 && (residual.scale.z - 20.0).abs() < 1e-13);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[must_use]
    pub fn momentum_residual(&self) -> VectorResidual {
        residual_of(&self.resultants.momentum, &self.body.force, &self.surface.force)
    }

    /// d/dt ∫ `ρ_κ` (x − o) × ẋ dV − m, N m, W(15.18).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::FirstPiola;
    /// use piola_continuum::fields::integral::{Cuboid, IntegralBalance, Quadrature};
    /// use piola_continuum::fields::{Body, Material, Motion, Uniform};
    /// use piola_numerics::Real;
    /// struct Fall; // 5 m after a second
    /// impl Motion for Fall {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         reference - Vector3::new(T::zero(), T::zero(), T::lit(5.0) * time * time)
    ///     }
    /// }
    /// let (unit, pole) = (Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?, Vector3::zeros());
    /// let body = Body { motion: Fall, reference_density: Uniform(1.0) };
    /// let (free, weight) = (Material(Uniform(FirstPiola::zero())), Material(Uniform(Vector3::new(0.0, 0.0, -10.0))));
    /// let terms = IntegralBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &free, &weight, &pole, 1.0)?;
    /// assert!(terms.moment_residual().value.norm() < 1e-13);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[must_use]
    pub fn moment_residual(&self) -> VectorResidual {
        residual_of(&self.resultants.moment_of_momentum, &self.body.moment, &self.surface.moment)
    }

    /// K̇ + ∫ P : Ḟ dV − external power, W, W(21.4).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::FirstPiola;
    /// use piola_continuum::fields::integral::{Cuboid, IntegralBalance, Quadrature};
    /// use piola_continuum::fields::{Body, Material, Motion, Uniform};
    /// use piola_numerics::Real;
    /// struct Fall; // 5 m after a second
    /// impl Motion for Fall {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         reference - Vector3::new(T::zero(), T::zero(), T::lit(5.0) * time * time)
    ///     }
    /// }
    /// let (unit, pole) = (Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?, Vector3::zeros());
    /// let body = Body { motion: Fall, reference_density: Uniform(1.0) };
    /// let (free, weight) = (Material(Uniform(FirstPiola::zero())), Material(Uniform(Vector3::new(0.0, 0.0, -10.0))));
    /// let terms = IntegralBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &free, &weight, &pole, 1.0)?;
    /// let residual = terms.power_residual();
    /// assert!(residual.value.abs() < 1e-12 && (residual.scale - 200.0).abs() < 1e-12); // 10 N at 10 m/s
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[must_use]
    pub fn power_residual(&self) -> Residual {
        let rates = Residual::zero().plus(self.resultants.kinetic_energy.tangent).plus(self.stress_power);
        rates.plus(-self.body.power).plus(-self.surface.power)
    }

    /// All residuals with an estimate of the error of quadrature: one that exceeds it is an error of the fields,
    /// not of the rule. In the order momentum, moment of momentum, power.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::FirstPiola;
    /// use piola_continuum::fields::integral::{Cuboid, EstimatedQuadrature, IntegralBalance};
    /// use piola_continuum::fields::{Body, Material, Motion, Uniform};
    /// use piola_numerics::Real;
    /// struct Fall; // 5 m after a second
    /// impl Motion for Fall {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         reference - Vector3::new(T::zero(), T::zero(), T::lit(5.0) * time * time)
    ///     }
    /// }
    /// let (unit, pole) = (Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?, Vector3::zeros());
    /// let body = Body { motion: Fall, reference_density: Uniform(1.0) };
    /// let (free, weight) = (Material(Uniform(FirstPiola::zero())), Material(Uniform(Vector3::new(0.0, 0.0, -10.0))));
    /// let rules = EstimatedQuadrature::of_degree(2)?;
    /// let residuals = IntegralBalance::estimated_residuals(&rules, &unit, &body, &free, &weight, &pole, 1.0)?;
    /// assert!(residuals.value.iter().all(|residual| residual.abs() < 1e-12) && residuals.error < 1e-12);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn estimated_residuals(
        quadrature: &EstimatedQuadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        stress: &Material<impl Field<Value = FirstPiola>>,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        pole: &Vector3<f64>,
        time: f64,
    ) -> Result<Estimate<[f64; 7]>, ContinuumError> {
        quadrature.estimate(|rule| {
            let terms = Self::of(rule, region, body, stress, body_force, pole, time)?;
            let (p, h) = (terms.momentum_residual().value, terms.moment_residual().value);
            Ok([p.x, p.y, p.z, h.x, h.y, h.z, terms.power_residual().value])
        })
    }
}

/// Rate − body − surface.
fn residual_of(momentum: &Vector3<Dual<f64>>, body: &Vector3<f64>, surface: &Vector3<f64>) -> VectorResidual {
    let component = |i: usize| Residual::zero().plus(momentum[i].tangent).plus(-body[i]).plus(-surface[i]);
    [component(0), component(1), component(2)].into()
}

/// ∫ P : Ḟ dV, the power of the stress, W.
///
/// # Errors
/// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
///
/// # Example
/// See [`IntegralBalance`].
///
/// # Source
/// W(20.8–20.9), W(21.4).
pub fn stress_power(
    quadrature: &Quadrature,
    region: &impl Region<f64>,
    motion: &impl Motion,
    stress: &Material<impl Field<Value = FirstPiola>>,
    time: f64,
) -> Result<f64, ContinuumError> {
    quadrature.volume_integral_of(region, |point| {
        motion.deformation_gradient(&point.position, time)?;
        let (_, rate) = gradient_and_rate(motion, &point.position, time);
        Ok(double_contraction(stress.0.at(&point.position, time).rows(), rate))
    })
}

/// ∫ W(F) dV, the strain energy of a body in motion, J.
///
/// With a time that is a dual variable it carries its rate.
///
/// # Errors
/// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
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
    time: T,
) -> Result<T, ContinuumError> {
    let mut integral = RunningIntegral::new();
    region.volume_points(quadrature, |point| {
        let particle = lift(&point.position);
        let deformation = motion.deformation_gradient(&particle, time)?;
        let density = energy.density(&point.position, deformation.matrix());
        integral.add(&[density], T::lit(point.weight), &particle)
    })?;
    let [total] = integral.value()?;
    Ok(total)
}

/// The mass of a part of a body: at present, with its rate, and in the reference configuration.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::fields::integral::{Cuboid, MassBalance, Quadrature};
/// use piola_continuum::fields::{Body, Motion, Spatial, Uniform};
/// use piola_numerics::Real;
/// struct Swelling;
/// impl Motion for Swelling {
///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
///         reference * (T::lit(1.0) + time)
///     }
/// }
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let body = Body { motion: Swelling, reference_density: Uniform(8.0) };
/// // The density in space does not thin out as it should: mass grows.
/// let wrong = Spatial(Uniform(1.0));
/// let mass = MassBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &wrong, 1.0)?;
/// assert!(mass.residual().value.abs() < 1e-14); // 8 m³ of 1 kg/m³ now,
/// assert!((mass.present.tangent - 12.0).abs() < 1e-14); // but not later
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(17.7), B(4.40), integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MassBalance {
    /// ∫ ρ dv over the moved region, with its rate, kg, kg/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::fields::reading::finite"))]
    pub present: Dual<f64>,
    /// ∫ `ρ_κ` dV, kg.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::fields::reading::finite"))]
    pub reference: f64,
}

impl MassBalance {
    /// Of the part `region` with a density given in space.
    ///
    /// # Errors
    /// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::fields::integral::{Cuboid, MassBalance, Quadrature};
    /// use piola_continuum::fields::{Affine, Body, Spatial, Uniform};
    /// use piola_continuum::DeformationGradient;
    /// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
    /// let stretch = Affine::new(DeformationGradient::uniaxial(2.0, 1.0)?, Vector3::zeros())?;
    /// let body = Body { motion: stretch, reference_density: Uniform(8.0) };
    /// let mass = MassBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &Spatial(Uniform(4.0)), 0.0)?;
    /// assert!((mass.present.value - 8.0).abs() < 1e-14); // 2 m³ of 4 kg/m³
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn of<R: Region<f64> + Region<Dual<f64>>>(
        quadrature: &Quadrature,
        region: &R,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        density: &Spatial<impl Field<Value = f64>>,
        time: f64,
    ) -> Result<Self, ContinuumError> {
        let moving = MovedRegion { region, motion: &body.motion, time: Dual::variable(time) };
        let present =
            quadrature.volume_integral(&moving, |place: &Vector3<Dual<f64>>| density.0.at(place, moving.time))?;
        let reference =
            quadrature.volume_integral(region, |particle: &Vector3<f64>| body.reference_density.at(particle, time))?;
        Ok(Self { present, reference })
    }

    /// ∫ ρ dv − ∫ `ρ_κ` dV, kg; the rate of the first is zero when mass stays.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::fields::integral::{Cuboid, MassBalance, Quadrature};
    /// use piola_continuum::fields::{Affine, Body, Spatial, Uniform};
    /// use piola_continuum::DeformationGradient;
    /// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
    /// let stretch = Affine::new(DeformationGradient::uniaxial(2.0, 1.0)?, Vector3::zeros())?;
    /// let body = Body { motion: stretch, reference_density: Uniform(8.0) };
    /// let mass = MassBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &Spatial(Uniform(5.0)), 0.0)?;
    /// assert!((mass.residual().value - 2.0).abs() < 1e-14); // 2·5 − 8
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[must_use]
    pub fn residual(&self) -> Residual {
        Residual::zero().plus(self.present.value).plus(-self.reference)
    }
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
/// use piola_continuum::fields::integral::{Cuboid, EnergyBalance, Quadrature, StoredEnergy};
/// use piola_continuum::fields::{Body, Material, Motion, Uniform};
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
///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
///         Vector3::new(reference.x * (T::lit(1.0) + time), reference.y, reference.z)
///     }
/// }
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let body = Body { motion: Pull, reference_density: Uniform(1.0) };
/// let none = Material(Uniform(Vector3::zeros()));
/// let terms = EnergyBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &Springs, &none, 3.0)?;
/// assert!((terms.stored.value - 4.5).abs() < 1e-14 && (terms.stored.tangent - 3.0).abs() < 1e-14);
/// assert!((terms.surface_power - 3.0).abs() < 1e-14 && terms.residual().relative() < 1e-15);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(20.4).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnergyBalance {
    /// Kinetic energy K and K̇, J, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::fields::reading::finite"))]
    pub kinetic: Dual<f64>,
    /// Stored energy ∫ W dV and its rate, J, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::fields::reading::finite"))]
    pub stored: Dual<f64>,
    /// Of body forces, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::fields::reading::finite"))]
    pub body_power: f64,
    /// Of tractions, W.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::fields::reading::finite"))]
    pub surface_power: f64,
}

impl EnergyBalance {
    /// The terms for the part `region`.
    ///
    /// # Errors
    /// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_continuum::fields::integral::{Cuboid, EnergyBalance, Quadrature, StoredEnergy};
    /// use piola_continuum::fields::{Body, Material, Motion, Uniform};
    /// use piola_numerics::Real;
    /// struct Bar; // W = ½ (F₁₁ − 1)²
    /// impl StoredEnergy for Bar {
    ///     fn density<T: Real>(&self, _: &Vector3<f64>, gradient: &Matrix3<T>) -> T {
    ///         let elongation = gradient[(0, 0)] - T::one();
    ///         T::lit(0.5) * elongation * elongation
    ///     }
    /// }
    /// struct Pull; // F₁₁ = 1 + t
    /// impl Motion for Pull {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         Vector3::new(reference.x * (T::one() + time), reference.y, reference.z)
    ///     }
    /// }
    /// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
    /// let body = Body { motion: Pull, reference_density: Uniform(1.0) };
    /// let none = Material(Uniform(Vector3::zeros()));
    /// let terms = EnergyBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &Bar, &none, 3.0)?;
    /// assert!((terms.stored.value - 4.5).abs() < 1e-14); // ½ 3²
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn of(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        energy: &impl StoredEnergy,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        time: f64,
    ) -> Result<Self, ContinuumError> {
        let (motion, pole, now) = (&body.motion, Vector3::zeros(), Dual::variable(time));
        let stress = |particle: &Vector3<f64>| energy.stress(particle, &from_rows(gradient(motion, particle, time)));
        let forces = ForceResultants::of_body_force(quadrature, region, body, body_force, &pole, time)?;
        let tractions = ForceResultants::of_stress_on_boundary(quadrature, region, motion, stress, &pole, time)?;
        Ok(Self {
            kinetic: Resultants::in_reference(quadrature, region, body, &pole, now)?.kinetic_energy,
            stored: strain_energy(quadrature, region, motion, energy, now)?,
            body_power: forces.power,
            surface_power: tractions.power,
        })
    }

    /// d/dt (K + ∫ W dV) − power of body forces and tractions, W.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_continuum::fields::integral::{Cuboid, EnergyBalance, Quadrature, StoredEnergy};
    /// use piola_continuum::fields::{Body, Material, Motion, Uniform};
    /// use piola_numerics::Real;
    /// struct Bar; // W = ½ (F₁₁ − 1)²
    /// impl StoredEnergy for Bar {
    ///     fn density<T: Real>(&self, _: &Vector3<f64>, gradient: &Matrix3<T>) -> T {
    ///         let elongation = gradient[(0, 0)] - T::one();
    ///         T::lit(0.5) * elongation * elongation
    ///     }
    /// }
    /// struct Pull; // F₁₁ = 1 + t
    /// impl Motion for Pull {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         Vector3::new(reference.x * (T::one() + time), reference.y, reference.z)
    ///     }
    /// }
    /// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
    /// let body = Body { motion: Pull, reference_density: Uniform(1.0) };
    /// let none = Material(Uniform(Vector3::zeros()));
    /// let terms = EnergyBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &Bar, &none, 3.0)?;
    /// let residual = terms.residual();
    /// assert!(residual.value.abs() < 1e-13 && residual.relative() < 1e-15); // the pull of 3 N at 1 m/s is stored
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[must_use]
    pub fn residual(&self) -> Residual {
        let rates = Residual::zero().plus(self.kinetic.tangent).plus(self.stored.tangent);
        rates.plus(-self.body_power).plus(-self.surface_power)
    }
}
