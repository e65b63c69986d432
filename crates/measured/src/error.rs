//! Errors of measurements.

use std::path::PathBuf;

use piola_charts::ChartsError;
use piola_fit::FitError;
use piola_spectra::SpectraError;
use piola_viscometry::ViscometryError;

use crate::fitting::TableReport;

/// Why measurements cannot be read or fitted, or results cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredError {
    /// The file cannot be opened or read.
    #[error("cannot read `{}`: {cause}", path.display())]
    Unreadable {
        /// The path as given.
        path: PathBuf,
        /// The operating system's word.
        cause: String,
    },
    /// The file is larger than tables may be.
    #[error("`{}` has {bytes} bytes or more; a table has at most {most}", path.display())]
    TooLarge {
        /// The path as given.
        path: PathBuf,
        /// How much of it was read.
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
    /// A finite-element program has no such law.
    #[error(
        "{program} has no card of {law}; laws with cards are neo-hookean, mooney-rivlin, yeoh, polynomial:n and ogden:n, and in \
         Abaqus van-der-waals, in Ansys extended-tube, in Abaqus and CalculiX hyperfoam:n"
    )]
    NoCard {
        /// The law.
        law: String,
        /// The program.
        program: String,
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
    /// Moduli have no spectrum.
    #[error(transparent)]
    Spectra(#[from] SpectraError),
    /// The results cannot be written.
    #[error(transparent)]
    Charts(#[from] ChartsError),
}
