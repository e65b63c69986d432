//! What every test of Piola shares: tolerances with reasons, golden data, strategies, counted allocations.
//!
//! | to | use |
//! |---|---|
//! | state how close two results must be, and why | [`Tol`], [`assert_close`], [`assert_close_at_scale`] |
//! | read reference data with its provenance | [`golden`] |
//! | draw random inputs for an identity | [`strategies`] |
//! | prove that a step allocates nothing | [`CountingAllocator`], [`allocations_in`] |
//!
//! The functions here fail by panicking: they are called from tests only.

mod allocations;
mod closeness;
pub mod golden;
pub mod strategies;
mod tolerance;

pub use allocations::{CountingAllocator, allocations_in};
pub use closeness::{assert_close, assert_close_at_scale, relative_error, ulps_between};
pub use tolerance::Tol;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
