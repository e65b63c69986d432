//! Fluids: reference values, identities, limits and refusals.

mod alloc;
mod any;
mod batch;
mod differential;
mod elastic;
mod extremes;
mod golden;
mod histories;
mod kbkz;
mod references;
mod refusals;
mod responses;
mod shear;
mod steady;
mod stresses;
mod temperature;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
