//! Fields and motions over bodies, their derivatives and integrals.
//!
//! | to | use |
//! |---|---|
//! | state a motion x(X, t) and differentiate it | [`motion`], from samples [`sampled`] |
//! | pass between particles and places | [`frames`] |
//! | differentiate in cylindrical, spherical or other coordinates | [`coordinates`] |
//! | see what a stress and a force leave of a balance at a point | [`balance`] |
//! | tell whether strains fit together | [`compatibility`] |
//! | integrate over bodies | [`integral`] |

pub mod balance;
pub mod compatibility;
pub mod coordinates;
mod field;
pub mod frames;
pub mod integral;
pub mod motion;
#[cfg(feature = "serde")]
mod reading;
mod residual;
pub mod sampled;
pub(crate) mod value;

pub use balance::{Body, Flow, equilibrium_residual, symmetry_residual};
pub use coordinates::{Cartesian, Coordinates, Cylindrical, LocalBasis, PhysicalFrame, Spherical};
pub use field::{Field, Uniform, ValueOf};
pub use frames::{Eulerian, Following, Inversion, Material, Preimage, Spatial};
pub use motion::{Affine, AffineHistory, Homogeneous, Motion, Rigid, RigidHistory};
pub use residual::{Residual, VectorResidual};
pub use sampled::{Interpolation, MotionSamples, SampledMotion, SampledTrajectories};
pub use value::{FieldValue, TensorValue};
