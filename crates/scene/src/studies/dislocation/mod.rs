//! A crystal with screw dislocations: [`piola_studies::dislocation`] computes it.

mod build;
mod figure;
mod plan;
mod results;

pub use piola_studies::dislocation::{BurgersCircuit, BurgersCircuits, ScrewDislocations, Screws, TorsionAt};

pub(super) use figure::file;
pub(super) use plan::plan;
pub(super) use results::results;
