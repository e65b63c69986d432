//! Studies: scenes without `[time]`.
//!
//! | table | study | computed by |
//! |---|---|---|
//! | `[wavefront]` | [`Wavefront`]: fronts, rays and caustics in a medium | [`piola_studies::fronts`] |
//! | `[room]` | [`Room`]: first arrival of a signal in a room | [`piola_studies::room`] |
//! | `[balloon]` | `Balloon`: an inflated spherical shell | `piola_studies::balloon` |
//! | `[torsion]` | `TwistedRod`: a twisted rod or tube, with and without axial force | `piola_studies::torsion` |
//! | `[bending]` | `BentBlockStudy`: a block bent by couples | `piola_studies::bending` |
//! | `[dislocation]` | `ScrewDislocations`: circuits in a crystal with screws | `piola_studies::dislocation` |
//! | `[laminated_tube]` | `LayeredTube`: a tube with residual stress | `piola_studies::laminated_tube` |
//! | `[box]` | `BoxStudy`: elastic and viscous fields on a rectangle or a box | `piola_studies::boxes` |
//! | `[robot]` | `RobotStudy`: the motion of a tree of bodies from a URDF or MJCF file | `piola_studies::robot` |
//!
//! `[balloon]`, `[torsion]`, `[bending]`, `[dislocation]` and `[laminated_tube]` need the feature `solutions`, `[box]` needs
//! `spectral`, `[robot]` needs `robots`.
//!
//! They go the way of all scenes: a checked [`Study`] has a [`StudyPlan`], [`run`] makes a [`StudyRun`] of what was found,
//! and [`StudyRun::write`] leaves the summary, tables and figures. One that fails or is stopped keeps what it had found.

#[cfg(feature = "solutions")]
pub mod balloon;
#[cfg(feature = "solutions")]
pub mod bending;
#[cfg(feature = "spectral")]
pub mod boxes;
mod build;
#[cfg(feature = "solutions")]
pub mod dislocation;
#[cfg(feature = "solutions")]
pub mod laminated_tube;
#[cfg(feature = "solutions")]
mod law;
#[cfg(feature = "solutions")]
mod limits;
#[cfg(any(feature = "solutions", feature = "spectral", feature = "robots"))]
#[cfg_attr(not(any(feature = "solutions", feature = "spectral")), expect(dead_code, reason = "robots need less of it"))]
mod panel;
mod plan;
#[cfg(feature = "robots")]
pub mod robot;
pub mod room;
mod run;
mod samples;
#[cfg(feature = "solutions")]
mod solid;
#[cfg(feature = "solutions")]
mod stresses;
#[cfg(feature = "solutions")]
pub mod torsion;
pub mod wavefront;

#[cfg(feature = "solutions")]
pub use self::{
    balloon::Balloon,
    bending::BentBlockStudy,
    dislocation::ScrewDislocations,
    laminated_tube::LayeredTube,
    solid::{SolidFindings, SolidStudy},
    torsion::TwistedRod,
};

#[cfg(feature = "solutions")]
pub use piola_studies::{RubberLaw, StressAt};

#[cfg(feature = "spectral")]
pub use boxes::BoxStudy;
pub use plan::StudyPlan;
#[cfg(feature = "robots")]
pub use robot::RobotStudy;
pub use room::Room;
pub use run::{Findings, StudyRun, checkpoint_time, has_checkpoints, run, run_with_checkpoints};
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
    /// A balloon, a rod, a block, a crystal or a tube.
    #[cfg(feature = "solutions")]
    Solid(SolidStudy),
    /// Elastic or viscous fields on a rectangle or a box.
    #[cfg(feature = "spectral")]
    Box(Box<BoxStudy>),
    /// The motion of a tree of bodies.
    #[cfg(feature = "robots")]
    Robot(Box<RobotStudy>),
}
