//! Fluids: what a material answers to the rate and the history of its deformation, up to a pressure.
//!
//! Simple shear is v₂ = k x₁: direction 1 is that of the velocity gradient, 2 that of the flow, 3 neutral. In it a simple fluid
//! is three functions of the shear rate k, its [viscometric functions](ViscometricFluid):
//!
//! ```text
//! T₁₂ = τ(k)                 odd,  the shear stress
//! σ₁(k) = T₁₁ − T₃₃          even, the second normal stress difference N₂ of rheologists
//! σ₂(k) = T₂₂ − T₃₃          even; N₁ = T₂₂ − T₁₁ = σ₂ − σ₁
//! ```
//!
//! A fluid of your own gives τ as one function over any scalar; its inverse, viscosity and derivatives follow.

mod newtonian;
mod parameters;
mod power_law;
mod viscometric;

pub use newtonian::Newtonian;
pub use parameters::Parameters;
pub use power_law::PowerLaw;
pub use viscometric::{FlowMoment, ViscometricFluid};
