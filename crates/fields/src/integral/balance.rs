//! The balances of momentum, angular momentum and power of a part of a body, as integrals.
//!
//! ```text
//! d/dt ∫ ρ_κ ẋ dV            = ∫ ρ_κ b dV + ∮ P N dA                              W(15.16)
//! d/dt ∫ ρ_κ (x − o) × ẋ dV  = ∫ ρ_κ (x − o) × b dV + ∮ (x − o) × P N dA          W(15.18)
//! d/dt ½ ∫ ρ_κ ẋ·ẋ dV + ∫ P : Ḟ dV  =  ∫ ρ_κ b·ẋ dV + ∮ P N·ẋ dA                 W(21.4)
//! ```
//!
//! Rates are derivatives of the integrals with respect to time by dual numbers, not integrals of the
//! acceleration. The divergence of the stress is nowhere taken: what the balances state is independent of the
//! residuals at points.

use nalgebra::Vector3;
use piola_continuum::FirstPiola;
use piola_numerics::Dual;
use piola_tensor::internal::rows::double_contraction;

use super::{Estimate, EstimatedQuadrature, ForceResultants, Quadrature, Region, Resultants};
use crate::FieldsError;
use crate::motion::kernels::gradient_and_rate;
use crate::{Body, Field, Material, Motion, Residual, VectorResidual};

/// The terms of the balances of a part of a body at a time.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::FirstPiola;
/// use piola_fields::integral::{Cuboid, IntegralBalance, Quadrature};
/// use piola_fields::{Body, Material, Motion, Uniform};
/// use piola_numerics::Real;
/// struct Fall;
/// impl Motion for Fall {
///     fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
///         reference - Vector3::new(T::lit(0.0), T::lit(0.0), T::lit(5.0) * t * t)
///     }
/// }
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let body = Body { motion: Fall, reference_density: Uniform(1.0) };
/// let (free, weight) = (Material(Uniform(FirstPiola::zero())), Material(Uniform(Vector3::new(0.0, 0.0, -10.0))));
/// let (rules, pole) = (Quadrature::of_degree(2)?, Vector3::zeros());
/// let terms = IntegralBalance::of(&rules, &unit, &body, &free, &weight, &pole, 1.0)?;
/// assert!((terms.body.power - 100.0).abs() < 1e-12); // 10 N at 10 m/s
/// assert!(terms.momentum_residual().relative() < 1e-15 && terms.power_residual().relative() < 1e-15);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
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
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
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
    /// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
    pub fn of(
        quadrature: &Quadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        stress: &Material<impl Field<Value = FirstPiola>>,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        pole: &Vector3<f64>,
        t: f64,
    ) -> Result<Self, FieldsError> {
        Ok(Self {
            resultants: Resultants::in_reference(quadrature, region, body, pole, Dual::variable(t))?,
            body: ForceResultants::of_body_force(quadrature, region, body, body_force, pole, t)?,
            surface: ForceResultants::of_tractions(quadrature, region, &body.motion, stress, pole, t)?,
            stress_power: stress_power(quadrature, region, &body.motion, stress, t)?,
        })
    }

    /// d/dt ∫ `ρ_κ` ẋ dV − f, N, W(15.16).
    #[must_use]
    pub fn momentum_residual(&self) -> VectorResidual {
        residual_of(&self.resultants.momentum, &self.body.force, &self.surface.force)
    }

    /// d/dt ∫ `ρ_κ` (x − o) × ẋ dV − m, N m, W(15.18).
    #[must_use]
    pub fn moment_residual(&self) -> VectorResidual {
        residual_of(&self.resultants.angular_momentum, &self.body.moment, &self.surface.moment)
    }

    /// K̇ + ∫ P : Ḟ dV − external power, W, W(21.4).
    #[must_use]
    pub fn power_residual(&self) -> Residual {
        let rates = Residual::zero().plus(self.resultants.kinetic_energy.tangent).plus(self.stress_power);
        rates.plus(-self.body.power).plus(-self.surface.power)
    }

    /// All residuals with an estimate of the error of quadrature: one that exceeds it is an error of the fields,
    /// not of the rule. In the order momentum, angular momentum, power.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn estimated_residuals(
        quadrature: &EstimatedQuadrature,
        region: &impl Region<f64>,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        stress: &Material<impl Field<Value = FirstPiola>>,
        body_force: &Material<impl Field<Value = Vector3<f64>>>,
        pole: &Vector3<f64>,
        t: f64,
    ) -> Result<Estimate<[f64; 7]>, FieldsError> {
        quadrature.estimate(|rule| {
            let terms = Self::of(rule, region, body, stress, body_force, pole, t)?;
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
/// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
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
    t: f64,
) -> Result<f64, FieldsError> {
    quadrature.volume_integral_of(region, |point| {
        motion.deformation_gradient(&point.position, t)?;
        let (_, rate) = gradient_and_rate(motion, &point.position, t);
        Ok(double_contraction(stress.0.at(&point.position, t).rows(), rate))
    })
}
