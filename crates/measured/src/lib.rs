//! Laws of solids and fluids from tables of measurements: files in, parameters, tables and figures out.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod comparison;
mod error;
pub mod fitting;
#[cfg(feature = "history")]
pub mod history;
mod measured_tests;
#[cfg(feature = "nonlinear")]
pub mod nonlinear;
pub mod rheology;
mod sheet;
pub mod sides;
pub mod spectra;
mod written;

/// What other crates of Piola use; no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::sheet::{read, spelled};
    pub use crate::written::{written_fluid, written_solid};
}

pub use error::MeasuredError;
pub use measured_tests::MeasuredTests;
