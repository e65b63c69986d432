//! Declarative scenes of mechanics: a TOML file in, tables and figures out.
#![doc = include_str!("../README.md")]
//!
//! | stage | module | from → to |
//! |---|---|---|
//! | read | [`Document`] | text and `--set` arguments → tree with places |
//! | check | [`schema`], [`model`] | tree → [`Scene`], or all mistakes at once |
//! | plan | [`plan`] | scene → method, step, what is computed and what is skipped, with reasons |
//! | run | [`run`](mod@run) | plan → history, drift of invariants, errors against the reference ([`kepler`](piola_gravitation::kepler) or a table) |
//! | write | [`output`] | run → `summary.json`, CSV tables, SVG figures |
//!
//! A file whose scene has no `[time]` is a [study](studies) and goes the same way. [`SceneFile`] reads both.
#![forbid(unsafe_code)]

mod error;
pub mod model;
pub mod output;
pub mod plan;
pub mod run;
mod scene_file;
pub mod studies;
mod varied_scene;

pub use error::{CheckpointError, SceneError};
pub use model::Scene;
pub use piola_document::{Document, Report};
pub use piola_schema as schema;
pub use plan::Plan;
pub use scene_file::SceneFile;
pub use studies::Study;
pub use varied_scene::VariedScene;
