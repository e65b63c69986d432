//! Errors of writing.

use std::path::PathBuf;

/// Why results cannot be written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ChartsError {
    /// The output folder cannot be made or written to.
    #[error("cannot write to the output folder `{}`: {cause}", path.display())]
    UnwritableFolder {
        /// The folder.
        path: PathBuf,
        /// The operating system's word.
        cause: String,
    },
    /// A file could not be written.
    #[error("cannot write `{}`: {cause}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// The operating system's word.
        cause: String,
    },
}
