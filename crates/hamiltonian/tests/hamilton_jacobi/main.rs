//! Tests of Hamilton–Jacobi theory: solutions, extremals between events, transversals, wave fronts.

mod alloc;
mod candidates;
mod closed_forms;
mod fronts;
mod golden;
mod laws;
mod levels;
mod separable;
mod strips;
mod systems;
mod transversals;
mod traps;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
