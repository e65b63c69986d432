//! The tests of `piola-inelastic`.

mod alloc;
mod by_tangent;
mod given;
mod grown;
mod in_series;
mod kinematic;
mod lanes;
mod laws;
mod newton;
mod paths;
mod refusals;
mod specimens;
mod stress_alone;
#[cfg(feature = "serde")]
mod written;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
