//! Rigid bodies: momentum, moment of momentum, energy and their rates.
//!
//! ```text
//! x^p = x^c + yⁱ f_i                                   W(2.10)
//! v^p = v^q + ω × r^{pq}                               W(2.19)
//! L = M v^c        H = M r^c × v^c + I ω               W(2.35)
//! dL/dt = M a^c    dH/dt = M r^c × a^c + I ω̇ + ω×I ω   W(2.39)
//! E = ½ M |v^c|² + ½ ω·I ω                             W(2.40)
//! dE/dt = M v^c·a^c + ω·I ω̇                            W(2.41)
//! ```
//!
//! Angular velocities are taken in body components, because there I is constant; positions and linear
//! velocities in space components.
//!
//! # References
//! W(2.10–2.41).

use nalgebra::Vector3;
use piola_numerics::Real;

use crate::error::KinematicsError;
use crate::inertia::Inertia;
use crate::vector::dot;

/// A rigid body: its mass and its inertia tensor about the centre of mass.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{Inertia, RigidBody};
/// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
/// let energy = body.kinetic_energy(&Vector3::new(3.0, 0.0, 0.0), &Vector3::new(0.0, 0.0, 4.0));
/// assert_eq!(energy, 9.0 + 4.0); // ½·2·3² + ½·½·4²
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked", into = "Unchecked"))]
pub struct RigidBody {
    mass: f64,
    inertia: Inertia,
}

impl RigidBody {
    /// A body of the given mass (kg) and inertia about its centre of mass.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`]; [`KinematicsError::NonPositiveMass`] unless 0 < mass.
    ///
    /// # Example
    /// ```
    /// use piola_kinematics::{Inertia, RigidBody};
    /// let inertia = Inertia::principal([1.0, 1.0, 0.5])?;
    /// assert!(RigidBody::new(-1.0, inertia).is_err());
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    pub fn new(mass: f64, inertia: Inertia) -> Result<Self, KinematicsError> {
        crate::error::positive_mass(mass)?;
        Ok(Self { mass, inertia })
    }

    /// Mass M (kg).
    ///
    /// # Example
    /// ```
    /// use piola_kinematics::{Inertia, RigidBody};
    /// assert_eq!(RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?.mass(), 2.0);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Inertia tensor I about the centre of mass.
    ///
    /// # Example
    /// ```
    /// use piola_kinematics::{Inertia, RigidBody};
    /// let inertia = Inertia::principal([1.0, 1.0, 0.5])?;
    /// assert_eq!(RigidBody::new(2.0, inertia)?.inertia(), &inertia);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn inertia(&self) -> &Inertia {
        &self.inertia
    }

    /// Kinetic energy.
    ///
    /// ```text
    /// E = ½ M |v^c|² + ½ ω·I ω
    /// ```
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | v^c | `velocity`, of the centre of mass | 3 | m/s |
    /// | ω | `angular_velocity_in_body` | 3 | rad/s |
    /// | E | returned | scalar | J |
    ///
    /// # Example
    /// See [`RigidBody`].
    ///
    /// # Source
    /// W(2.40).
    #[inline]
    #[must_use]
    pub fn kinetic_energy<T: Real>(&self, velocity: &Vector3<T>, angular_velocity_in_body: &Vector3<T>) -> T {
        let translation = T::lit(0.5 * self.mass) * dot(velocity, velocity);
        let omega = angular_velocity_in_body;
        translation + T::lit(0.5) * dot(omega, &self.inertia.times(omega))
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    mass: f64,
    inertia: Inertia,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for RigidBody {
    type Error = KinematicsError;

    fn try_from(body: Unchecked) -> Result<Self, KinematicsError> {
        Self::new(body.mass, body.inertia)
    }
}

#[cfg(feature = "serde")]
impl From<RigidBody> for Unchecked {
    fn from(body: RigidBody) -> Self {
        Self { mass: body.mass, inertia: body.inertia }
    }
}
