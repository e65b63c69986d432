//! Exact solutions: reference values, identities, refusals.

mod dynamics;
mod families;
mod fixtures;
mod golden;
mod homogeneous;
mod loads;
#[cfg(feature = "integrators")]
mod oscillations;
mod refusals;
mod universality;
mod verification;
