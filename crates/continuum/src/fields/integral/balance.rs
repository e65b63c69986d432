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
use super::{EstimatedQuadrature, ForceResultants, MovedRegion, Quadrature, Region, Resultants, SpatialField};
use crate::fields::Motion;
use crate::fields::motion::kernels::{gradient, gradient_and_rate};
use crate::tensor::rows::double_contraction;
use crate::{ContinuumError, FirstPiola};

/// What acts in a body in motion: mass, stress and body force at each particle.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::fields::integral::Actions;
/// use piola_continuum::{ContinuumError, FirstPiola};
/// /// Free fall.
/// struct Fall;
/// impl Actions for Fall {
///     fn density(&self, _: &Vector3<f64>) -> f64 {
///         1000.0
///     }
///     fn stress(&self, _: &Vector3<f64>, _: f64) -> Result<FirstPiola, ContinuumError> {
///         Ok(FirstPiola::zero())
///     }
///     fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
///         Vector3::new(0.0, 0.0, -9.81)
///     }
/// }
/// assert_eq!(Fall.density(&Vector3::zeros()), 1000.0);
/// ```
pub trait Actions {
    /// ρ_κ(X), kg per reference m³.
    fn density(&self, reference: &Vector3<f64>) -> f64;
    /// P(X, t), Pa.
    ///
    /// # Errors
    /// Whatever the stress refuses.
    fn stress(&self, reference: &Vector3<f64>, time: f64) -> Result<FirstPiola, ContinuumError>;
    /// b(X, t), N/kg.
    fn body_force(&self, reference: &Vector3<f64>, time: f64) -> Vector3<f64>;
}

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
    fn stress(&self, reference: &Vector3<f64>, gradient: &Matrix3<f64>) -> FirstPiola {
        let rows = rows_of(gradient);
        let variable = |i: usize, j: usize| Gradient::<f64, 9>::variable(rows[i][j], 3 * i + j);
        let energy = self.density(reference, &Matrix3::from_fn(variable));
        FirstPiola::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| energy.partials[3 * i + j])))
    }
}

/// The terms of the balances of a part of a body at a time.
///
/// # Example
/// See [`of`](Self::of).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntegralBalance {
    /// ∫ ρ_κ dV and what is in the region of space: values and rates.
    pub resultants: Resultants<Dual<f64>>,
    /// Body forces.
    pub body: ForceResultants,
    /// Tractions.
    pub surface: ForceResultants,
    /// ∫ P : Ḟ dV, W.
    pub stress_power: f64,
}

impl IntegralBalance {
    /// The terms for the part of a body whose place in the reference configuration is `region`.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | ρ_κ, P, b | `actions` | kg/m³, Pa, N/kg |
    /// | o | `pole` | m |
    ///
    /// # Errors
    /// [`ContinuumError::NonFiniteIntegrand`]; what the motion or the stress refuses.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_continuum::fields::Motion;
    /// use piola_continuum::fields::integral::{Actions, Ball, IntegralBalance, Quadrature};
    /// use piola_continuum::{ContinuumError, FirstPiola};
    /// use piola_numerics::Real;
    /// struct Fall;
    /// impl Motion for Fall {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
    ///         reference - Vector3::new(T::lit(0.0), T::lit(0.0), T::lit(5.0) * time * time)
    ///     }
    /// }
    /// impl Actions for Fall {
    ///     fn density(&self, _: &Vector3<f64>) -> f64 {
    ///         3.0 / (4.0 * core::f64::consts::PI)
    ///     }
    ///     fn stress(&self, _: &Vector3<f64>, _: f64) -> Result<FirstPiola, ContinuumError> {
    ///         Ok(FirstPiola::zero())
    ///     }
    ///     fn body_force(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
    ///         Vector3::new(0.0, 0.0, -10.0)
    ///     }
    /// }
    /// let ball = Ball::new(Vector3::zeros(), 1.0)?;
    /// let terms = IntegralBalance::of(&Quadrature::of_degree(2)?, &ball, &Fall, &Fall, &Vector3::zeros(), 1.0)?;
    /// assert!((terms.body.power - 100.0).abs() < 1e-12); // 10 N at 10 m/s
    /// assert!(terms.momentum_residual().norm() < 1e-14 && terms.power_residual().abs() < 1e-12);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn of(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        motion: &impl Motion,
        actions: &impl Actions,
        pole: &Vector3<f64>,
        time: f64,
    ) -> Result<Self, ContinuumError> {
        let density = |particle: &Vector3<f64>| actions.density(particle);
        let body_force = |particle: &Vector3<f64>| actions.body_force(particle, time);
        let stress = |particle: &Vector3<f64>| actions.stress(particle, time);
        let now = Dual::variable(time);
        Ok(Self {
            resultants: Resultants::in_reference(quadrature, region, motion, density, pole, now)?,
            body: ForceResultants::of_body_force(quadrature, region, motion, density, body_force, pole, time)?,
            surface: ForceResultants::of_tractions(quadrature, region, motion, stress, pole, time)?,
            stress_power: stress_power(quadrature, region, motion, stress, time)?,
        })
    }

    /// d/dt ∫ ρ_κ ẋ dV − f.
    #[must_use]
    pub fn momentum_residual(&self) -> Vector3<f64> {
        self.resultants.momentum.map(|p| p.tangent) - (self.body.force + self.surface.force)
    }

    /// d/dt ∫ ρ_κ (x − o) × ẋ dV − m.
    #[must_use]
    pub fn moment_residual(&self) -> Vector3<f64> {
        self.resultants.moment_of_momentum.map(|h| h.tangent) - (self.body.moment + self.surface.moment)
    }

    /// K̇ + ∫ P : Ḟ dV − external power.
    #[must_use]
    pub fn power_residual(&self) -> f64 {
        self.resultants.kinetic_energy.tangent + self.stress_power - (self.body.power + self.surface.power)
    }

    /// All residuals: momentum, moment of momentum, power.
    #[must_use]
    pub fn residuals(&self) -> [f64; 7] {
        let (p, h) = (self.momentum_residual(), self.moment_residual());
        [p.x, p.y, p.z, h.x, h.y, h.z, self.power_residual()]
    }

    /// The residuals with an estimate of the error of quadrature: a residual that exceeds it is one of the
    /// motion, not of the rule.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn estimated_residuals(
        quadrature: &EstimatedQuadrature,
        region: &impl Region<f64>,
        motion: &impl Motion,
        actions: &impl Actions,
        pole: &Vector3<f64>,
        time: f64,
    ) -> Result<super::Estimate<[f64; 7]>, ContinuumError> {
        quadrature.estimate(|rule| Ok(Self::of(rule, region, motion, actions, pole, time)?.residuals()))
    }
}

/// ∫ P : Ḟ dV, the power of the stress, W.
///
/// # Errors
/// [`ContinuumError::NonFiniteIntegrand`]; what the motion or the stress refuses.
///
/// # Source
/// W(20.8–20.9), W(21.4).
pub fn stress_power(
    quadrature: &Quadrature,
    region: &impl Region<f64>,
    motion: &impl Motion,
    mut stress: impl FnMut(&Vector3<f64>) -> Result<FirstPiola, ContinuumError>,
    time: f64,
) -> Result<f64, ContinuumError> {
    quadrature.volume_integral_of(region, |point| {
        motion.deformation_gradient(&point.position, time)?;
        let (_, rate) = gradient_and_rate(motion, &point.position, time);
        Ok(double_contraction(stress(&point.position)?.rows(), rate))
    })
}

/// ∫ W(F) dV, the strain energy of a body in motion, J.
///
/// # Errors
/// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
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
    let [total] = integral.value();
    Ok(total)
}

/// Both sides of the balance of mass: ∫ ρ dv over the moved region, with its rate, and ∫ ρ_κ dV.
///
/// `field` is the density in space, ρ(x, t). Its residuals are `present.value` − `reference` and `present.tangent`.
///
/// # Errors
/// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
///
/// # Source
/// W(17.7), B(4.40) integrated.
pub fn mass_balance<R: Region<f64> + Region<Dual<f64>>>(
    quadrature: &Quadrature,
    region: &R,
    motion: &impl Motion,
    mut density: impl FnMut(&Vector3<f64>) -> f64,
    field: &impl SpatialField<1>,
    time: f64,
) -> Result<MassBalance, ContinuumError> {
    let moving = MovedRegion { region, motion, time: Dual::variable(time) };
    let [present] = quadrature.volume_integral(&moving, |place: &Vector3<Dual<f64>>| field.at(place, moving.time))?;
    let reference = quadrature.volume_integral(region, |particle: &Vector3<f64>| density(particle))?;
    Ok(MassBalance { present, reference })
}

/// The mass of a part at present, with its rate, and in the reference configuration: see [`mass_balance`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassBalance {
    /// ∫ ρ dv and its rate, kg, kg/s.
    pub present: Dual<f64>,
    /// ∫ ρ_κ dV, kg.
    pub reference: f64,
}

/// The terms of the balance of energy of a hyperelastic body: see the [module](self).
///
/// # Source
/// W(20.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyBalance {
    /// Kinetic energy K and K̇, J, W.
    pub kinetic: Dual<f64>,
    /// Stored energy ∫ W dV and its rate, J, W.
    pub stored: Dual<f64>,
    /// The power of body forces and tractions, W.
    pub external_power: f64,
}

impl EnergyBalance {
    /// The terms for the part `region`, whose stress is ∂W/∂F.
    ///
    /// # Errors
    /// [`ContinuumError::NonFiniteIntegrand`]; what the motion refuses.
    pub fn of(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        motion: &impl Motion,
        energy: &impl StoredEnergy,
        density: impl Fn(&Vector3<f64>) -> f64,
        body_force: impl Fn(&Vector3<f64>) -> Vector3<f64>,
        time: f64,
    ) -> Result<Self, ContinuumError> {
        let (now, pole) = (Dual::variable(time), Vector3::zeros());
        let stress = |particle: &Vector3<f64>| {
            Ok(energy.stress(particle, &from_rows(gradient(motion, particle, time))))
        };
        let body = ForceResultants::of_body_force(quadrature, region, motion, &density, body_force, &pole, time)?;
        let surface = ForceResultants::of_tractions(quadrature, region, motion, stress, &pole, time)?;
        Ok(Self {
            kinetic: Resultants::in_reference(quadrature, region, motion, &density, &pole, now)?.kinetic_energy,
            stored: strain_energy(quadrature, region, motion, energy, now)?,
            external_power: body.power + surface.power,
        })
    }

    /// d/dt (K + ∫ W dV) − external power.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.kinetic.tangent + self.stored.tangent - self.external_power
    }
}
