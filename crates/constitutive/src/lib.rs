//! Constitutive laws: what a material answers to its deformation.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod batch;
pub mod checks;
mod error;
pub mod homogeneous;
pub mod internal_constraints;
pub mod memory;
pub mod solids;

pub use error::ConstitutiveError;
