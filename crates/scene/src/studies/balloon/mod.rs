//! The balloon: a spherical shell under pressure: [`piola_studies::balloon`] computes it.

mod build;
mod figure;
mod plan;
mod results;

pub use piola_studies::balloon::{Balloon, BalloonCurve, is_stable};

pub(super) use figure::file;
pub(super) use plan::plan;
pub(super) use results::results;
