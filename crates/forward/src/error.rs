//! Errors of flows and specimens.

use piola_charts::ChartsError;
#[cfg(feature = "specimens")]
use piola_fit::FitError;
use piola_measured::MeasuredError;
#[cfg(feature = "specimens")]
use piola_solutions::SolutionsError;
#[cfg(feature = "specimens")]
use piola_specimens::SpecimensError;
use piola_viscometry::ViscometryError;

/// Why a flow cannot be solved, or a specimen not loaded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ForwardError {
    /// An argument is not accepted.
    #[error("`{argument}` is not accepted; valid: {valid}")]
    Argument {
        /// The argument.
        argument: String,
        /// The valid arguments in words.
        valid: &'static str,
    },
    /// The text or the file names no fluid, or the fluid refuses one of its parameters.
    #[error("`{argument}` is no fluid: {cause}")]
    Fluid {
        /// The argument.
        argument: String,
        /// The reason, in words.
        cause: String,
    },
    /// The text or the file names no solid, or the solid refuses one of its parameters.
    #[cfg(feature = "specimens")]
    #[error("`{argument}` is no solid: {cause}")]
    Solid {
        /// The argument.
        argument: String,
        /// The reason, in words.
        cause: String,
    },
    /// A flow lacks one of its sizes.
    #[error("{name} is not given; valid: --{} with a number and its unit", name.replace('_', "-"))]
    MissingSize {
        /// The size.
        name: String,
    },
    /// A file cannot be read.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// A law is refused.
    #[cfg(feature = "specimens")]
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A flow or its fluid is refused.
    #[error(transparent)]
    Viscometry(#[from] ViscometryError),
    /// A specimen or its path is refused.
    #[cfg(feature = "specimens")]
    #[error(transparent)]
    Specimens(#[from] SpecimensError),
    /// A twisted rod is refused.
    #[cfg(feature = "specimens")]
    #[error(transparent)]
    Solutions(#[from] SolutionsError),
    /// The results cannot be written.
    #[error(transparent)]
    Charts(#[from] ChartsError),
}
