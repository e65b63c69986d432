//! Declarative scenes of mechanics: a TOML file in, tables and figures out.
#![doc = include_str!("../README.md")]
//!
//! | stage | module | from → to |
//! |---|---|---|
//! | read | [`document`] | text and `--set` arguments → tree with places |
//! | check | [`schema`], [`units`], [`model`] | tree → [`Scene`], or all mistakes at once |
//! | plan | [`plan`] | scene → method, step, what is computed and what is skipped, with reasons |
//! | run | [`run`](mod@run) | plan → history, drift of invariants, errors against the reference ([`kepler`](piola_gravitation::kepler) or a table) |
//! | write | [`output`] | run → `summary.json`, CSV tables, SVG figures |
//!
//! A file whose scene has no motion in time is a [study](studies) and goes the same way. [`SceneFile`] reads both.
//!
//! Beside scenes: [`fitting`], parameters of laws from tables of measured stresses; [`rheology`], fluids from viscometric
//! measurements. Both rank what they fit in a [`comparison`].
#![forbid(unsafe_code)]

pub mod comparison;
pub mod document;
mod error;
pub mod fitting;
pub mod model;
pub mod output;
pub mod plan;
pub mod rheology;
pub mod run;
mod scene_file;
pub mod schema;
pub mod studies;
pub mod units;
mod validation;
mod words;

pub use document::Document;
pub use error::SceneError;
pub use model::Scene;
pub use plan::Plan;
pub use scene_file::SceneFile;
pub use studies::Study;
