//! Ensembles: many runs of one scene on all cores.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod ensemble;
mod error;
mod journal;
mod member;
mod portion;
mod results;
mod run;
mod variation;

pub use ensemble::{Ensemble, MOST_MEMBERS};
pub use error::EnsembleError;
pub use member::Member;
pub use portion::Portion;
pub use results::{Results, Statistics};
pub use run::{Computed, Options, compute, predicted_seconds};
pub use variation::{Law, Random, ValueRange};
