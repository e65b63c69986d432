//! Loads that an experimenter measures on bodies in the states of the families, and states under given loads.
//!
//! | experiment | type | load over parameter |
//! |---|---|---|
//! | a block is pulled, its sides free, held or pulled | [`BlockExtension`] | force over stretch |
//! | a spherical shell is inflated, or turned inside out | [`SphereInflation`] | pressure over the stretch of the inner face |
//! | a tube is inflated, its ends held, pulled or closed | [`TubeInflation`] | pressure over the stretch of the inner face |
//! | a cylinder is twisted, its ends held or pulled | [`Torsion`] | torque over twist |
//! | a block is bent, its curved faces free | [`Bending`] | moment over angle |
//! | a sector is straightened | [`Straightening`] | tension over length |
//! | a sector is sheared azimuthally | [`AzimuthalShear`] | shear traction over B |
//! | a tube is turned inside out, all faces free | [`everted_tube`] | |
//!
//! Each but the last is a [`LoadCurve`](crate::LoadCurve): it has limit points, and all states under a load. Loads on the
//! faces of a single state come from [`FaceForces`], [`SectorLoads::of_bending`], [`SectorLoads::of_tube`], [`BlockLoads`] and
//! [`ShearLoads`].
//!
//! ```text
//! force and moment on a face:  ∫ P N dA,  ∫ r P_θN dA,   P = T F⁻ᵀ
//! ```
//! Loads are conjugate to the constants of the families: with the stored energy E of the body, dE = Σ load · d(constant) +
//! work of the pressures.

mod azimuthal;
mod bending;
mod bodies;
mod everted;
mod extension;
mod resultants;
mod sphere;
mod straightening;
mod torsion;
mod tube;

pub use azimuthal::{AzimuthalShear, ShearLoads};
pub use bending::{Bending, BentBlock};
pub use bodies::{Block, Ends, Sector, Shell, Tube};
pub use everted::{EvertedTube, everted_tube};
pub use extension::{BlockExtension, BlockSides, ExtendedBlock, FaceForces};
pub use resultants::SectorLoads;
pub use sphere::SphereInflation;
pub use straightening::{BlockLoads, Straightening};
pub use torsion::{Torsion, TwistedTube, torsion_under};
pub use tube::{InflatedTube, TubeInflation};

use crate::ResponseFunctions;

/// The shear modulus of the reference, g₁ − g₋₁ at I = II = 3, Pa: the scale of loads.
pub(crate) fn shear_modulus(law: &impl ResponseFunctions) -> f64 {
    let [direct, inverse]: [f64; 2] = law.response(0.0, 0.0);
    (direct - inverse).abs().max(f64::MIN_POSITIVE)
}
