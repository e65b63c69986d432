//! TOML files whose values keep their places and have units, checked against declared tables.
#![cfg_attr(feature = "files", doc = include_str!("../README.md"))]
#![forbid(unsafe_code)]

#[cfg(feature = "files")]
mod document;
#[cfg(feature = "files")]
mod error;
#[cfg(feature = "files")]
mod include;
#[cfg(feature = "files")]
mod mistake;
#[cfg(feature = "files")]
mod node;
#[cfg(feature = "files")]
mod parse;
#[cfg(feature = "files")]
mod record;
#[cfg(feature = "files")]
pub mod schema;
#[cfg(feature = "files")]
mod settings;
#[cfg(feature = "files")]
mod shape;
#[cfg(feature = "files")]
mod source;
pub mod units;
#[cfg(feature = "files")]
mod varied;
pub mod words;

#[cfg(feature = "files")]
pub use document::Document;
#[cfg(feature = "files")]
pub use error::DocumentError;
#[cfg(feature = "files")]
pub use mistake::{Located, Mistake, Report};
#[cfg(feature = "files")]
pub use node::{Entry, Node, Value};
#[cfg(feature = "files")]
pub use record::{Field, FieldValue, Parameter, Record};
#[cfg(feature = "files")]
pub use source::{LARGEST_SCENE, Place, Source};
#[cfg(feature = "files")]
pub use varied::Varied;
