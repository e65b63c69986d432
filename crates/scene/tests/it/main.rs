//! Tests of scenes: every bad input has a clear answer, every good one the right result.

mod bad_input;
#[cfg(feature = "spectral")]
mod boxes;
mod checkpoints;
mod constraints;
#[cfg(all(feature = "solutions", feature = "spectral"))]
mod figures;
mod forces;
mod fuzz;
mod hamiltonian;
mod hostile;
mod plan;
mod reference;
#[cfg(feature = "robots")]
mod robot;
mod rolling;
mod run;
mod settings;
mod shipped;
#[cfg(feature = "solutions")]
mod solids;
mod studies;
mod support;
#[cfg(all(feature = "solutions", feature = "spectral"))]
mod svg;
