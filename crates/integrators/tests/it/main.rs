//! Tests of the integrators: one binary, one module for each kind of evidence.

mod alloc;
mod coefficients;
mod collocation;
mod dense;
mod estimates;
mod events;
mod first_step;
mod gauss_16;
mod golden;
mod laws;
mod lie_group;
mod orders;
mod problems;
mod radau;
mod radau_15;
#[cfg(feature = "serde")]
mod serialised;
mod traps;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
