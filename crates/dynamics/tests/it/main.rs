//! Tests of the dynamics crate.

mod alloc;
mod any;
mod counts;
mod golden;
mod gravitation;
mod laws;
mod systems;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
