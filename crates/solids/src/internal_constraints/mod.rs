//! Internal constraints and their reaction stresses.
//!
//! ```text
//! μ(F) = 0        T = N + what the law gives        N = λ F (∂μ/∂F)ᵀ        tr(N L) = 0
//! several:  N = Σ λₖ F (∂μₖ/∂F)ᵀ        of μ̂(C):  N = 2 λ F (∂μ̂/∂C) Fᵀ
//! ```
//! The multipliers λ follow from equilibrium, not from the deformation. In homogeneous tests boundary conditions give them:
//! a face free of traction, a force, the stress along a fibre.
//!
//! | constraint | type | N |
//! |---|---|---|
//! | incompressibility, μ = det F − 1 | [`Incompressibility`] | λ J 1, p = −λ J |
//! | inextensibility along e, μ = \|F e\|² − 1 | [`Inextensibility`] | 2 λ F e ⊗ F e |
//! | rigidity, μ = Fᵀ F − 1 | [`Rigidity`] | 2 F Λ Fᵀ, Λ symmetric |
//! | your own μ(F) | [`InternalConstraint`] | by exact differentiation |
//! | your own μ̂(C) | [`MetricConstraint`] in [`OfMetric`] | the same, six directions instead of nine |
//!
//! Several are combined in a [`Combination`], which refuses redundant and inconsistent ones and finds multipliers from
//! [`StressCondition`]s. Where the deformation is not known either:
//! `piola_specimens::homogeneous::constrained_equilibrium`.
//!
//! # Source
//! W(21.5–21.25).

mod combination;
mod conditions;
mod constraint;
pub(crate) mod orthogonal;
mod several;
mod standard;

pub use combination::Combination;
pub use conditions::StressCondition;
pub use constraint::{InternalConstraint, MetricConstraint, OfMetric, Restriction};
pub use several::Constraints;
pub use standard::{Incompressibility, Inextensibility, Rigidity};
