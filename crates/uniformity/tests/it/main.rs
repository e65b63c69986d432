//! Tests of uniform bodies.

use piola_testkit::CountingAllocator;

mod alloc;
mod bodies;
mod fixtures;
mod flatness;
mod geometry;
mod golden;
mod laminated;
mod orders;
mod residual_stress;
mod transport;
mod traps;
#[cfg(feature = "serde")]
mod written;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
