//! Tests of first-order partial differential equations by characteristics.

mod alloc;
mod classification;
mod equations;
mod golden;
mod laws;
mod sheets;
mod systems;
mod traps;
mod units;
#[cfg(feature = "serde")]
mod written;

/// Counts what evaluations allocate.
#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
