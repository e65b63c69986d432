//! Homogeneous tests: stresses of bars that are pulled, sheets that are pulled both ways, blocks that are sheared.
//!
//! ```text
//! uniaxial     F = diag(λ, λ_t, λ_t)        P₂₂ = P₃₃ = 0
//! equibiaxial  F = diag(λ, λ, λ_t)          P₃₃ = 0
//! planar       F = diag(λ, 1, λ_t)          P₃₃ = 0         (pure shear)
//! simple shear F = 1 + k e₂ ⊗ e₁            P₃₃ = 0 by the pressure, if incompressible
//! ```
//! | you have | use |
//! |---|---|
//! | an incompressible law, a mode and a stretch; speed and derivatives matter | [`first_piola`] |
//! | the same, and want pressure and all stresses | [`IncompressibleState`] |
//! | a law, compressible or not, and a mode | [`uniaxial`], [`equibiaxial`], [`planar`], [`simple_shear`], [`volumetric`] |
//! | some components of F and the others of P or T | [`equilibrium`] with [`Controls`] |
//! | the same, and the body has internal constraints | [`constrained_equilibrium`] |
//! | a step of a viscoelastic solid, or a law of your own without an energy | the same, of a [`Response`](piola_solids::Response) |
//!
//! The third face is free of traction in every mode; the pressure of an incompressible law follows from that in
//! closed form by [`first_piola`] and [`IncompressibleState`], as an unknown beside F by [`equilibrium`].

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
pub use incompressible::{Incompressible, IncompressibleState, first_piola, first_piola_and_slope};
pub use mode::Mode;

use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

use crate::SpecimensError;
use crate::error::check_bound;

/// ∇u of stretches along the axes, from the elongations.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn diagonal<T: Real>([a, b, c]: [T; 3]) -> Rows<T> {
    let o = T::zero();
    [[a, o, o], [o, b, o], [o, o, c]]
}

/// Refuses stretches that are not positive.
fn check_stretches<T: Real>(stretches: &[T]) -> Result<(), SpecimensError> {
    stretches.iter().try_for_each(|stretch| {
        (0..T::LANES).try_for_each(|lane| {
            let stretch = stretch.primal(lane);
            check_bound("homogeneous test", "stretch", stretch, "0 < stretch", 0.0 < stretch)
        })
    })
}
