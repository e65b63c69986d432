//! Identities between two ways to the same number.

mod action;
pub(crate) use action::{Oscillator, samples as action_samples};
mod coordinates;
mod geodesic;
mod newton_euler;
mod potentials;
mod power;
mod reactions;
