//! Parameters of laws from measurements.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
#[cfg(feature = "fluids")]
pub mod fluids;
mod outcome;
#[cfg(any(feature = "fluids", feature = "solids"))]
mod search;
#[cfg(feature = "solids")]
pub mod sides;
#[cfg(feature = "solids")]
pub mod solids;
mod state;
mod statistics;

pub use error::FitError;
pub use outcome::Outcome;
pub use state::State;
pub use statistics::{Autocorrelation, Covariance, Criteria, Intervals, student};
