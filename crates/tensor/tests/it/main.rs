//! Identities, traps, formats and allocations of tensors of second and fourth order, of Voigt's and Mandel's maps.

mod alloc;
mod cases;
mod laws;
mod representation;
mod spectral;
mod traps;
#[cfg(feature = "serde")]
mod written;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
