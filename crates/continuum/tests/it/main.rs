//! Golden data, identities, traps and allocations of everything at a point.

mod polar;
mod rates;
mod strain;
mod stress;
mod tangents;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
