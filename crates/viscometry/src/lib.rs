//! Viscometric flows: what a fluid does between walls, and what its flow tells of it.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod estimate;
mod flows;
mod inverse;
pub mod quadrature;
pub mod recover;
mod slip;
mod stresses;
mod validity;

pub use error::ViscometryError;
pub use estimate::Estimate;
pub use flows::{Annulus, Channel, ConeAndPlate, Couette, FallingFilm, ParallelPlates, PlaneCouette, Poiseuille};
pub use slip::WallSlip;
pub use stresses::Stresses;
pub use validity::{Validity, Warning};
