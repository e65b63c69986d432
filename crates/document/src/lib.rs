//! TOML files whose values keep their places and have units, checked against declared tables.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod document;
mod error;
mod mistake;
mod node;
mod parse;
mod record;
pub mod schema;
mod settings;
mod shape;
mod source;
pub mod units;
pub mod words;

pub use document::Document;
pub use error::DocumentError;
pub use mistake::{Located, Mistake, Report};
pub use node::{Entry, Node, Value};
pub use record::{Field, FieldValue, Parameter, Record};
pub use source::{LARGEST_SCENE, Place, Source};
