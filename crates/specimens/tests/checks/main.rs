//! Homogeneous tests, checks of laws and memory.

mod circuits;
mod drucker;
mod homogeneous;
mod laws;
mod memory;
mod refuted;
mod scope;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
