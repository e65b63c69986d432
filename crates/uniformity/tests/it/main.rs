//! Tests of uniform bodies.

use piola_testkit::CountingAllocator;

mod fixtures;
mod geometry;
mod golden;
mod transport;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
