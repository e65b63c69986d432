//! Declarative scenes of mechanics: a TOML file in, tables and figures out.
//!
//! | stage | module | from → to |
//! |---|---|---|
//! | read | [`document`] | text → tree with places |
//! | check | [`model`] | tree → [`Scene`], or all mistakes at once |
#![forbid(unsafe_code)]

pub mod document;
mod error;
pub mod kepler;
pub mod model;
pub mod output;
pub mod plan;
pub mod run;
pub mod schema;
pub mod units;
mod validation;
mod words;

pub use document::Document;
pub use error::SceneError;
pub use model::Scene;
pub use plan::Plan;
