//! Fields and motions over bodies, their derivatives and integrals.

pub mod integral;
pub mod motion;

pub use motion::{Affine, AffineHistory, Homogeneous, Motion, Rigid, RigidHistory};
