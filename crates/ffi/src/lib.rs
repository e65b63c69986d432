//! C interface of Piola: laws of solids at many points, fluids and their flows; user materials for Abaqus.
#![doc = include_str!("../README.md")]
//!
//! # From Rust
//! The modules below are the safe half of the interface: functions on slices, which the [C functions](c) and the Python
//! package call. A Rust program that knows its law when it is compiled uses the crates themselves.
#![deny(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod abaqus;
mod blocks;
#[expect(unsafe_code, reason = "pointers from C")]
pub mod c;
mod conversions;
mod error;
mod evaluation;
pub mod flows;
#[cfg(feature = "history")]
pub mod history;
#[doc(hidden)]
pub mod internal {
    //! For the tests of this crate.
    pub use crate::c::status::answer;
}
pub mod materials;
mod measures;
pub mod named;
pub mod points;
mod stages;
pub mod text;

pub use error::FfiError;
