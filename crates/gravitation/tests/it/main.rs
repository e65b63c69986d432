//! Tests of gravitation.

mod alloc;
mod golden;
mod kepler;
mod laws;
mod solar_system;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
