//! Fields and motions over bodies, their derivatives and integrals.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod balance;
pub mod compatibility;
pub mod coordinates;
mod error;
mod field;
pub mod frames;
pub mod integral;
mod integrand;
pub mod motion;
#[cfg(feature = "serde")]
mod reading;
mod residual;
pub mod sampled;
pub(crate) mod value;

pub use balance::{Body, Flow, equilibrium_residual, symmetry_residual};
pub use coordinates::{Cartesian, Coordinates, Cylindrical, LocalBasis, PhysicalFrame, Spherical};
pub use error::FieldsError;
pub use field::{Field, Uniform, ValueOf};
pub use frames::{Eulerian, Following, Inversion, Material, Preimage, Spatial};
pub use motion::{Affine, AffineHistory, Homogeneous, Motion, Rigid, RigidHistory};
pub use residual::{Residual, VectorResidual};
pub use sampled::{Interpolation, MotionSamples, SampledMotion, SampledTrajectories};
pub use value::{FieldValue, TensorValue};

/// What only Piola's own crates need: splines along one axis.
#[doc(hidden)]
pub mod internal {
    pub use crate::sampled::spline::{Axis, Factors, WIDTH};
}
