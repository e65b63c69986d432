//! Trees of rigid bodies in linear time.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![expect(clippy::doc_markdown, reason = "symbols with indices, as S_ω, are not code")]
#![expect(clippy::needless_range_loop, reason = "the indices are those of the equations")]

mod articulation;
mod batch;
mod configuration;
mod coriolis;
mod derivatives;
mod elementary;
mod error;
mod factorisation;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
mod files;
mod forward_dynamics;
mod freedoms;
mod group;
mod inverse_dynamics;
mod jacobian;
mod joint_forces;
mod kept;
mod kinematics;
mod link;
mod loops;
mod mass_matrix;
#[cfg(feature = "mjcf")]
mod mjcf;
mod momentum;
mod motion;
mod reactions;
mod regressor;
mod slopes;
mod space;
mod spatial;
mod tree;
mod turn;
#[cfg(feature = "urdf")]
mod urdf;
mod variational;
mod workspace;

pub use batch::{BatchWorkspace, DerivativeBlocks, StateBlocks};
pub use derivatives::AccelerationDerivatives;
pub use error::{FileFault, MultibodyError};
pub use factorisation::TreeFactors;
#[cfg(all(feature = "urdf", feature = "mjcf"))]
pub use files::RobotFile;
#[cfg(any(feature = "urdf", feature = "mjcf"))]
pub use files::{FileInertias, Visual, VisualShape};
pub use group::TreeGroup;
pub use inverse_dynamics::AppliedWrench;
pub use joint_forces::JointPowers;
pub use kept::{DynamicsCounts, KeptDynamics, KeptMassMatrix, UpdateCounts};
pub use kinematics::{FrameAcceleration, FramePlace, FrameVelocity};
pub use loops::{BodyPoint, ClosedMotion, ClosedTree, LoopClosure, LoopWorkspace};
#[cfg(feature = "mjcf")]
pub use mjcf::{FileMotor, Mjcf, MjcfOptions, SkippedElement};
pub use momentum::{CentroidalMomentum, MassCentre, TreeEnergies};
pub use motion::TreeMotion;
pub use piola_kinematics::SingularPosition;
pub use reactions::JointReaction;
pub use regressor::INERTIAL_PARAMETERS;
pub use tree::{
    BodyIndex, BodyInertia, FrameIndex, JointKind, JointPlace, RigidTree, RigidTreeBuilder, TreeJoint, TreePlan,
};
#[cfg(feature = "urdf")]
pub use urdf::{Mimic, Urdf, UrdfBase, UrdfOptions};
pub use variational::VariationalTree;
pub use workspace::TreeWorkspace;
