//! Isotropic laws of invariants, linear elasticity and response functions.

mod alloc;
mod constants;
mod forms;
mod golden;
mod lanes;
mod langevin;
mod laws;
mod limits;
mod near;
mod once;
mod parameters;
mod variation;
mod volumes;
mod zoo;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
