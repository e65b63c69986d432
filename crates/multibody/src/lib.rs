//! Trees of rigid bodies in linear time.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod error;
mod forward_dynamics;
mod inverse_dynamics;
mod link;
mod spatial;
mod tree;
mod turn;
mod workspace;

pub use error::MultibodyError;
pub use inverse_dynamics::AppliedWrench;
pub use tree::{BodyIndex, BodyInertia, FrameIndex, JointKind, JointPlace, RigidTree, RigidTreeBuilder, TreeJoint};
pub use workspace::TreeWorkspace;
