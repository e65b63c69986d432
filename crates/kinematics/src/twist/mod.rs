//! Twists: the velocity of a body as one quantity, screws, and the exponential map of rigid motions.
//!
//! A pose g takes points of the body to space, x = x^c + yⁱ `f_i`. Its velocity is six numbers, the angular velocity
//! and the velocity of one embedded point. Which point, and along which basis, makes two kinds of twist:
//!
//! ```text
//! body   ξ_b = (ω_body, Qv^c)         the body's reference point, body components     g⁻¹ ġ = ξ_b^
//! space  ξ_s = (ω_space, v − ω×x^c)   the embedded point that is at the origin        ġ g⁻¹ = ξ_s^
//! ξ_s = Ad_g ξ_b,    Ad_g (ω, v) = (Rω, Rv + x^c × Rω),   R = Qᵀ
//! exp (ω, v) = rotation exp ω, translation Jᵀ(ω) v;    exp (Ad_g ξ) = g exp ξ g⁻¹
//! ```
//!
//! with J of [`rotation_vector`](crate::rotation_vector). The two kinds are two types, so that they are not
//! added to each other.
//!
//! Chains of joints are in [`product_of_exponentials`].
//!
//! # References
//! W(2.10–2.19).

mod chain;
mod screw;

use core::marker::PhantomData;

use nalgebra::{Matrix6, Vector3};
use piola_numerics::Real;

use crate::rigid_body::{BodyPose, BodyVelocity};
use crate::rotation_vector::RotationVector;
use crate::vector::{cross, scaled};

pub use chain::{joint_twists_into, product_of_exponentials};
pub use screw::ScrewAxis;

/// Components along the body basis, the velocity that of the body's reference point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InBody;

/// Components along the space basis, the velocity that of the embedded point at the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InSpace;

/// An angular and a linear velocity (rad/s, m/s), or increments of them (rad, m); `F` says of what point and along
/// which basis.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{BodyPose, BodyTwist, BodyVelocity, SpaceTwist};
/// // Half a turn about the line through (1, 0, 0) along z carries the origin to (2, 0, 0).
/// let joint = SpaceTwist::revolute(&Vector3::x(), &Vector3::z())?;
/// let there = joint.scaled(std::f64::consts::PI).exponential().position;
/// assert!((there - Vector3::new(2.0, 0.0, 0.0)).amax() <= 2.0 * f64::EPSILON);
/// // A wheel of radius 1 m that rolls along x, its contact at the origin: that point rests, the centre moves.
/// let pose = BodyPose { position: Vector3::<f64>::z(), ..BodyPose::at_rest() };
/// let rolling = BodyVelocity { velocity: Vector3::x(), angular_velocity: Vector3::y() };
/// assert_eq!(SpaceTwist::of_motion(&pose, &rolling).linear, Vector3::zeros());
/// assert_eq!(BodyTwist::of_motion(&pose, &rolling).linear, Vector3::x());
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(2.13), W(2.19).
#[doc(alias("spatial velocity", "motion vector", "screw", "se(3)"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        deny_unknown_fields,
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct Twist<T: Real, F> {
    /// ω.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub angular: Vector3<T>,
    /// v.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub linear: Vector3<T>,
    #[cfg_attr(feature = "serde", serde(skip))]
    frame: PhantomData<F>,
}

/// The twist of a body in body components, of its reference point.
///
/// # Example
/// See [`Twist`].
pub type BodyTwist<T> = Twist<T, InBody>;

/// The twist of a body in space components, of its point at the origin.
///
/// # Example
/// See [`Twist`].
pub type SpaceTwist<T> = Twist<T, InSpace>;

impl<T: Real, F> Twist<T, F> {
    /// A twist of the given angular and linear velocity.
    #[inline]
    #[must_use]
    pub const fn new(angular: Vector3<T>, linear: Vector3<T>) -> Self {
        Self { angular, linear, frame: PhantomData }
    }

    /// No motion.
    #[inline]
    #[must_use]
    pub fn at_rest() -> Self {
        Self::new(Vector3::zeros(), Vector3::zeros())
    }

    /// A constant twist in another scalar: all derivatives zero, the same in every lane.
    #[inline]
    #[must_use]
    pub fn constant(twist: &Twist<f64, F>) -> Self {
        Self::new(twist.angular.map(T::lit), twist.linear.map(T::lit))
    }

    /// The twist times a number.
    #[inline]
    #[must_use]
    pub fn scaled(&self, factor: T) -> Self {
        Self::new(scaled(&self.angular, factor), scaled(&self.linear, factor))
    }

    /// The sum of two twists of one kind.
    #[inline]
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self::new(self.angular + other.angular, self.linear + other.linear)
    }

    /// The pose reached in unit time at constant twist from the pose of no displacement.
    ///
    /// ```text
    /// exp (ω, v) = (exp ω, Jᵀ(ω) v)
    /// ```
    ///
    /// A body at g that moves at constant `ξ_b` is after the time t at g exp(t `ξ_b`), at constant `ξ_s` at
    /// exp(t `ξ_s`) g.
    ///
    /// # Accuracy
    /// A few ulps of |v|, at any angle.
    #[must_use]
    pub fn exponential(&self) -> BodyPose<T> {
        let turn = RotationVector(self.angular);
        BodyPose { position: turn.angular_velocity_in_space(&self.linear), attitude: turn.attitude() }
    }

    /// The twist of least angle, |ω| ≤ π, that leads to a pose in unit time: the inverse of
    /// [`exponential`](Twist::exponential).
    ///
    /// # Accuracy
    /// A few ulps of ω and of |x^c|; of a half turn one of the two axes ±ω.
    #[must_use]
    pub fn logarithm(pose: &BodyPose<T>) -> Self {
        let turn = RotationVector::of_attitude(pose.attitude);
        Self::new(turn.0, turn.rate_from_space(&pose.position))
    }

    /// The commutator [ξ, η] = (ω×ω′, ω×v′ − ω′×v): the rate of η as seen from a body that moves with ξ, but for
    /// the sign.
    ///
    /// ```text
    /// d/dt Ad_{exp(tξ)} η = [ξ, η] at t = 0
    /// ```
    #[doc(alias = "Lie bracket")]
    #[must_use]
    pub fn commutator(&self, other: &Self) -> Self {
        let linear = cross(&self.angular, &other.linear) - cross(&other.angular, &self.linear);
        Self::new(cross(&self.angular, &other.angular), linear)
    }
}

impl<T: Real> BodyTwist<T> {
    /// The twist of a body at a pose with a velocity.
    ///
    /// # Source
    /// W(2.13).
    #[must_use]
    pub fn of_motion(pose: &BodyPose<T>, velocity: &BodyVelocity<T>) -> Self {
        Self::new(velocity.angular_velocity, pose.attitude.to_body(&velocity.velocity))
    }

    /// The velocity of the body at a pose.
    #[must_use]
    pub fn velocity(&self, pose: &BodyPose<T>) -> BodyVelocity<T> {
        BodyVelocity { velocity: pose.attitude.to_space(&self.linear), angular_velocity: self.angular }
    }

    /// The same motion as a twist of space: `ξ_s = Ad_g ξ_b`.
    #[must_use]
    pub fn in_space(&self, pose: &BodyPose<T>) -> SpaceTwist<T> {
        let angular = pose.attitude.to_space(&self.angular);
        SpaceTwist::new(angular, pose.attitude.to_space(&self.linear) + cross(&pose.position, &angular))
    }
}

impl<T: Real> SpaceTwist<T> {
    /// The twist of a body at a pose with a velocity.
    ///
    /// # Source
    /// W(2.19).
    #[must_use]
    pub fn of_motion(pose: &BodyPose<T>, velocity: &BodyVelocity<T>) -> Self {
        let angular = pose.attitude.to_space(&velocity.angular_velocity);
        Self::new(angular, velocity.velocity + cross(&pose.position, &angular))
    }

    /// The velocity of the body at a pose.
    #[must_use]
    pub fn velocity(&self, pose: &BodyPose<T>) -> BodyVelocity<T> {
        BodyVelocity {
            velocity: self.velocity_at(&pose.position),
            angular_velocity: pose.attitude.to_body(&self.angular),
        }
    }

    /// The velocity of the embedded point that is at the place x: v + ω×x (m/s).
    ///
    /// # Source
    /// W(2.19).
    #[inline]
    #[must_use]
    pub fn velocity_at(&self, x: &Vector3<T>) -> Vector3<T> {
        self.linear + cross(&self.angular, x)
    }

    /// The same motion as a twist of the body: `ξ_b = Ad_g⁻¹ ξ_s`.
    #[must_use]
    pub fn in_body(&self, pose: &BodyPose<T>) -> BodyTwist<T> {
        let linear = pose.attitude.to_body(&self.velocity_at(&pose.position));
        BodyTwist::new(pose.attitude.to_body(&self.angular), linear)
    }

    /// The twist carried along by a displacement g of space: `Ad_g ξ`, whose axis is the axis displaced.
    #[inline]
    #[must_use]
    pub fn displaced(&self, by: &BodyPose<T>) -> Self {
        BodyTwist::new(self.angular, self.linear).in_space(by)
    }
}

/// The matrix of `Ad_g` on (ω; v).
///
/// ```text
/// Ad_g = ⎡ R      0⎤    R = Qᵀ
///        ⎣ x^c×R  R⎦
/// ```
#[doc(alias("Ad", "spatial transform"))]
#[must_use]
pub fn adjoint<T: Real>(pose: &BodyPose<T>) -> Matrix6<T> {
    let mut matrix = Matrix6::zeros();
    for column in 0..6 {
        let mut unit = BodyTwist::at_rest();
        if column < 3 {
            unit.angular[column] = T::one();
        } else {
            unit.linear[column - 3] = T::one();
        }
        let SpaceTwist { angular, linear, .. } = unit.in_space(pose);
        for row in 0..3 {
            matrix[(row, column)] = angular[row];
            matrix[(row + 3, column)] = linear[row];
        }
    }
    matrix
}
