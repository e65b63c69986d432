//! Elastic and viscous fields on a rectangle or a box: [`piola_studies::boxes`] computes them.

mod build;
mod figure;
mod map;
mod plan;
mod results;
mod tables;

pub use piola_studies::boxes::{
    BoxCheckpoint, BoxFields, BoxFindings, BoxStudy, FlowHistory, FlowInstant, FlowTask, Form, Found, Load, MOST_BYTES,
    MOST_STEPS, MotionHistory, MotionInstant, MotionTask, Probe, Start, StaticField, StaticTask, Task, resolved,
};

pub(super) use plan::plan;
pub(super) use results::results;
pub(super) use tables::file;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];
