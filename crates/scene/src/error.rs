//! Errors of scenes.

use std::path::PathBuf;

use piola_charts::ChartsError;
use piola_document::{DocumentError, Report};
use piola_simulation::SimulationError;

/// Why a scene cannot be read, checked, run or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// There is no text to check.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// The scene has mistakes; all of them.
    #[error("{0}")]
    Invalid(Report),
    /// The results cannot be written.
    #[error(transparent)]
    Charts(#[from] ChartsError),
    /// The run cannot go on from the checkpoint.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// The motion cannot be run.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

/// Why a run cannot go on from the checkpoint in the folder of its results.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file cannot be read.
    #[error("the checkpoint `{}` cannot be read: {cause}; without --resume the run begins anew", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        cause: String,
    },
    /// It belongs to another run.
    #[error("`{}`: {cause}; without --resume the run begins anew", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What differs.
        cause: SimulationError,
    },
}
