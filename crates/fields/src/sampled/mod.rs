//! Sampled motions: splines through measured or computed places.
//!
//! | you have | use |
//! |---|---|
//! | displacements or places at the nodes of a rectilinear grid of particles, at one or more times | [`SampledMotion`] |
//! | places of single particles at several times | [`SampledTrajectories`] |
//!
//! The splines pass through every sample; derivatives are those of the spline, exact to rounding. Their distance
//! from a smooth motion sampled at the spacing h (in space or time) falls as
//!
//! | [`Interpolation`] | places, displacements | F, ∇u, velocity | acceleration, second gradient |
//! |---|---|---|---|
//! | `Linear` | h² | h | – (zero) |
//! | `Cubic` | h⁴ | h³ | h² |
//! | `Quintic` | h⁶ | h⁵ | h⁴ |
//!
//! with *not-a-knot* ends, so that polynomials of the degree are reproduced to rounding. An axis with fewer nodes
//! than the degree asks for gets the polynomial through all of them; one node alone means that nothing depends
//! on that coordinate.

mod grid;
mod spline;
mod trajectories;

pub use grid::{MotionSamples, SampledMotion};
pub use trajectories::SampledTrajectories;

/// The splines between samples.
///
/// # Example
/// ```
/// use piola_fields::Interpolation;
/// assert_eq!(Interpolation::Quintic.degree(), 5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Interpolation {
    /// Degree 1, continuous.
    Linear,
    /// Degree 3, with continuous second derivatives.
    #[default]
    Cubic,
    /// Degree 5, with continuous fourth derivatives.
    Quintic,
}

impl Interpolation {
    /// The degree of the polynomials.
    #[must_use]
    pub const fn degree(self) -> usize {
        match self {
            Self::Linear => 1,
            Self::Cubic => 3,
            Self::Quintic => 5,
        }
    }
}
