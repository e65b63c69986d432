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

use crate::attitude::Attitude;
use crate::error::KinematicsError;
use crate::inertia::Inertia;
use crate::vector::{cross, dot, scaled};

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

    /// Rate of kinetic energy, dE/dt = M v^c·a^c + ω·I ω̇ (W).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{Inertia, RigidBody};
    /// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
    /// let (v, a) = (Vector3::new(3.0, 0.0, 0.0), Vector3::x());
    /// let (spin, spin_up) = (Vector3::new(0.0, 0.0, 4.0), Vector3::z());
    /// assert_eq!(body.kinetic_energy_rate(&v, &a, &spin, &spin_up), 6.0 + 2.0);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(2.41).
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
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{Inertia, RigidBody};
    /// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
    /// assert_eq!(body.momentum(&Vector3::new(3.0, 0.0, 0.0)).x, 6.0);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(2.35).
    #[inline]
    #[must_use]
    pub fn momentum<T: Real>(&self, velocity: &Vector3<T>) -> Vector3<T> {
        scaled(velocity, T::lit(self.mass))
    }

    /// Moment of momentum about the centre of mass in body components, I ω (kg m²/s).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{Inertia, RigidBody};
    /// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
    /// assert_eq!(body.spin_in_body(&Vector3::new(0.0, 0.0, 4.0)).z, 2.0);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(2.35).
    #[inline]
    #[must_use]
    pub fn spin_in_body<T: Real>(&self, angular_velocity_in_body: &Vector3<T>) -> Vector3<T> {
        self.inertia.times(angular_velocity_in_body)
    }

    /// Body components of the rate of moment of momentum about the centre of mass, I ω̇ + ω×I ω (N m):
    /// the torque of Euler's equations.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{Inertia, RigidBody};
    /// // Torque-free only about a principal axis: here (I₃ − I₂) ω₂ ω₃ = −½·3·4 about the first.
    /// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
    /// let rate = body.spin_rate_in_body(&Vector3::new(0.0, 3.0, 4.0), &Vector3::zeros());
    /// assert_eq!(rate, Vector3::new(-6.0, 0.0, 0.0));
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(2.39), W(4.8).
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

    /// Moment of momentum about a fixed point o, in space components (kg m²/s).
    ///
    /// ```text
    /// H = M (x^c − o)×v^c + I ω
    /// ```
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{BodyMotion, Inertia, RigidBody};
    /// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
    /// let mut motion = BodyMotion::at_rest();
    /// motion.position.x = 1.0;
    /// motion.velocity.y = 3.0;
    /// motion.angular_velocity.z = 4.0;
    /// assert_eq!(body.moment_of_momentum(&motion, &Vector3::zeros()).z, 6.0 + 2.0);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(2.35).
    #[must_use]
    pub fn moment_of_momentum<T: Real>(&self, motion: &BodyMotion<T>, about: &Vector3<T>) -> Vector3<T> {
        let arm = motion.position - about;
        cross(&arm, &self.momentum(&motion.velocity))
            + motion.attitude.to_space(&self.spin_in_body(&motion.angular_velocity))
    }

    /// Rate of moment of momentum about a fixed point o, in space components (N m).
    ///
    /// ```text
    /// dH/dt = M (x^c − o)×a^c + I ω̇ + ω×I ω
    /// ```
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{BodyMotion, Inertia, RigidBody};
    /// let body = RigidBody::new(2.0, Inertia::principal([1.0, 1.0, 0.5])?)?;
    /// let mut motion = BodyMotion::at_rest();
    /// motion.position.x = 1.0;
    /// motion.acceleration.y = 3.0;
    /// assert_eq!(body.moment_of_momentum_rate(&motion, &Vector3::zeros()).z, 6.0);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(2.39).
    #[must_use]
    pub fn moment_of_momentum_rate<T: Real>(&self, motion: &BodyMotion<T>, about: &Vector3<T>) -> Vector3<T> {
        let arm = motion.position - about;
        let spin_rate = self.spin_rate_in_body(&motion.angular_velocity, &motion.angular_acceleration);
        cross(&arm, &scaled(&motion.acceleration, T::lit(self.mass))) + motion.attitude.to_space(&spin_rate)
    }
}

/// Where a body is: its centre of mass and its attitude.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::BodyPose;
/// let mut pose = BodyPose::<f64>::at_rest();
/// pose.position.z = 2.0;
/// assert_eq!(pose.embedded_point(&Vector3::x()), Vector3::new(1.0, 0.0, 2.0));
/// ```
///
/// # Source
/// W(2.10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPose<T: Real> {
    /// x^c (m, space components).
    pub position: Vector3<T>,
    /// Body to space.
    pub attitude: Attitude<T>,
}

impl<T: Real> BodyPose<T> {
    /// At the origin, body axes along the space axes.
    ///
    /// # Example
    /// See [`BodyPose`].
    #[must_use]
    pub fn at_rest() -> Self {
        Self { position: Vector3::zeros(), attitude: Attitude::identity() }
    }

    /// Where a point of the body is: `x^p = x^c + yⁱ f_i`, y in body components (m).
    ///
    /// # Example
    /// See [`BodyPose`].
    ///
    /// # Source
    /// W(2.10).
    #[must_use]
    pub fn embedded_point(&self, y: &Vector3<T>) -> Vector3<T> {
        self.position + self.attitude.to_space(y)
    }

    /// Which point of the body is at the place x of space: yⁱ = (x − x^c)·`f_i`, in body components (m).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_kinematics::{Attitude, BodyPose};
    /// let pose = BodyPose { position: Vector3::new(1.0, 0.0, 0.0), attitude: Attitude { w: 0.0, x: 0.0, y: 0.0, z: 1.0 } };
    /// assert_eq!(pose.point_in_body(&Vector3::zeros()), Vector3::x());
    /// ```
    ///
    /// # Source
    /// W(2.10), inverted.
    #[must_use]
    pub fn point_in_body(&self, x: &Vector3<T>) -> Vector3<T> {
        self.attitude.to_body(&(x - self.position))
    }

    /// The pose in space of something whose pose in this body is `other`.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_kinematics::BodyPose;
    /// let step = BodyPose { position: Vector3::<f64>::x(), ..BodyPose::at_rest() };
    /// assert_eq!(step.product(&step).position.x, 2.0);
    /// ```
    #[must_use]
    pub fn product(&self, other: &Self) -> Self {
        Self { position: self.embedded_point(&other.position), attitude: self.attitude.product(other.attitude) }
    }

    /// The pose of space in the body, which undoes this one.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_kinematics::BodyPose;
    /// let step = BodyPose { position: Vector3::<f64>::x(), ..BodyPose::at_rest() };
    /// assert_eq!(step.product(&step.inverse()), BodyPose::at_rest());
    /// ```
    #[must_use]
    pub fn inverse(&self) -> Self {
        let attitude = self.attitude.conjugate();
        Self { position: -attitude.to_space(&self.position), attitude }
    }

    /// A constant pose in another scalar: all derivatives zero, the same in every lane.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::BodyPose;
    /// use piola_numerics::Dual;
    /// let pose: BodyPose<Dual<f64>> = BodyPose::constant(&BodyPose::at_rest());
    /// assert_eq!(pose.position.x.tangent, 0.0);
    /// ```
    #[must_use]
    pub fn constant(pose: &BodyPose<f64>) -> Self {
        Self { position: pose.position.map(T::lit), attitude: Attitude::constant(pose.attitude) }
    }
}

/// A rate of change of a body's place: along time a velocity, along a coordinate a tangent vector `h_Δ`.
///
/// # Example
/// ```
/// use piola_kinematics::BodyVelocity;
/// assert_eq!(BodyVelocity::<f64>::at_rest().angular_velocity.x, 0.0);
/// ```
///
/// # Source
/// W(2.13), W(3.5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyVelocity<T: Real> {
    /// v^c, or ∂x^c/∂q^Δ (space components).
    pub velocity: Vector3<T>,
    /// ω, or `ω_Δ` (body components).
    pub angular_velocity: Vector3<T>,
}

impl<T: Real> BodyVelocity<T> {
    /// No motion.
    ///
    /// # Example
    /// See [`BodyVelocity`].
    #[must_use]
    pub fn at_rest() -> Self {
        Self { velocity: Vector3::zeros(), angular_velocity: Vector3::zeros() }
    }
}

/// The motion of a body: place, velocity and acceleration.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::BodyMotion;
/// // A wheel of radius 2 m rolls at 6 m/s: its lowest point rests, its highest moves at 12 m/s.
/// let mut wheel = BodyMotion::at_rest();
/// wheel.velocity.x = 6.0;
/// wheel.angular_velocity.y = 3.0;
/// assert_eq!(wheel.velocity_of_point(&Vector3::new(0.0, 0.0, -2.0)).x, 0.0);
/// assert_eq!(wheel.velocity_of_point(&Vector3::new(0.0, 0.0, 2.0)).x, 12.0);
/// ```
///
/// # Source
/// W(2.10–2.19).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMotion<T: Real> {
    /// x^c (m, space components).
    pub position: Vector3<T>,
    /// Body to space.
    pub attitude: Attitude<T>,
    /// v^c (m/s, space components).
    pub velocity: Vector3<T>,
    /// ω (rad/s, body components).
    pub angular_velocity: Vector3<T>,
    /// a^c (m/s², space components).
    pub acceleration: Vector3<T>,
    /// ω̇ (rad/s², body components).
    pub angular_acceleration: Vector3<T>,
}

impl<T: Real> BodyMotion<T> {
    /// No motion, at the origin, body axes along the space axes.
    ///
    /// # Example
    /// See [`BodyMotion`].
    #[must_use]
    pub fn at_rest() -> Self {
        let zero = Vector3::zeros();
        Self {
            position: zero,
            attitude: Attitude::identity(),
            velocity: zero,
            angular_velocity: zero,
            acceleration: zero,
            angular_acceleration: zero,
        }
    }

    /// Space components of the velocity of the body's point y (body components from the centre of mass).
    ///
    /// ```text
    /// v^p = v^c + ω×r^{cp}
    /// ```
    ///
    /// # Example
    /// See [`BodyMotion`].
    ///
    /// # Source
    /// W(2.19).
    #[must_use]
    pub fn velocity_of_point(&self, y: &Vector3<T>) -> Vector3<T> {
        self.velocity + self.attitude.to_space(&cross(&self.angular_velocity, y))
    }

    /// Space components of the acceleration of the body's point y (body components from the centre of mass).
    ///
    /// ```text
    /// a^p = a^c + ω̇×r^{cp} + ω×(ω×r^{cp})
    /// ```
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::BodyMotion;
    /// let mut wheel = BodyMotion::at_rest();
    /// wheel.angular_velocity.y = 3.0;
    /// assert_eq!(wheel.acceleration_of_point(&Vector3::new(0.0, 0.0, 2.0)).z, -18.0); // ω² r inwards
    /// ```
    ///
    /// # Source
    /// W(2.19), differentiated.
    #[must_use]
    pub fn acceleration_of_point(&self, y: &Vector3<T>) -> Vector3<T> {
        let omega = &self.angular_velocity;
        let in_body = cross(&self.angular_acceleration, y) + cross(omega, &cross(omega, y));
        self.acceleration + self.attitude.to_space(&in_body)
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
