//! Tests of fields on a box.

use piola_testkit::CountingAllocator;

mod fixtures;
mod statics;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
