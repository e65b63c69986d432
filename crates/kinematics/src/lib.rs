//! The kinematics of particles and rigid bodies.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod attitude;
mod error;
pub mod inertia;
pub mod placement;
pub mod rigid_body;
mod vector;

pub use attitude::Attitude;
pub use error::KinematicsError;
pub use inertia::Inertia;
pub use placement::{Holonomic, Placement};
pub use rigid_body::RigidBody;
