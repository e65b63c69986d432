//! Hyperelastic solids: a law is its energy, and every stress and tangent follows from it.
//!
//! ```text
//! P = ∂W/∂F      S = F⁻¹ P = ∂W/∂E      τ = P Fᵀ      T = τ/J      A = ∂P/∂F      ∂S/∂E
//! ```
//!
//! [`Hyperelastic`] is the trait of them all. A law of your own gives [`energy`](Hyperelastic::energy) as one function over
//! any scalar; stresses and tangents are then its exact derivatives. The laws of this module give closed forms
//! for speed, and keep their digits near the reference configuration.

/// Calls a macro for each row of 9 × 9 entries with the columns from its diagonal on.
macro_rules! rows_of_upper_triangle {
    ($row:ident) => {
        $row!(0: 0 1 2 3 4 5 6 7 8);
        $row!(1: 1 2 3 4 5 6 7 8);
        $row!(2: 2 3 4 5 6 7 8);
        $row!(3: 3 4 5 6 7 8);
        $row!(4: 4 5 6 7 8);
        $row!(5: 5 6 7 8);
        $row!(6: 6 7 8);
        $row!(7: 7 8);
        $row!(8: 8);
    };
}

mod anisotropic;
mod any;
mod blatz_ko;
mod body;
mod compressible;
pub mod derived;
mod elastic_constants;
mod fibres;
mod fung;
mod hencky;
mod holzapfel;
mod hyperelastic;
mod incompressible;
pub mod invariant;
pub mod isochoric;
mod known;
mod linear_elastic;
pub mod membrane;
mod mooney_rivlin;
mod neo_hookean;
mod numbers;
mod ogden;
mod polynomial;
mod pressurised;
mod range;
mod reinforced;
pub mod response;
mod saint_venant_kirchhoff;
mod series;
mod stiffness;
mod strain_energy;
pub mod stretch;
mod unimodular;
pub mod volumetric;

pub use anisotropic::{AnisotropicLinear, AnisotropicSaintVenantKirchhoff};
pub use any::{AnyIsochoric, AnySolid, AnyVolumetric, SolidVisitor};
pub use blatz_ko::BlatzKo;
pub use body::UniformBody;
pub use compressible::{Compressible, MooneyRivlinIsochoric, NeoHookeanIsochoric};
pub use elastic_constants::{ElasticConstants, PoissonSign};
pub use fibres::Fibre;
pub use fung::Fung;
pub use hencky::Hencky;
pub use holzapfel::HolzapfelGasserOgden;
pub use hyperelastic::Hyperelastic;
pub use incompressible::{IncompressibleSolid, Pressure};
pub use linear_elastic::{LinearElastic, MixedLinearElastic};
pub use membrane::{Membrane, ThinPlate};
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::{NeoHookean, NeoHookeanCiarlet, NeoHookeanLogarithmic};
#[cfg(feature = "fit")]
pub(crate) use ogden::ogden_term;
pub use ogden::{IncompressibleOgden, IsochoricOgden, Ogden, OgdenTerm};
pub use polynomial::{Polynomial, PolynomialTerm};
pub use pressurised::Pressurised;
pub use reinforced::ReinforcedNeoHookean;
pub use response::{IsotropicResponse, IsotropicSolid, ResponseForm};
pub use saint_venant_kirchhoff::SaintVenantKirchhoff;
pub use stiffness::{EngineeringConstants, Stiffness, TransverseConstants};
