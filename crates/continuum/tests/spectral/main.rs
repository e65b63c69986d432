//! Tests of the spectral kernel: principal frames, polar decomposition, functions of tensors, their derivatives.

use piola_testkit::CountingAllocator;

mod alloc;
mod cases;
mod derivatives;
mod golden;
mod laws;
mod scalars;
mod traps;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
