//! Tests of motions, fields, coordinates, balances and compatibility.

use piola_testkit::CountingAllocator;

mod alloc;
mod balances;
mod compatibility;
mod coordinates;
mod fixtures;
mod frames;
mod motions;
mod sampled;
mod traps;
#[cfg(feature = "serde")]
mod written;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
