//! Tests of simulated motions: closed forms, conservation, and the definitions of what is recorded.

mod checkpoints;
mod constraints;
mod drifts;
mod forces;
mod mechanism;
mod orbits;
mod phase;
mod skipped;
mod timetable;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
