//! Hyperelastic solids: a law is its energy, and every stress and tangent follows from it.
//!
//! ```text
//! P = ∂W/∂F      S = F⁻¹ P = ∂W/∂E      τ = P Fᵀ      T = τ/J      A = ∂P/∂F      ∂S/∂E
//! ```
//!
//! [`Hyperelastic`] is the trait of them all. A law of your own gives [`energy`](Hyperelastic::energy) as one function over
//! any scalar; stresses and tangents are then its exact derivatives. The laws of this module give closed forms
//! for speed, and keep their digits near the reference configuration.

pub mod derived;
mod hyperelastic;
pub mod invariant;
mod hencky;
mod mooney_rivlin;
mod ogden;
pub mod stretch;

pub use hyperelastic::Hyperelastic;
pub use hencky::Hencky;
pub use mooney_rivlin::MooneyRivlin;
pub use ogden::{IsochoricOgden, Ogden, OgdenTerm};
