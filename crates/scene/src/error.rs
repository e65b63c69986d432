//! Errors of scenes.

use piola_charts::ChartsError;
use piola_document::{DocumentError, Report};

/// Why a scene cannot be read, checked, run or written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
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
}
