//! Tests of one material that were read from a file.

use std::path::{Path, PathBuf};

use crate::MeasuredError;
use crate::fitting::{TableMistake, TableReport};
use crate::sheet::read;

/// Tests of one material, read from a file: of [`SidesTest`](piola_fit::sides::SidesTest), or of laws with history.
///
/// # Example
/// See [`SidesMeasurements`](crate::sides::SidesMeasurements).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeasuredTests<T> {
    /// The file.
    pub path: PathBuf,
    /// The unit of the stresses, as the file names it.
    pub unit: Option<String>,
    /// The tests.
    pub tests: Vec<T>,
    /// What was read in a way that a reader must know, as sentences without a full stop.
    pub notes: Vec<String>,
}

/// Unit, tests and notes of a table.
pub(crate) type TestsAndNotes<T> = (Option<String>, Vec<T>, Vec<String>);

/// A kind of test that a table can hold.
pub trait Tabulated: Sized {
    /// Unit, tests and notes of the text of a table.
    ///
    /// # Errors
    /// Every mistake, with its line.
    fn tests(text: &str) -> Result<TestsAndNotes<Self>, Vec<TableMistake>>;
}

impl<T: Tabulated> MeasuredTests<T> {
    /// Reads a file.
    ///
    /// # Errors
    /// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`]; [`MeasuredError::Table`] with every
    /// mistake and its line.
    pub fn load(path: &Path) -> Result<Self, MeasuredError> {
        Self::parse(path, &read(path)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MeasuredError::Table`].
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self, MeasuredError> {
        let path = path.into();
        match T::tests(text) {
            Ok((unit, tests, notes)) => Ok(Self { path, unit, tests, notes }),
            Err(mistakes) => Err(MeasuredError::Table(TableReport::new(path, mistakes))),
        }
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }
}
