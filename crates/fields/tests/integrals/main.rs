//! Integrals over bodies: rules of quadrature, resultants, transport, balances, elements.

mod alloc;
mod exactness;
mod laws;
mod manufactured;
mod orders;
mod terms;
mod traps;
mod weak;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
