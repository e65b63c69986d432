//! Errors of scenes.

use std::path::PathBuf;

use piola_fit::FitError;
use piola_viscometry::ViscometryError;

use crate::document::Report;
use crate::fitting::TableReport;

/// Why a scene cannot be read, checked, run or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be opened or read.
    #[error("cannot read `{}`: {cause}", path.display())]
    Unreadable {
        /// The path as given.
        path: PathBuf,
        /// The operating system's word.
        cause: String,
    },
    /// A folder was given where a file is needed.
    #[error("`{}` is a folder: give a scene file such as scenes/solar-system.toml", path.display())]
    Folder {
        /// The path as given.
        path: PathBuf,
    },
    /// The file is larger than scenes may be.
    #[error(
        "`{}` has {bytes} bytes; a scene has at most {most}: put large data in a table that the scene names",
        path.display()
    )]
    TooLarge {
        /// The path as given.
        path: PathBuf,
        /// Its size.
        bytes: u64,
        /// The largest size.
        most: u64,
    },
    /// The file is not UTF-8 text.
    #[error("`{}` is not a text file: byte {byte:#04x} at line {line}, column {column} is not UTF-8 text", path.display())]
    NotText {
        /// The path as given.
        path: PathBuf,
        /// Line of the byte, from 1.
        line: usize,
        /// Column of the byte, from 1.
        column: usize,
        /// The byte.
        byte: u8,
    },
    /// The scene has mistakes; all of them.
    #[error("{0}")]
    Invalid(Report),
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
    /// A table of measurements has mistakes; all of them.
    #[error("{0}")]
    Table(TableReport),
    /// An argument of a fit is not accepted.
    #[error("`{argument}` is not accepted; valid: {valid}")]
    Argument {
        /// The argument.
        argument: String,
        /// The valid arguments in words.
        valid: &'static str,
    },
    /// A weight is given to a test that is not in the data.
    #[error("no test is called `{name}`; the tests are: {}", tests.join(", "))]
    NoSuchTest {
        /// The name.
        name: String,
        /// The tests.
        tests: Vec<String>,
    },
    /// A law or its data are refused.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A fluid or its data are refused.
    #[error(transparent)]
    Viscometry(#[from] ViscometryError),
}
