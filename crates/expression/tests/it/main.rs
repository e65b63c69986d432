//! Tests of expressions: one binary.

mod expressions;
mod slopes;
#[cfg(feature = "text")]
mod text;
