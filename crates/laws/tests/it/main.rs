//! The tests of `piola-laws`.

mod alloc;
mod refusals;
mod same;
mod zoo;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
