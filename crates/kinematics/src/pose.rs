//! The pose of a body in glam's types, for hot loops and for graphics at the edge.
//!
//! ```text
//! x_space = translation + rotation · x_body
//! ```
//!
//! glam stores quaternions as (x, y, z, w); the conversions here take care of the order.

use glam::{DQuat, DVec3};
use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::rigid_body::BodyPose;

/// Place and attitude of a body: `x_space = translation + rotation x_body`.
///
/// # Example
/// ```
/// use glam::{DQuat, DVec3};
/// use piola_kinematics::Pose;
/// let pose = Pose { translation: DVec3::new(1.0, 0.0, 0.0), rotation: DQuat::IDENTITY };
/// assert_eq!(pose.to_space(DVec3::Y), DVec3::new(1.0, 1.0, 0.0));
/// ```
///
/// # Source
/// W(2.10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// x^c (m).
    pub translation: DVec3,
    /// Body to space, of length one.
    pub rotation: DQuat,
}

impl Pose {
    /// At the origin, body axes along the space axes.
    pub const IDENTITY: Self = Self { translation: DVec3::ZERO, rotation: DQuat::IDENTITY };

    /// Where a point of the body is in space (m).
    #[inline]
    #[must_use]
    pub fn to_space(self, in_body: DVec3) -> DVec3 {
        self.translation + self.rotation * in_body
    }

    /// Where a point of space is in the body (m).
    #[inline]
    #[must_use]
    pub fn to_body(self, in_space: DVec3) -> DVec3 {
        self.rotation.conjugate() * (in_space - self.translation)
    }

    /// The pose of a body whose pose relative to this one is `other`.
    #[inline]
    #[must_use]
    pub fn product(self, other: Self) -> Self {
        Self { translation: self.to_space(other.translation), rotation: self.rotation * other.rotation }
    }

    /// The pose that undoes this one.
    #[inline]
    #[must_use]
    pub fn inverse(self) -> Self {
        let rotation = self.rotation.conjugate();
        Self { translation: rotation * -self.translation, rotation }
    }
}

impl From<Attitude<f64>> for DQuat {
    fn from(attitude: Attitude<f64>) -> Self {
        Self::from_xyzw(attitude.x, attitude.y, attitude.z, attitude.w)
    }
}

impl From<DQuat> for Attitude<f64> {
    /// `rotation` must have length one, as all of glam's rotations have.
    fn from(rotation: DQuat) -> Self {
        Self { w: rotation.w, x: rotation.x, y: rotation.y, z: rotation.z }
    }
}

impl From<BodyPose<f64>> for Pose {
    fn from(pose: BodyPose<f64>) -> Self {
        let x = pose.position;
        Self { translation: DVec3::new(x.x, x.y, x.z), rotation: pose.attitude.into() }
    }
}

impl From<Pose> for BodyPose<f64> {
    fn from(pose: Pose) -> Self {
        let x = pose.translation;
        Self { position: Vector3::new(x.x, x.y, x.z), attitude: pose.rotation.into() }
    }
}
