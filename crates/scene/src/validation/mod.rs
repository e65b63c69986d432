//! The shape of a scene against its declared keys: every table walked, every mistake collected.
//!
//! What passes is a [`Record`] of values in SI units, each with its place, from which the model is built.

mod record;
mod shape;

pub(crate) use record::{Field, FieldValue, Record};
pub(crate) use shape::records;
