//! Tests of gravitation.

mod alloc;
#[cfg(feature = "serde")]
mod checkpoints;
mod conics;
mod democratic;
mod golden;
mod hybrid;
mod kepler;
mod laws;
mod planets;
mod regularised;
mod solar_system;
mod traps;
mod wisdom_holman;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
