//! Homogeneous tests of bodies with internal constraints.

mod contradictions;
mod incompressible;
mod reactions;
mod refusals;
