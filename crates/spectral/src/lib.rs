//! Elastic and viscous fields on a box by their eigenfunctions.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod grid;
mod modal;
mod operator;
mod passes;
mod precision;
mod solver;
mod transform;
mod walls;
mod waves;

pub use error::SpectralError;
pub use grid::{BoxGrid, PointLocation};
pub use operator::{BoxOperator, LameParameters};
pub use precision::Precision;
pub use solver::BoxSolver;
pub use walls::{Parity, Walls};
