//! Tests of the principles of mechanics: reactions, virtual work, power, geodesics, action, changes of coordinates.

mod alloc;
mod counts;
mod laws;
mod orders;
mod systems;
mod traps;
#[cfg(feature = "serde")]
mod written;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
