//! The tests of rates: velocity gradient, polar factors, objective rates, relative deformation, exponentials.

mod alloc;
mod cases;
#[cfg(feature = "glam")]
mod edges;
mod golden;
mod histories;
mod laws;
mod scalars;
mod traps;
#[cfg(feature = "serde")]
mod written;
