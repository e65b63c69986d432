//! Every built-in law as one type: each claim is tried on all of them.

mod alloc;
mod derived;
mod differences;
mod extremes;
mod kinks;
mod laws;
mod limits;
#[path = "../invariant/once.rs"]
mod once;
mod pairs;
mod refusals;
mod same;
#[cfg(feature = "serde")]
mod written;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
