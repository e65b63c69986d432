//! Tests of the methods that keep what the motion keeps: one binary, one module for each method.

mod continued;
#[path = "../../../integrators/tests/it/continuing.rs"]
mod continuing;
mod discrete_gradient;
mod gauss_collocation;
mod lie_group;
mod lobatto_pair;
#[path = "../../../integrators/tests/it/problems/kepler.rs"]
mod problems;
mod reversible;
mod variational;

use piola_testkit::CountingAllocator;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;
