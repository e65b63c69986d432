//! Laws of solids and fluids from tables of measurements: files in, parameters, tables and figures out.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod comparison;
mod error;
pub mod fitting;
pub mod forward;
pub mod rheology;
mod sheet;
pub mod sides;

pub use error::MeasuredError;
