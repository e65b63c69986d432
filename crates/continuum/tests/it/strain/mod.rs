//! The tests of strain: deformation gradients, measures of strain, invariants, derivatives.

mod alloc;
mod cases;
mod derivatives;
#[cfg(feature = "glam")]
mod edges;
mod golden;
mod laws;
mod scalars;
mod traps;
#[cfg(feature = "serde")]
mod written;
