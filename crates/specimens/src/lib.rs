//! Homogeneous specimens of solids, and checks that try to refute their laws.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod checks;
mod error;
pub mod homogeneous;
#[cfg(feature = "fields")]
mod uniform_body;

pub use error::SpecimensError;
#[cfg(feature = "fields")]
pub use uniform_body::UniformBody;
