//! The tests of tangents and of transport.

mod alloc;
mod cases;
mod energies;
mod golden;
mod laws;
mod rates;
mod scalars;
mod of_stress;
#[cfg(feature = "serde")]
mod written;
