//! Elastic and viscous fields on a box by their eigenfunctions.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![allow(clippy::needless_range_loop, reason = "components and axes are the indices of the equations")]

mod basis;
mod derivative;
mod error;
mod flow;
mod grid;
mod lift;
mod modal;
mod motion;
mod operator;
mod passes;
mod periodic;
mod precision;
mod solver;
mod transform;
mod walls;
mod waves;

pub use basis::{Eigenbasis, ModalSeries, Polarisation};
pub use error::SpectralError;
pub use flow::{FlowReport, ViscousFlow};
pub use grid::{BoxGrid, PointLocation};
pub use motion::ModalMotion;
pub use operator::{BoxOperator, LameParameters};
pub use periodic::PeriodicSolver;
pub use precision::Precision;
pub use solver::{BoxSolver, WallForces};
pub use walls::{Parity, Walls};
