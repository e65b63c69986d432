//! Tests of trees of rigid bodies.

mod golden;
mod trees;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
