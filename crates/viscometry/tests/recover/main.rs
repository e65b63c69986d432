//! Tests of `piola_viscometry::recover`.

mod by_hand;
mod corrections;
mod errors;
mod flows;
mod fluids;
mod golden;
mod identity;
mod inertia;
mod laws;
mod noise;
mod traps;

#[global_allocator]
static COUNTING: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
