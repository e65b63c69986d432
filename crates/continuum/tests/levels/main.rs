//! Formulas at a point over single precision, lanes and exact derivatives; lanes give the same bits for every set of instructions.
//!
//! A binary of its own: `cargo xtask test` runs it a second time, compiled for every set of instructions.

mod polar;
mod stress;
mod tangents;
