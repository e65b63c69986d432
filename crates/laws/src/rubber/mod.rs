//! Laws of rubber and foam from the literature, beside those of [`piola_solids`].
//!
//! ```text
//! I₁, I₂ of C, or of J^(−2/3) C in a compressible solid      λₐ principal stretches      J = det F
//! ```
//! | type | W | parameters |
//! |---|---|---|
//! | [`Carroll`] | A (I₁ − 3) + B (I₁⁴ − 81) + C (√I₂ − √3) | 3 |
//! | [`LopezPamies`] | Σ 3^(1−αᵣ)/(2 αᵣ) μᵣ (I₁^αᵣ − 3^αᵣ), r = 1, 2 | 4 |
//! | [`VanDerWaals`] | chains that end at a stretch and attract each other (Kilian) | 4 |
//! | [`ExtendedTube`] | cross-links with a limit, and tubes that entanglements make (Kaliske, Heinrich) | 4 |
//! | [`Hyperfoam`] | Σ 2 μᵢ/αᵢ² (λ₁^αᵢ + λ₂^αᵢ + λ₃^αᵢ − 3 + (J^(−αᵢ βᵢ) − 1)/βᵢ), compressible (Storåkers) | 3 a term |
//!
//! The exact network of eight chains is [`piola_solids::isochoric::ArrudaBoyce`].
//!
//! The first three are parts, as those of [`piola_solids::isochoric`]: [`IncompressibleSolid`](piola_solids::IncompressibleSolid) and
//! [`Compressible`](piola_solids::Compressible) make laws of them. [`AnyRubber`] is any of these
//! laws, for programs that read a law from a file or an argument.

mod any;
mod carroll;
mod extended_tube;
mod hyperfoam;
mod limit;
mod lopez_pamies;
mod van_der_waals;

pub use any::{AnyRubber, RubberShape};
pub use carroll::Carroll;
pub use extended_tube::{CrosslinkedNetwork, EntanglementTube, ExtendedTube};
pub use hyperfoam::{FoamTerm, Hyperfoam};
pub use lopez_pamies::LopezPamies;
pub use van_der_waals::VanDerWaals;

/// The energies over any scalar, parameters too: for Piola's other crates only.
#[doc(hidden)]
pub mod internal {
    pub use super::carroll::carroll;
    pub use super::extended_tube::{crosslinked_network, tube};
    pub use super::hyperfoam::hyperfoam_term;
    pub use super::lopez_pamies::lopez_pamies_term;
    pub use super::van_der_waals::van_der_waals;
}
