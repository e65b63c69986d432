//! The tests of batches of laws: the numbers of single points, every view, every refusal, nothing allocated.

mod every;
mod points;
mod refusals;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
