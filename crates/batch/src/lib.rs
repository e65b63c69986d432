//! Deformation, strain, rates, stress and tangents at millions of points: in lanes, on all cores, only what is requested.
#![doc = include_str!("../README.md")]
//!
//! # Requests
//! [`evaluate`] takes the [`Deformations`] of the points and [`Requests`]: one output or a tuple of them. Requests are
//! types, so the program holds no code for outputs that no tuple names, and the analysis of the stretches is made once for
//! all outputs that need it. Input and output lie where the caller has them: see [`Source`] and [`Destination`].
//!
//! | of | request | components |
//! |---|---|---|
//! | F | [`jacobian`] | 1 |
//! | F | [`right_cauchy_green`], [`left_cauchy_green`], [`green_strain`] | 11, 22, 33, 12, 23, 13 |
//! | F | [`right_stretch`], [`left_stretch`], [`hencky`], [`spatial_hencky`] | 11, 22, 33, 12, 23, 13 |
//! | F | [`rotation`] | 9, by rows |
//! | F | [`principal_stretches`] | 3, descending |
//! | F | [`hencky_derivative`] | 6×9, by rows |
//! | F and two directions | [`hencky_second_derivative`] | 11, 22, 33, 12, 23, 13 |
//! | F and Ḟ | [`hencky_rate`], [`velocity_gradient`] | 6; 9, by rows |
//! | L | [`rate_of_deformation`] | 11, 22, 33, 12, 23, 13 |
//! | F and a stress | [`cauchy_to_first_piola`] and seven other conversions | of the measure |
//! | T | [`von_mises`] | 1 |
//! | F and tangents | [`push_forward_tangent`], [`truesdell_tangent`], [`first_piola_tangent`], [`jaumann_tangent`] | 21 or 81 |
//! | a symmetric tensor | [`eigenpairs`] | 3 and 9 |
//!
//! Whatever else the types of `piola-continuum` compute is a [`Quantity`](Quantity) of eight lines.
//!
//! The formulas are those of the single point, run in [`Lanes`](piola_numerics::Lanes) with the widest vector
//! instructions of the machine. Nothing is allocated unless points are bad.
#![forbid(unsafe_code)]

mod engine;
mod error;
mod requests;

pub use engine::deformations::{Deformations, Displacements, Gradients, Undeformed};
pub use engine::destinations::Destination;
pub use engine::evaluation::{PARALLEL_POINTS, Report, evaluate};
pub use engine::point::Point;
pub use engine::refusal::Refusal;
pub use engine::request::{Quantity, Request, Requests};
pub use engine::scalar::BatchScalar;
pub use engine::sources::Source;
pub use engine::together::Together;
pub use engine::views::{AllEntries, ColumnMajor, Components, LaneBlocks, Strided, points_of, points_of_mut};
pub use error::{BadPoint, BatchError};
pub use requests::*;
