//! Tests of the kinematics of particles and rigid bodies.

use piola_testkit::CountingAllocator;

mod alloc;
mod charts;
mod equations;
mod exponential;
mod free_rotation;
mod golden;
mod heavy_top;
mod laws;
mod meshes;
mod orders;
#[cfg(feature = "glam")]
mod poses;
mod rounding;
mod singular_positions;
mod solids;
mod systems;
mod traps;
mod twists;
#[cfg(feature = "serde")]
mod written;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
