//! Torsion of a rod or a tube: [`piola_studies::torsion`] computes it.

mod build;
mod figure;
mod plan;
mod results;

pub use piola_studies::torsion::{RodCurves, TwistedRod, TwistedState};

pub(super) use figure::file;
pub(super) use plan::plan;
pub(super) use results::results;
