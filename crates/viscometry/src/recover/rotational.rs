//! Cone and plate: the shear rate is the same everywhere, and nothing has to be differentiated.

use core::f64::consts::{PI, TAU};

use super::geometry::ConeGeometry;
use crate::ViscometryError;
use crate::error::check_bound;

/// Viscometric functions from cone and plate at one speed.
///
/// # Example
/// See [`cone_and_plate`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConePoint {
    /// k, 1/s.
    pub shear_rate: f64,
    /// τ, Pa.
    pub shear_stress: f64,
    /// N₁, Pa.
    pub first_normal_stress_difference: f64,
}

/// The viscometric functions from the torque and the thrust of cone and plate.
///
/// ```text
/// k = Ω/α      τ = 3 𝓜/(2πR³)      N₁ = 2 𝓕/(πR²)
/// ```
/// | symbol | argument | unit |
/// |---|---|---|
/// | Ω | `angular_velocity` | rad/s |
/// | 𝓜 | `torque` | N m |
/// | 𝓕 | `thrust`, beyond that of the pressure around | N |
///
/// # Errors
/// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`].
///
/// # Accuracy
/// 4 ulp of the formulae, which leave out terms of the order of α² and of inertia.
///
/// # Example
/// ```
/// use core::f64::consts::PI;
/// use piola_viscometry::recover::{ConeGeometry, cone_and_plate};
/// let point = cone_and_plate(ConeGeometry::new(1.0, 0.02)?, 0.1, 2.0 * PI, PI)?;
/// assert_eq!((point.shear_rate, point.shear_stress, point.first_normal_stress_difference), (5.0, 3.0, 2.0));
/// # Ok::<(), piola_viscometry::ViscometryError>(())
/// ```
///
/// # Source
/// The equal shear rate between a flat cone and a plate; beyond W §23.
pub fn cone_and_plate(
    geometry: ConeGeometry,
    angular_velocity: f64,
    torque: f64,
    thrust: f64,
) -> Result<ConePoint, ViscometryError> {
    let flow = "cone and plate";
    check_bound(flow, "angular velocity", angular_velocity, "0 < Omega", 0.0 < angular_velocity)?;
    check_bound(flow, "torque", torque, "0 < torque", 0.0 < torque)?;
    check_bound(flow, "thrust", thrust, "finite", true)?;
    let ConeGeometry { radius, angle } = geometry;
    Ok(ConePoint {
        shear_rate: angular_velocity / angle,
        shear_stress: 3.0 * torque / (TAU * radius * radius * radius),
        first_normal_stress_difference: 2.0 * thrust / (PI * radius * radius),
    })
}
