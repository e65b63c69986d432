//! Parameters of laws from measurements.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

#[cfg(any(feature = "fluids", feature = "solids"))]
mod anew;
mod error;
#[cfg(any(feature = "solids", feature = "nonlinear"))]
mod estimates;
#[cfg(feature = "fluids")]
pub mod fluids;
#[cfg(feature = "history")]
pub mod history;
#[cfg(feature = "nonlinear")]
pub mod nonlinear;
mod outcome;
mod search;
#[cfg(feature = "solids")]
pub mod sides;
#[cfg(feature = "solids")]
pub mod solids;
mod state;
mod statistics;

/// What other crates of Piola use; no part of the interface.
#[doc(hidden)]
pub mod internal {
    #[cfg(any(feature = "fluids", feature = "solids"))]
    pub use crate::anew::{Again, Anew, Change, check_intervals};
    pub use crate::search::{End, Misfit, Range, minimise};
    #[cfg(feature = "solids")]
    pub use crate::sides::fit_sides_shifted;
}

pub use error::FitError;
pub use outcome::Outcome;
pub use state::State;
pub use statistics::{Autocorrelation, Covariance, Criteria, Intervals, student};
