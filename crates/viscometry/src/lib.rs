//! Viscometric flows: what a fluid does between walls, and what its flow tells of it.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;

pub use error::ViscometryError;
