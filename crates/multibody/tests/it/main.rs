//! Tests of trees of rigid bodies.

mod alloc;
mod batch;
mod derivatives;
mod digits;
mod golden;
mod joint_forces;
mod kept;
mod kept_dynamics;
mod laws;
mod loops;
mod mechanisms;
#[cfg(feature = "mjcf")]
mod mjcf;
mod motions;
mod placement;
mod singular;
mod traps;
mod trees;
#[cfg(feature = "urdf")]
mod urdf;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
