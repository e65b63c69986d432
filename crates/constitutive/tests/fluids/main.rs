//! Fluids: reference values, identities, limits and refusals.

mod golden;
mod references;
mod refusals;
mod shear;
mod stresses;
