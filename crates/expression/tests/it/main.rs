//! Tests of expressions: one binary.

mod expressions;
#[cfg(feature = "text")]
mod text;
