//! Homogeneous tests of bodies with internal constraints and of bodies with memory.

mod contradictions;
mod incompressible;
mod limits;
mod reactions;
mod refusals;
mod viscoelastic;
