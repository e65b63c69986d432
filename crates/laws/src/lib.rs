//! Laws of solids of one's own: an energy is enough, and laws can be added.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

#[cfg(feature = "batch")]
pub mod abaqus;
pub mod algebra;
pub mod coupled;
mod error;
mod examine;
#[doc(hidden)]
pub mod internal {
    //! Functions for Piola's other crates only.
    /// Stress and tangent of slopes and curvatures.
    pub mod composition {
        pub use crate::kinds::composition::*;
    }
}
pub mod invariants;
pub mod kinds;
mod methods;
pub mod mixed;
pub mod plane;
pub mod rubber;
pub mod strain;
pub mod stretches;
mod varied;

pub use algebra::{Decoupled, OfVolume, Scaled, Sum};
pub use error::LawsError;
pub use examine::examine;
#[cfg(feature = "batch")]
pub use invariants::per_point;
pub use invariants::{EnergyOfInvariants, Excesses, OfInvariants};
pub use mixed::{ThreeField, TwoField};
pub use piola_solids::SolidsError;
pub use strain::{EnergyOfStrain, OfStrain};
pub use stretches::{EnergyOfStretches, OfStretches};
