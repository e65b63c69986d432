//! Homogeneous tests of bodies with internal constraints.

mod incompressible;
mod reactions;
mod refusals;
