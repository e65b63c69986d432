//! Motions of systems made of data.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod constraints;
mod error;
pub mod forces;
pub mod joints;
pub mod motion;
mod outcome;
pub mod phase;
pub mod questions;

/// What other crates of Piola use; no part of the interface.
#[doc(hidden)]
pub mod internal {
    pub use crate::motion::checkpoint::{Marks, Sealed};
}

pub use error::SimulationError;
pub use outcome::Outcome;
pub use piola_expression as expression;
