//! Tests of fields on a box.

use piola_testkit::CountingAllocator;

mod alloc;
mod fixtures;
mod flow;
mod golden;
mod modes;
mod motion;
mod orders;
mod periodic;
mod refusals;
mod statics;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
