//! Trees of rigid bodies in linear time.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod batch;
mod configuration;
mod coriolis;
mod derivatives;
mod error;
mod factorisation;
mod forward_dynamics;
mod inverse_dynamics;
mod jacobian;
mod kinematics;
mod link;
mod mass_matrix;
mod momentum;
mod regressor;
mod space;
mod spatial;
mod tree;
mod turn;
#[cfg(feature = "urdf")]
mod urdf;
mod workspace;

pub use batch::{BatchWorkspace, StateBlocks};
pub use derivatives::AccelerationDerivatives;
pub use error::{MultibodyError, UrdfFault};
pub use factorisation::TreeFactors;
pub use inverse_dynamics::AppliedWrench;
pub use kinematics::{FrameAcceleration, FramePlace, FrameVelocity};
pub use momentum::{CentroidalMomentum, MassCentre, TreeEnergies};
pub use regressor::INERTIAL_PARAMETERS;
pub use tree::{BodyIndex, BodyInertia, FrameIndex, JointKind, JointPlace, RigidTree, RigidTreeBuilder, TreeJoint};
#[cfg(feature = "urdf")]
pub use urdf::{Mimic, Urdf, UrdfBase, UrdfInertias, UrdfOptions};
pub use workspace::TreeWorkspace;
