//! Tests of gravitation.

mod alloc;
mod conics;
mod golden;
mod kepler;
mod laws;
mod regularised;
mod solar_system;
mod traps;
mod wisdom_holman;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
