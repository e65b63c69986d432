//! The flows.

mod alloc;
mod fluids;
mod golden;
mod laws;
mod numbers;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
