//! Tests of the methods for stiff problems.

#[expect(dead_code, reason = "the energy is for the other crates that share the file")]
#[path = "../../../integrators/tests/it/problems/kepler.rs"]
mod problems;
mod radau;
#[cfg(feature = "serde")]
mod serialised;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
