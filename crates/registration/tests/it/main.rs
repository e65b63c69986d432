//! Tests of registration.

use piola_testkit::CountingAllocator;

mod alloc;
mod balance;
mod errors;
mod fixtures;
mod images;
mod letter;
mod maps;
mod measures;
mod phantoms;
mod runs;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
