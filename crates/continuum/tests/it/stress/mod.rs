//! The tests of stress: measures, tractions, invariants, power.

mod alloc;
mod areas;
mod cases;
#[cfg(feature = "glam")]
mod edges;
mod golden;
mod laws;
mod rounding;
mod traps;
#[cfg(feature = "serde")]
mod written;
