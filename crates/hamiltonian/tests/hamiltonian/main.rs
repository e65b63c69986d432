//! Tests of Hamiltonian mechanics: functions, forms and maps of phase space, integrals.

mod alloc;
mod chaos;
mod forms;
mod generating;
mod golden;
mod integrals;
mod laws;
mod lie_derivatives;
#[path = "../../../lagrangian/tests/it/systems.rs"]
#[expect(dead_code, reason = "other tests place more systems than have Hamiltonians here")]
mod placed;
mod systems;
mod trajectories;
mod transformations;
mod traps;

#[global_allocator]
static COUNTER: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;
