//! Elementary functions and kernels in lanes give the same bits at every width and for every set of instructions.
//!
//! A binary of its own: `cargo xtask test` runs it a second time, compiled for every set of instructions.

mod elementary;
mod lanes;
