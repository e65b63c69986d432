//! Rigid bodies: momentum, angular momentum, energy and their rates.
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

mod motion;

use nalgebra::Vector3;
use piola_numerics::Real;

use crate::error::KinematicsError;
use crate::inertia::Inertia;
use crate::vector::{cross, dot, scaled};

pub use motion::{BodyMotion, BodyPose, BodyVelocity};

/// A rigid body: its mass and its inertia tensor about the centre of mass.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{Inertia, RigidBody};
/// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
/// let energy = body.kinetic_energy(&Vector3::new(3.0, 0.0, 0.0), &Vector3::new(0.0, 0.0, 4.0));
/// assert_eq!(energy, 9.0 + 4.0); // ½·2·3² + ½·½·4²
/// // Torque-free only about a principal axis: here (I₃ − I₂) ω₂ ω₃ = −½·3·4 about the first.
/// let torque = body.spin_rate_in_body(&Vector3::new(0.0, 3.0, 4.0), &Vector3::zeros());
/// assert_eq!(torque, Vector3::new(-6.0, 0.0, 0.0));
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
    pub fn new(mass: f64, inertia: Inertia) -> Result<Self, KinematicsError> {
        crate::error::positive_mass(mass)?;
        Ok(Self { mass, inertia })
    }

    /// Mass M (kg).
    #[inline]
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Inertia tensor I about the centre of mass.
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
    /// # Source
    /// W(2.40).
    #[inline]
    #[must_use]
    pub fn kinetic_energy<T: Real>(&self, velocity: &Vector3<T>, angular_velocity_in_body: &Vector3<T>) -> T {
        let translation = T::lit(0.5 * self.mass) * dot(velocity, velocity);
        let omega = angular_velocity_in_body;
        translation + T::lit(0.5) * dot(omega, &self.inertia.times(omega))
    }

    /// Rate of kinetic energy, dE/dt = M v^c·a^c + ω·I ω̇ (W).
    ///
    /// # Source
    /// W(2.41).
    #[doc(alias = "power")]
    #[inline]
    #[must_use]
    pub fn kinetic_energy_rate<T: Real>(
        &self,
        velocity: &Vector3<T>,
        acceleration: &Vector3<T>,
        angular_velocity_in_body: &Vector3<T>,
        angular_acceleration_in_body: &Vector3<T>,
    ) -> T {
        T::lit(self.mass) * dot(velocity, acceleration)
            + dot(angular_velocity_in_body, &self.inertia.times(angular_acceleration_in_body))
    }

    /// Momentum L = M v^c (kg m/s).
    ///
    /// # Source
    /// W(2.35).
    #[inline]
    #[must_use]
    pub fn momentum<T: Real>(&self, velocity: &Vector3<T>) -> Vector3<T> {
        scaled(velocity, T::lit(self.mass))
    }

    /// Angular momentum about the centre of mass in body components, I ω (kg m²/s).
    ///
    /// # Source
    /// W(2.35).
    #[doc(alias("angular momentum", "moment of momentum"))]
    #[inline]
    #[must_use]
    pub fn spin_in_body<T: Real>(&self, angular_velocity_in_body: &Vector3<T>) -> Vector3<T> {
        self.inertia.times(angular_velocity_in_body)
    }

    /// Body components of the rate of angular momentum about the centre of mass, I ω̇ + ω×I ω (N m):
    /// the torque of Euler's equations.
    ///
    /// # Source
    /// W(2.39), W(4.8).
    #[doc(alias("Euler equations", "torque"))]
    #[inline]
    #[must_use]
    pub fn spin_rate_in_body<T: Real>(
        &self,
        angular_velocity_in_body: &Vector3<T>,
        angular_acceleration_in_body: &Vector3<T>,
    ) -> Vector3<T> {
        let omega = angular_velocity_in_body;
        self.inertia.times(angular_acceleration_in_body) + cross(omega, &self.inertia.times(omega))
    }

    /// Angular momentum about a fixed point o, in space components (kg m²/s).
    ///
    /// ```text
    /// H = M (x^c − o)×v^c + I ω
    /// ```
    ///
    /// # Source
    /// W(2.35).
    #[doc(alias = "moment of momentum")]
    #[must_use]
    pub fn angular_momentum<T: Real>(&self, motion: &BodyMotion<T>, about: &Vector3<T>) -> Vector3<T> {
        let arm = motion.position - about;
        cross(&arm, &self.momentum(&motion.velocity))
            + motion.attitude.to_space(&self.spin_in_body(&motion.angular_velocity))
    }

    /// Rate of angular momentum about a fixed point o, in space components (N m).
    ///
    /// ```text
    /// dH/dt = M (x^c − o)×a^c + I ω̇ + ω×I ω
    /// ```
    ///
    /// # Source
    /// W(2.39).
    #[must_use]
    pub fn angular_momentum_rate<T: Real>(&self, motion: &BodyMotion<T>, about: &Vector3<T>) -> Vector3<T> {
        let arm = motion.position - about;
        let spin_rate = self.spin_rate_in_body(&motion.angular_velocity, &motion.angular_acceleration);
        cross(&arm, &scaled(&motion.acceleration, T::lit(self.mass))) + motion.attitude.to_space(&spin_rate)
    }
}

/// Velocity of an embedded point p from that of any other embedded point q: v^p = v^q + ω×r^{qp}, all in
/// the same components (m/s); r^{qp} leads from q to p.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::rigid_body::velocity_of_embedded_point;
/// let omega = Vector3::new(0.0, 0.0, 2.0);
/// assert_eq!(velocity_of_embedded_point(&Vector3::zeros(), &omega, &Vector3::x()).y, 2.0);
/// ```
///
/// # Source
/// W(2.19).
#[inline]
#[must_use]
pub fn velocity_of_embedded_point<T: Real>(
    velocity_of_q: &Vector3<T>,
    angular_velocity: &Vector3<T>,
    from_q_to_p: &Vector3<T>,
) -> Vector3<T> {
    velocity_of_q + cross(angular_velocity, from_q_to_p)
}

/// Angular velocity, in components along the basis itself, of an orthonormal basis `f_i` with rates `ḟ_i`.
///
/// ```text
/// Ω_ij = f_j·ḟ_i        ω = Ω_23 f_1 − Ω_13 f_2 + Ω_12 f_3
/// ```
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::rigid_body::angular_velocity_of_basis;
/// let basis = [Vector3::x(), Vector3::y(), Vector3::z()];
/// // Turning about z with 2 rad/s: ḟ₁ = 2 e₂, ḟ₂ = −2 e₁.
/// let rates = [Vector3::y() * 2.0, Vector3::x() * -2.0, Vector3::zeros()];
/// assert_eq!(angular_velocity_of_basis(&basis, &rates), Vector3::new(0.0, 0.0, 2.0));
/// ```
///
/// # Source
/// W(2.13–2.14).
#[doc(alias = "spin")]
#[must_use]
pub fn angular_velocity_of_basis<T: Real>(basis: &[Vector3<T>; 3], rates: &[Vector3<T>; 3]) -> Vector3<T> {
    let spin = |i: usize, j: usize| dot(&basis[j], &rates[i]);
    Vector3::new(spin(1, 2), -spin(0, 2), spin(0, 1))
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
