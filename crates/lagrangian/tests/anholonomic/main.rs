//! Tests of quasi-velocities: frames, the Boltzmann–Hamel equations, rolling.

mod alloc;
mod golden;
mod laws;
mod rolling;
mod systems;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
