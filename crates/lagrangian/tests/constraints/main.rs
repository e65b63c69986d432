//! Tests of constraints in implicit form: closed loops against independent coordinates and published results.

mod alloc;
mod andrews;
mod bricard;
mod four_bar;
mod laws;
mod orders;
mod singular;
mod slider_crank;
mod systems;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
