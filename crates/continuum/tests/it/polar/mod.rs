//! Tests of the polar decomposition and of its derivatives.

mod alloc;
mod cases;
mod close_stretches;
mod derivatives;
mod golden;
mod laws;
mod traps;
