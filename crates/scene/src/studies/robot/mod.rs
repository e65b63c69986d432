//! The motion of a tree of rigid bodies from a URDF or MJCF file: [`piola_studies::robot`] follows it.

mod build;
mod figure;
mod gltf;
mod plan;
mod results;

pub use piola_studies::robot::{JointDrive, RobotCheckpoint, RobotMotion, RobotSample, RobotStudy};

pub(super) use plan::plan;
pub(super) use results::{file, results};
