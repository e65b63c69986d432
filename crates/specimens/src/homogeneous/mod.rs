//! Homogeneous tests: what a law answers to a bar that is pulled, a sheet that is pulled both ways, a block that is sheared.
//!
//! ```text
//! uniaxial     F = diag(λ, λ_t, λ_t)        P₂₂ = P₃₃ = 0
//! equibiaxial  F = diag(λ, λ, λ_t)          P₃₃ = 0
//! planar       F = diag(λ, 1, λ_t)          P₃₃ = 0         (pure shear)
//! simple shear F = 1 + k e₂ ⊗ e₁            P₃₃ = 0 by the pressure, if incompressible
//! ```
//! | you have | use |
//! |---|---|
//! | an incompressible law, a mode and a stretch; speed and derivatives matter | [`nominal_stress`] |
//! | the same, and want pressure and all stresses | [`IncompressibleState`] |
//! | a law, compressible or not, and a mode | [`uniaxial`], [`equibiaxial`], [`planar`], [`simple_shear`], [`volumetric`] |
//! | some components of F and the others of P or T | [`equilibrium`] with [`Controls`] |
//! | the same, and the body has internal constraints | [`constrained_equilibrium`] |
//! | a step of a viscoelastic solid, or a law of your own without an energy | the same, of a [`Response`] |
//!
//! The third face is free of traction in every mode; the pressure of an incompressible law follows from that in
//! closed form by [`nominal_stress`] and [`IncompressibleState`], as an unknown beside F by [`equilibrium`].

mod controls;
mod equilibrium;
mod incompressible;
mod mode;
mod newton;

pub use controls::{Control, Controls};
pub use equilibrium::{
    ConstrainedState, HomogeneousState, constrained_equilibrium, equibiaxial, equilibrium, planar, simple_shear,
    uniaxial, volumetric,
};
pub use incompressible::{Incompressible, IncompressibleState, nominal_stress, nominal_stress_and_slope};
pub use mode::Mode;

use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

/// ∇u of stretches along the axes, from the elongations.
#[inline(always)]
pub(crate) fn diagonal<T: Real>([a, b, c]: [T; 3]) -> Rows<T> {
    let o = T::zero();
    [[a, o, o], [o, b, o], [o, o, c]]
}
