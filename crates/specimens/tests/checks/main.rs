//! Homogeneous tests, checks of laws and memory.

mod circuits;
mod claims;
mod drucker;
#[allow(dead_code, reason = "the list of all laws; the tests of laws use more of it")]
#[path = "../../../solids/tests/any/laws.rs"]
mod every_law;
mod homogeneous;
mod isotropic;
mod laws;
mod memory;
mod refuted;
mod scope;
#[cfg(feature = "fields")]
mod uniform_body;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
