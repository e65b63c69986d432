//! Tests of Lagrange's equations.

mod alloc;
mod any;
mod counts;
mod golden;
mod heavy_top_splitting;
mod laws;
mod systems;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
