//! The tests of batches: the same numbers as one point, every view, every bad point, nothing unasked.

mod alloc;
mod bad_points;
#[path = "../cases/mod.rs"]
mod cases;
mod every_request;
mod lanes;
mod requests;
mod single_precision;
mod views;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
