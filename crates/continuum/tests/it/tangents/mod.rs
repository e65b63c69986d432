//! The tests of tangents and of transport.

mod alloc;
mod cases;
mod energies;
mod golden;
mod laws;
mod of_stress;
mod rates;
#[cfg(feature = "serde")]
mod written;
