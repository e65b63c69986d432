//! Laws of solids of one's own: an energy is enough, and laws can be added.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod invariants;
mod methods;
pub mod strain;
pub mod stretches;

pub use invariants::{EnergyOfInvariants, Excesses, OfInvariants};
pub use strain::{EnergyOfStrain, OfStrain};
pub use stretches::{EnergyOfStretches, OfStretches};
