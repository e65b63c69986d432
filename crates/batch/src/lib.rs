//! The same functions over millions of points: in lanes, on all cores, only what is asked for.
//!
//! ```
//! use nalgebra::Matrix3;
//! use piola_batch as batch;
//! use piola_batch::Gradients;
//! use piola_continuum::{CauchyStress, FirstPiola, Symmetric};
//!
//! let f = vec![Matrix3::new(2.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5); 1000];
//! let t = vec![CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?; 1000];
//! let (mut r, mut u) = (vec![Matrix3::zeros(); 1000], vec![Symmetric::zero(); 1000]);
//! let mut p = vec![FirstPiola::zero(); 1000];
//! batch::evaluate(
//!     Gradients(&f[..]),
//!     (batch::rotation(&mut r[..]), batch::right_stretch(&mut u[..]), batch::cauchy_to_first_piola(&t[..], &mut p[..])),
//! )?;
//! assert_eq!((r[999], u[999].components[0], p[999].0[(0, 0)]), (Matrix3::identity(), 2.0, 2.0));
//! # Ok::<(), piola_batch::BatchError>(())
//! ```
//!
//! [`evaluate`] takes the [`Deformations`] of the points and [`Requests`]: one output or a tuple of them. Requests are
//! types, so that what is not asked for is not even compiled in, and the analysis of the stretches is made once for
//! all outputs that need it. Input and output lie where the caller has them, an array of structures or a structure of
//! arrays: see [`Source`] and [`Destination`].
//!
//! The formulas are those of the single point, run in [`Lanes`](piola_numerics::Lanes) with the widest vector
//! instructions of the machine; with feature `rayon` on all threads from [`PARALLEL_POINTS`] points on. Nothing is
//! allocated unless points are bad; those are all reported, and all others computed.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod engine;
mod error;
mod requests;

pub use engine::deformations::{Deformations, Displacements, Gradients, Undeformed};
pub use engine::destinations::Destination;
pub use engine::evaluation::{BadPoint, PARALLEL_POINTS, Report, evaluate};
pub use engine::point::Point;
pub use engine::refusal::Refusal;
pub use engine::request::{Quantity, Request, Requests};
pub use engine::scalar::BatchScalar;
pub use engine::sources::Source;
pub use engine::views::{AllEntries, ColumnMajor, Components, LaneBlocks, Strided, points_of, points_of_mut};
pub use error::BatchError;
pub use requests::*;
