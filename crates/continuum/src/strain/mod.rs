//! Strain: what a deformation changes in lengths and angles.
//!
//! | of a stretch λ | material | spatial |
//! |---|---|---|
//! | λ² | [`RightCauchyGreen`] C = Fᵀ F = U² | [`LeftCauchyGreen`] B = F Fᵀ = V² |
//! | λ | [`RightStretch`] U of F = R U | [`LeftStretch`] V of F = V R |
//! | ½ (λ² − 1) | [`GreenStrain`] E = ½ (C − 1) | |
//! | λ − 1 | [`BiotStrain`] U − 1 | |
//! | ln λ | [`HenckyStrain`] ln U | [`SpatialHenckyStrain`] ln V |
//! | ½ (1 − λ⁻²) | | [`AlmansiStrain`] e = ½ (1 − B⁻¹) |
//! | (λᵐ − 1)/m | [`SethHillStrain`] (Uᵐ − 1)/m | [`SpatialSethHillStrain`] (Vᵐ − 1)/m |
//! | linear | [`LinearStrain`] ε = sym ∇u, and the engineering vector | |
//!
//! Each is a type of its own, made by `of` from any [`Deformation`](crate::Deformation), and nothing is computed
//! before it is asked for. C, B, E, e and ε are polynomials of F, ∇u or F⁻¹; the others and the [`Rotation`] R need the
//! principal stretches: to ask for several, make one [`StretchAnalysis`](crate::polar::StretchAnalysis), which also has
//! the principal stretches and axes, and use `from_analysis`. From a
//! [`DisplacementGradient`](crate::DisplacementGradient) all strains keep their digits however small they are.
//!
//! # Derivatives
//! | to get | use |
//! |---|---|
//! | the change along dF, or the rate for Ḟ | `derivative(&deformation, &direction)` |
//! | the second derivative along two directions | `second_derivative(…)` |
//! | all of ∂/∂F, 6×9 | `derivative_matrix(&deformation)` |
//! | ∂/∂C and ∂²/∂C² of U, ln U and the family | `derivative_by_metric(&c)`, `second_derivative_by_metric(…)` |
//! | any of them in a formula | the measure over differentiable scalars |
//!
//! All are finite and accurate where stretches coalesce. The table of invariants is in [`invariants`].

mod cauchy_green;
mod green;
mod hencky;
pub mod invariants;
pub(crate) mod kernels;
mod linear;
mod lines;
mod scale;
mod seth_hill;
mod stretch;

pub use cauchy_green::{LeftCauchyGreen, RightCauchyGreen};
pub use green::{AlmansiStrain, GreenStrain};
pub use hencky::{HenckyStrain, SpatialHenckyStrain};
pub use linear::LinearStrain;
pub use scale::{MetricScale, SethHill};
pub use seth_hill::{SethHillStrain, SpatialSethHillStrain};
pub use stretch::{BiotStrain, LeftStretch, RightStretch, Rotation};
