//! Studies: scenes without a motion in time.
//!
//! | table | study | with |
//! |---|---|---|
//! | `[wavefront]` | [`Wavefront`]: fronts, rays and caustics in a medium | [`piola_hamiltonian::hamilton_jacobi`] |
//! | `[room]` | [`Room`]: first arrival of a signal in a room | [`piola_characteristics`] |
//!
//! They go the way of all scenes: a checked [`Study`] has a [`StudyPlan`], [`run`] makes a [`StudyRun`] of what was found,
//! and [`StudyRun::write`] leaves the summary, tables and figures. One that fails or is stopped keeps what it had found.

mod build;
mod plan;
pub mod room;
mod run;
pub mod wavefront;

pub use plan::StudyPlan;
pub use room::Room;
pub use run::{Findings, StudyRun, run};
pub use wavefront::Wavefront;

use crate::model::OutputRequest;

/// A study that has been checked.
#[derive(Debug, Clone)]
pub struct Study {
    /// Name, also of the default output folder.
    pub name: String,
    /// Title of figures.
    pub title: Option<String>,
    /// The subject.
    pub subject: Subject,
    /// The files to write.
    pub output: OutputRequest,
}

/// The subject of a study.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Subject {
    /// Wave fronts in a medium.
    Wavefront(Wavefront),
    /// First arrival of a signal in a room.
    Room(Room),
}
