//! A tube of concentric layers: [`piola_studies::laminated_tube`] computes it.

mod build;
mod figure;
mod plan;
mod results;

pub use piola_studies::laminated_tube::{Layer, LayeredTube, Layers, TubeState, TubeStresses};

pub(super) use figure::file;
pub(super) use plan::plan;
pub(super) use results::results;
