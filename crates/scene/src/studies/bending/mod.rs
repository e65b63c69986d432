//! A block bent by couples: [`piola_studies::bending`] computes it.

mod build;
mod figure;
mod plan;
mod results;

pub use piola_studies::bending::{BendingCurve, BentBlockStudy};

pub(super) use figure::file;
pub(super) use plan::plan;
pub(super) use results::results;
