//! Stress: each measure is its own type, and a conversion needs the deformation.
//!
//! ```text
//! Kirchhoff  τ = J T          first Piola–Kirchhoff  P = J T F⁻ᵀ = τ F⁻ᵀ
//! Biot       Rᵀ P             second Piola–Kirchhoff S = F⁻¹ P          Mandel  C S
//! ```

mod area;
mod conversions;
mod deviator;
#[cfg(feature = "glam")]
mod glam;
pub mod gradients;
pub mod invariants;
pub mod kernels;
mod measures;
mod methods;
mod normal;
mod power;
mod principal;
mod symmetry;
mod traction;
mod transformation;

pub use area::{DeformedArea, reference_body_force, reference_surface_force};
pub use invariants::HaighWestergaard;
pub use measures::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
pub use normal::{ReferenceNormal, UnitNormal};
pub use principal::{MohrCircle, PrincipalStresses};
pub use symmetry::moment_residual;
pub use traction::oblique_traction;
