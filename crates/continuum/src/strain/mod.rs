//! Strain: what a deformation changes in lengths and angles.
//!
//! | | material | spatial |
//! |---|---|---|
//! | squares of lengths | [`RightCauchyGreen`] C = Fᵀ F = U² | [`LeftCauchyGreen`] B = F Fᵀ = V² |
//! | ½ (λ² − 1) | [`GreenStrain`] E = ½ (C − 1) | |
//! | ½ (1 − λ⁻²) | | [`AlmansiStrain`] e = ½ (1 − B⁻¹) |
//! | linear | [`LinearStrain`] ε = sym ∇u | |
//!
//! Each is a type of its own, made by `of` from any [`Deformation`](crate::Deformation), and nothing is computed
//! before it is asked for. From a [`DisplacementGradient`](crate::DisplacementGradient) all strains keep their digits
//! however small they are; the table of invariants is in [`invariants`].

mod cauchy_green;
pub(crate) mod check;
mod green;
pub mod invariants;
pub mod kernels;
mod linear;
mod measures;

pub use cauchy_green::{LeftCauchyGreen, RightCauchyGreen};
pub use green::{AlmansiStrain, GreenStrain};
pub use linear::LinearStrain;
