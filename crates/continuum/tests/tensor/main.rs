//! The tests of tensors of second and fourth order, of Voigt's and Mandel's maps, and of tangents.

mod alloc;
mod cases;
mod energies;
mod golden;
mod laws;
mod rates;
mod scalars;
mod tangents;
mod traps;
#[cfg(feature = "serde")]
mod written;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
