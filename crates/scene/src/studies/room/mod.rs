//! The first arrival of a signal in a room: [`piola_studies::room`] computes it.

mod build;
mod figure;
mod plan;
mod results;

pub use piola_studies::room::{Arrivals, LossOfInvertibility, Outline, Room, Speed};

pub(super) use figure::file;
pub(super) use plan::plan;
pub(super) use results::results;
