//! Tests of the integrators: one binary, one module for each kind of evidence.

mod advice;
mod alloc;
mod checkpoints;
mod coefficients;
mod collocation;
mod continuing;
mod dense;
mod estimates;
mod events;
mod first_step;
mod gauss_16;
mod golden;
mod laws;
mod orders;
mod pairs;
mod problems;
mod processed;
mod radau_15;
mod sensitivity;
#[cfg(feature = "serde")]
mod serialised;
mod slopes;
mod splittings;
mod traps;
mod turning_frame;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
