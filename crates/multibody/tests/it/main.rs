//! Tests of trees of rigid bodies.

mod derivatives;
mod golden;
mod trees;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
