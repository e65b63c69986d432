//! Errors of documents.

use std::path::PathBuf;

/// Why there is no text to parse. Mistakes inside a text are collected in a [`Report`](crate::Report) instead.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DocumentError {
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
    #[error("{}:{line}:{column}: the file is not a text file: byte {byte:#04x}; valid: UTF-8 text", path.display())]
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
}
