//! The flows.

mod alloc;
mod annulus;
mod by_hand;
mod every;
mod extremes;
mod fluids;
mod golden;
mod laws;
mod numbers;
mod slip;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
