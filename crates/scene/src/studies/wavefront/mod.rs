//! Wave fronts in a plane medium of refractive index n(x, y): [`piola_studies::fronts`] follows them.

mod build;
mod figure;
mod plan;
mod results;

pub use piola_studies::fronts::{CausticMark, Front, Fronts, Medium, MediumPart, Source, Wavefront};

pub(super) use figure::file;
pub(super) use plan::plan;
pub(super) use results::results;
