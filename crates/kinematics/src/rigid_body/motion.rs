//! Pose, velocity and motion of a rigid body, and of the points embedded in it.
//!
//! ```text
//! x^p = x^c + yⁱ f_i      v^p = v^c + ω×r^{cp}      a^p = a^c + ω̇×r^{cp} + ω×(ω×r^{cp})
//! ```
//!
//! # References
//! W(2.10–2.19).

use nalgebra::Vector3;
use piola_numerics::Real;

use crate::attitude::Attitude;
use crate::vector::cross;

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
#[doc(alias("rigid transform", "isometry", "SE(3)"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        deny_unknown_fields,
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct BodyPose<T: Real> {
    /// x^c (m, space components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub position: Vector3<T>,
    /// Body to space.
    pub attitude: Attitude<T>,
}

impl<T: Real> BodyPose<T> {
    /// At the origin, body axes along the space axes.
    #[must_use]
    pub fn at_rest() -> Self {
        Self { position: Vector3::zeros(), attitude: Attitude::identity() }
    }

    /// Where a point of the body is: `x^p = x^c + yⁱ f_i`, y in body components (m).
    ///
    /// # Source
    /// W(2.10).
    #[must_use]
    pub fn embedded_point(&self, y: &Vector3<T>) -> Vector3<T> {
        self.position + self.attitude.to_space(y)
    }

    /// Which point of the body is at the place x of space: yⁱ = (x − x^c)·`f_i`, in body components (m).
    ///
    /// # Source
    /// W(2.10), inverted.
    #[must_use]
    pub fn point_in_body(&self, x: &Vector3<T>) -> Vector3<T> {
        self.attitude.to_body(&(x - self.position))
    }

    /// The pose in space of something whose pose in this body is `other`.
    #[must_use]
    pub fn product(&self, other: &Self) -> Self {
        Self { position: self.embedded_point(&other.position), attitude: self.attitude.product(other.attitude) }
    }

    /// The pose of space in the body, which undoes this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let attitude = self.attitude.conjugate();
        Self { position: -attitude.to_space(&self.position), attitude }
    }

    /// A constant pose in another scalar: all derivatives zero, the same in every lane.
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        deny_unknown_fields,
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct BodyVelocity<T: Real> {
    /// v^c, or ∂x^c/∂q^Δ (space components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub velocity: Vector3<T>,
    /// ω, or `ω_Δ` (body components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub angular_velocity: Vector3<T>,
}

impl<T: Real> BodyVelocity<T> {
    /// No motion.
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        deny_unknown_fields,
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct BodyMotion<T: Real> {
    /// x^c (m, space components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub position: Vector3<T>,
    /// Body to space.
    pub attitude: Attitude<T>,
    /// v^c (m/s, space components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub velocity: Vector3<T>,
    /// ω (rad/s, body components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub angular_velocity: Vector3<T>,
    /// a^c (m/s², space components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub acceleration: Vector3<T>,
    /// ω̇ (rad/s², body components).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub angular_acceleration: Vector3<T>,
}

impl<T: Real> BodyMotion<T> {
    /// No motion, at the origin, body axes along the space axes.
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
    /// # Source
    /// W(2.19), differentiated.
    #[must_use]
    pub fn acceleration_of_point(&self, y: &Vector3<T>) -> Vector3<T> {
        let omega = &self.angular_velocity;
        let in_body = cross(&self.angular_acceleration, y) + cross(omega, &cross(omega, y));
        self.acceleration + self.attitude.to_space(&in_body)
    }
}
