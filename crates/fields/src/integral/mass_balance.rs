//! The balance of mass of a part of a body: d/dt ∫ ρ dv = 0.

use nalgebra::Vector3;
use piola_numerics::Dual;

use super::{MovedRegion, Quadrature, Region};
use crate::FieldsError;
use crate::{Body, Field, Motion, Residual, Spatial};

/// The mass of a part of a body: at present, with its rate, and in the reference configuration.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::{Cuboid, MassBalance, Quadrature};
/// use piola_fields::{Body, Motion, Spatial, Uniform};
/// use piola_numerics::Real;
/// struct Swelling;
/// impl Motion for Swelling {
///     fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
///         reference * (T::lit(1.0) + t)
///     }
/// }
/// let unit = Cuboid::new(Vector3::zeros(), Vector3::repeat(1.0))?;
/// let body = Body { motion: Swelling, reference_density: Uniform(8.0) };
/// // The density in space does not thin out as it should: mass grows.
/// let wrong = Spatial(Uniform(1.0));
/// let mass = MassBalance::of(&Quadrature::of_degree(2)?, &unit, &body, &wrong, 1.0)?;
/// assert!(mass.residual().value.abs() < 1e-14); // 8 m³ of 1 kg/m³ now,
/// assert!((mass.present.tangent - 12.0).abs() < 1e-14); // but not later
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// W(17.7), B(4.40), integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MassBalance {
    /// ∫ ρ dv over the moved region, with its rate, kg, kg/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub present: Dual<f64>,
    /// ∫ `ρ_κ` dV, kg.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub reference: f64,
}

impl MassBalance {
    /// Of the part `region` with a density given in space.
    ///
    /// # Errors
    /// [`FieldsError::IntegrandNotFinite`]; what the motion refuses.
    pub fn of<R: Region<f64> + Region<Dual<f64>>>(
        quadrature: &Quadrature,
        region: &R,
        body: &Body<impl Motion, impl Field<Value = f64>>,
        density: &Spatial<impl Field<Value = f64>>,
        t: f64,
    ) -> Result<Self, FieldsError> {
        let moving = MovedRegion { region, motion: &body.motion, time: Dual::variable(t) };
        let present =
            quadrature.volume_integral(&moving, |place: &Vector3<Dual<f64>>| density.0.at(place, moving.time))?;
        let reference =
            quadrature.volume_integral(region, |particle: &Vector3<f64>| body.reference_density.at(particle, t))?;
        Ok(Self { present, reference })
    }

    /// ∫ ρ dv − ∫ `ρ_κ` dV, kg; the rate of the first is zero when mass stays.
    #[must_use]
    pub fn residual(&self) -> Residual {
        Residual::zero().plus(self.present.value).plus(-self.reference)
    }
}
