//! Fluids: reference values, identities, limits and refusals.

mod any;
mod differential;
mod golden;
mod kbkz;
mod references;
mod refusals;
mod shear;
mod stresses;
