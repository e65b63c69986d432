//! Homogeneous tests, checks of laws and memory.

mod homogeneous;
mod refuted;
