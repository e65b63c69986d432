//! Is a deformation universal? Searches for a law that refutes it.
//!
//! | class | a deformation is universal if | function |
//! |---|---|---|
//! | compressible isotropic solids | it is homogeneous: Ericksen's theorem, W(24.28–24.36) | [`compressible`] |
//! | incompressible isotropic solids | div (g₁ B + g₋₁ B⁻¹) is a gradient for all g₁, g₋₁ | [`incompressible`] |
//! | elastic fluids | det F is the same everywhere, W(24.38) | [`elastic_fluid`] |
//!
//! div T is linear in the derivatives of the stored energy at the invariants of a particle. Each of these can be chosen
//! freely, so that a deformation is universal at a particle if the finitely many energies whose other derivatives vanish all
//! leave nothing. The search tries each, and returns the one that leaves most.
//!
//! # Source
//! W §24; J. L. Ericksen, J. Math. Phys. 34 (1955) 126; Z. angew. Math. Phys. 5 (1954) 466.

mod compressible;
mod fluid;
mod incompressible;
mod kernels;

pub use compressible::{CompressibleEnergy, compressible};
pub use fluid::elastic_fluid;
pub use incompressible::{IncompressibleEnergy, incompressible};

use nalgebra::Vector3;

use crate::SolutionsError;
use crate::error::{check_bound, check_finite};

/// The law that leaves most of an equation of equilibrium.
///
/// # Example
/// See [`compressible`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refutation<L> {
    /// The law.
    pub law: L,
    /// The particle.
    pub reference: [f64; 3],
    /// What it leaves there: Div P, or the curl of the force that no pressure balances.
    pub residual: [f64; 3],
    /// The residual beside the stress over the size of the body: below 1e-10 or so it is rounding.
    pub relative: f64,
}

impl<L> Refutation<L> {
    /// Whether the deformation is not universal: the law leaves more than a share `tolerance`.
    #[must_use]
    pub fn refutes(&self, tolerance: f64) -> bool {
        tolerance < self.relative
    }
}

/// Refuses particles and a size that are none.
fn check(particles: &[Vector3<f64>], size: f64) -> Result<(), SolutionsError> {
    check_bound("size of the body", size, "0 < size", 0.0 < size)?;
    check_bound("number of particles", particles.len() as f64, "1 ≤ number", !particles.is_empty())?;
    particles.iter().try_for_each(|particle| check_finite("X", particle.as_slice()))
}
