//! The tests of `piola-laws`.

#[cfg(feature = "batch")]
mod abaqus;
mod algebra;
mod alloc;
mod coupled;
mod kinds;
mod mixed;
#[cfg(feature = "batch")]
mod per_point;
mod plane;
mod refusals;
mod rubber;
mod same;
mod zoo;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
