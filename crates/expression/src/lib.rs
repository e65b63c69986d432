//! Expressions as data: evaluated over any scalar, so with exact derivatives.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod halves;
mod nodes;
mod slopes;
mod structure;
#[cfg(feature = "text")]
pub mod text;

pub use error::ExpressionError;
pub use halves::Halves;
pub use nodes::{DEEPEST_EXPRESSION, Expression, ExpressionNode, Function, Operation, Variable};
pub use slopes::ExpressionSlopes;
