//! Ensembles: many runs of one scene on all cores.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod crew;
mod ensemble;
mod error;
mod journal;
mod member;
#[cfg(feature = "parquet")]
mod parquet;
mod portion;
mod ranks;
mod results;
mod run;
mod variation;

pub use ensemble::{Ensemble, MOST_MEMBERS};
pub use error::EnsembleError;
pub use member::Member;
pub use portion::Portion;
pub use ranks::{OneProcess, Ranks, agree};
pub use results::{Results, Statistics};
pub use run::{Computed, Cost, Options, compute, compute_across, predicted_cost};
pub use variation::{Law, Random, ValueRange};
