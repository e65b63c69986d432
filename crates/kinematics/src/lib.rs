//! The kinematics of particles and rigid bodies.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod attitude;
pub mod curve;
mod elliptic;
mod error;
pub mod euler_angles;
#[cfg(feature = "serde")]
mod finite;
mod free_rotation;
mod heavy_top;
pub mod inertia;
pub mod mesh;
pub mod particle;
pub mod placement;
#[cfg(feature = "glam")]
pub mod pose;
pub mod rigid_body;
pub mod rotation_vector;
mod singular_positions;
pub mod solids;
pub mod system;
pub mod twist;
mod vector;

pub use attitude::Attitude;
pub use error::KinematicsError;
pub use euler_angles::{EulerAngles, EulerChart, EulerSequence};
pub use free_rotation::FreeRotation;
pub use heavy_top::HeavyTop;
pub use inertia::Inertia;
pub use placement::{Holonomic, Placement};
#[cfg(feature = "glam")]
pub use pose::Pose;
pub use rigid_body::{BodyMotion, BodyPose, BodyVelocity, RigidBody};
pub use rotation_vector::RotationVector;
pub use singular_positions::SingularPosition;
pub use solids::Solid;
pub use system::ParticleSystem;
pub use twist::{BodyTwist, SpaceTwist};

/// For the other crates of Piola alone: no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::singular_positions::Passages;
}
