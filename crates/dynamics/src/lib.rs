#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
//! Analytical dynamics.
//!
//! | module | what |
//! |---|---|
//! | [`gravitation`] | many bodies attracting each other: direct summation in lanes, post-Newtonian term |

mod error;
pub mod gravitation;

pub use error::DynamicsError;
