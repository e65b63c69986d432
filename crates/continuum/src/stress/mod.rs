//! Stress: each measure is its own type, and a conversion needs the deformation.
//!
//! ```text
//! Kirchhoff  τ = J T          first Piola–Kirchhoff  P = J T F⁻ᵀ = τ F⁻ᵀ
//! Biot       Rᵀ P             second Piola–Kirchhoff S = F⁻¹ P          Mandel  C S
//! ```

mod measures;

pub use measures::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
