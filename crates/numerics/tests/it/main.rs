//! Tests of the numerics: one binary, one module for each kind of evidence.

mod alloc;
mod excess;
mod formulas;
mod golden;
mod laws;
mod least_squares;
mod linear;
mod peers;
mod quadrature;
mod scalars;
mod secants;
mod sums;
mod traps;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
