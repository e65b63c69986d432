//! The balances at a point: what a motion, a stress and a force leave of each.
//!
//! | balance | residual | from places x: [`Flow`] | from particles X: [`Body`] |
//! |---|---|---|---|
//! | mass | ρ̇ + ρ div v | [`Flow::continuity_residual`] | [`Body::continuity_residual`] |
//! | mass | ρ J − `ρ_κ` | | [`Body::density_residual`] |
//! | momentum | div T + ρb − ρa | [`Flow::momentum_residual`] | [`Body::spatial_momentum_residual`] |
//! | momentum | Div P + `ρ_κ` b − `ρ_κ` a | | [`Body::momentum_residual`] |
//! | damped | `ρ_κ` ü + c u̇ − f − Div P | | [`Body::damped_residual`] |
//! | statics | div T + f, Div P + f | [`equilibrium_residual`] | [`Body::equilibrium_residual`] |
//! | angular momentum | T − Tᵀ, P Fᵀ − F Pᵀ | [`symmetry_residual`] | [`Body::symmetry_residual`] |
//! | energy | ρε̇ − tr(T L) + div q − r | [`Flow::energy_residual`] | [`Body::energy_residual`] |
//! | identities | Div P − J div T, Div(J F⁻ᵀ) | | [`piola_identity_residual`], [`cofactor_divergence`] |
//!
//! Every residual comes with its scale, the sum of the moduli of its terms: [`Residual`]. A balance that holds
//! leaves a few ulp of the scale, times the condition of the formulas that are given.
//!
//! Divergences contract the last index, (div T)ᵢ = ∂Tᵢⱼ/∂xⱼ and `(Div P)ᵢ = ∂Pᵢ_A/∂X_A`. The first index, which some
//! texts contract (B(4.7)), gives something else for P.

mod body;
mod flow;
mod identities;

pub use body::Body;
pub use flow::{Flow, equilibrium_residual};
pub use identities::{cofactor_divergence, piola_identity_residual, symmetry_residual};

use super::residual::{Residual, VectorResidual};
use crate::FieldsError;
use crate::error::check_finite;
use nalgebra::Vector3;
use piola_numerics::Real;

/// The residual, if it is finite.
#[inline]
fn checked<T: Real>(quantity: &'static str, residual: Residual<T>) -> Result<Residual<T>, FieldsError> {
    check_finite(quantity, &[residual.value])?;
    check_finite(quantity, &[residual.scale])?;
    Ok(residual)
}

/// The residual, if it is finite.
#[inline]
fn checked_vector<T: Real>(quantity: &'static str, terms: [Residual<T>; 3]) -> Result<VectorResidual<T>, FieldsError> {
    let residual = VectorResidual::from(terms);
    check_finite(quantity, residual.value.as_slice())?;
    check_finite(quantity, residual.scale.as_slice())?;
    Ok(residual)
}

/// div T + ρb − ρa, from the terms of div T and of a.
#[cfg_attr(not(debug_assertions), inline(always))]
fn momentum<T: Real>(
    divergence: [Residual<T>; 3],
    density: T,
    body_force: &Vector3<T>,
    acceleration: [Residual<T>; 3],
) -> Result<VectorResidual<T>, FieldsError> {
    let component = |i: usize| divergence[i].plus(density * body_force[i]).plus_all(acceleration[i], -density);
    checked_vector("momentum", [component(0), component(1), component(2)])
}
