//! What every test of Piola shares: tolerances with reasons, golden data, strategies, counted allocations.
//!
//! | to | use |
//! |---|---|
//! | state how close two results must be, and why | [`Tol`], [`assert_close`], [`assert_each_close`] |
//! | read reference data with its provenance | [`golden`] |
//! | show the order of a method | [`convergence_order`], [`assert_order`] |
//! | scale a tolerance by how ill-conditioned the problem is | [`condition_number`], [`Tol::times`] |
//! | check a derivative against differences of values | [`difference_quotient`] |
//! | read the scenes and pages of the repository | [`repository`] |
//! | draw random inputs for an identity | [`strategies`] |
//! | disturb exact data by normal noise | [`NormalNoise`] |
//! | tell rounding from the rest | [`DoubleDouble`] |
//! | judge a polar decomposition or a tensor logarithm | [`spectral`] |
//! | have a smooth displacement of a cube with its force | [`smooth_cube`] |
//! | prove that a step allocates nothing | [`CountingAllocator`], [`allocations_in`] |
//!
//! The functions here fail by panicking: they are called from tests only.

mod allocations;
mod closeness;
mod differences;
mod double_double;
pub mod golden;
mod noise;
mod orders;
pub mod repository;
pub mod smooth_cube;
pub mod spectral;
pub mod strategies;
pub mod svg;
mod tolerance;

pub use allocations::{CountingAllocator, allocations_in};
pub use closeness::{
    assert_close, assert_close_at_scale, assert_each_close, assert_each_close_at_scales, relative_error, ulps_between,
};
pub use differences::{condition_number, condition_number_by_steps, difference_quotient};
pub use double_double::DoubleDouble;
pub use noise::NormalNoise;
pub use orders::{assert_order, convergence_order};
pub use tolerance::Tol;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
