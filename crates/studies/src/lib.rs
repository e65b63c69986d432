//! Studies of single problems in mechanics: plain data, and a function `run` that returns the results.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

#[cfg(feature = "solutions")]
pub mod balloon;
#[cfg(feature = "solutions")]
pub mod bending;
#[cfg(feature = "spectral")]
pub mod boxes;
#[cfg(feature = "solutions")]
pub mod dislocation;
pub mod fronts;
#[cfg(feature = "solutions")]
pub mod laminated_tube;
#[cfg(feature = "solutions")]
mod law;
mod observer;
mod plane_samples;
#[cfg(feature = "robots")]
pub mod robot;
pub mod room;
#[cfg(feature = "solutions")]
mod stresses;
#[cfg(feature = "solutions")]
pub mod torsion;

#[cfg(feature = "solutions")]
pub use law::RubberLaw;
pub use observer::{Observer, StudyCheckpointKeeper};
pub use piola_simulation::Outcome;
pub use plane_samples::PlaneSamples;
#[cfg(feature = "solutions")]
pub use stresses::StressAt;

/// What other crates of Piola use; no part of the interface.
#[doc(hidden)]
pub mod internal {
    #[cfg(feature = "spectral")]
    pub use crate::boxes::map::{MOST_ROWS, middle_height, points_with_stride, size_at, stride_of};
    #[cfg(feature = "solutions")]
    pub use crate::laminated_tube::pressure::{HeldTube, PressureRefusal};
}
