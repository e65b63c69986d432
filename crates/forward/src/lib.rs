//! Flows of any fluid and specimens of any solid, named in text.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

#[cfg(feature = "specimens")]
mod controls;
mod error;
mod flow;
mod fluid;
mod output;
mod quantity;
#[cfg(feature = "specimens")]
mod solid;
#[cfg(feature = "specimens")]
mod specimen;
#[cfg(feature = "specimens")]
mod specimen_output;

pub use error::ForwardError;
pub use flow::{Answered, FlowRequest, ProfilePoint, SolvedFlow, solve};
pub use fluid::fluid;
#[cfg(feature = "specimens")]
pub use solid::solid;
#[cfg(feature = "specimens")]
pub use specimen::{LoadedSpecimen, SpecimenRequest, specimen};
