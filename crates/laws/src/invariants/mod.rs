//! Laws W of invariants: one's own function, differentiated in its arguments alone.
//!
//! ```text
//! W(a, b, θ, I₄, I₅, …)        a = I₁ − 3 − 2 ln J,   b = I₂ − 3 − 4 ln J,   θ = ln J
//! P = 2 w₁ ∂I₁/∂C … :          w₁ = ∂W/∂a,   w₂ = ∂W/∂b,   s = ∂W/∂θ = 2 w₁ + 4 w₂ + J ∂W/∂J
//! ```
//! The energy is evaluated once over [`Hessian`](piola_numerics::Hessian), in three to seven variables; stress and tangent are then
//! put together in closed form. In these variables s, which vanishes at a reference without stress, is a derivative and not a
//! difference: the stress keeps its digits at small strain.

mod at_deformation;
mod energy;
mod excesses;
mod fibres;
mod law;
#[cfg(feature = "batch")]
pub mod per_point;
mod variables;

pub use energy::EnergyOfInvariants;
pub use excesses::Excesses;
pub use law::OfInvariants;
