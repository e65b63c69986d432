//! Laws of solids: energies, every stress and tangent that follows from them, internal constraints, memory.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

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

/// Writes inlined methods of a law and a deformation: the name, the type and the body of each.
macro_rules! answers {
    (|$law:ident, $deformation:ident| $($method:ident -> $result:ty { $($body:tt)* })+) => { $(
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn $method<T: piola_numerics::Real>(&$law, $deformation: &impl piola_continuum::Deformation<T>) -> $result {
            $($body)*
        }
    )+ };
}

/// Reads a law through the constructor that checks it; a field `as "old"` is also read by its older name.
macro_rules! read_with {
    ($constructor:ident of $law:ident<$($generic:ident: $bound:ident),*> {
        $($(#[$about:meta])* $field:ident $(as $old:literal)?: $type:ty),+ $(,)?
    }) => {
        /// The written form of the law.
        #[cfg(feature = "serde")]
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Written<$($generic),*> {
            $($(#[$about])* $(#[serde(alias = $old)])? $field: $type,)+
        }

        #[cfg(feature = "serde")]
        impl<$($generic: $bound),*> TryFrom<Written<$($generic),*>> for $law<$($generic),*> {
            type Error = $crate::SolidsError;

            fn try_from(written: Written<$($generic),*>) -> Result<Self, $crate::SolidsError> {
                Self::$constructor($(written.$field),+)
            }
        }
    };
}

mod anisotropic;
mod any;
#[cfg(feature = "batch")]
pub mod batch;
mod blatz_ko;
mod body_response;
mod compressible;
mod elastic_constants;
mod error;
mod exponent_range;
mod fibres;
mod fung;
mod hencky;
mod holzapfel;
mod hyperelastic;
mod incompressible;
mod integer_powers;
#[doc(hidden)]
pub mod internal;
pub mod internal_constraints;
pub mod invariant;
pub mod isochoric;
mod isochoric_factor;
mod known_volume;
mod linear_elastic;
pub mod membrane;
pub mod memory;
mod mooney_rivlin;
mod neo_hookean;
mod ogden;
mod packed;
mod polynomial;
mod pressurised;
mod reinforced;
pub mod response;
mod saint_venant_kirchhoff;
mod stiffness;
mod strain_energy;
pub mod stretch;
pub mod volumetric;

pub use anisotropic::{AnisotropicLinear, AnisotropicSaintVenantKirchhoff};
pub use any::{AnyIsochoric, AnySolid, AnyVolumetric, SolidVisitor};
pub use blatz_ko::BlatzKo;
pub use body_response::Response;
pub use compressible::{Compressible, MooneyRivlinIsochoric, NeoHookeanIsochoric};
pub use elastic_constants::{ElasticConstants, PoissonSign};
pub use error::SolidsError;
pub use fibres::Fibre;
pub use fung::Fung;
pub use hencky::Hencky;
pub use holzapfel::HolzapfelGasserOgden;
pub use hyperelastic::{Hyperelastic, derived};
pub use incompressible::{IncompressibleSolid, Pressure};
pub use linear_elastic::{LinearElastic, MixedLinearElastic};
pub use membrane::{Membrane, ThinPlate};
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::{NeoHookean, NeoHookeanCiarlet, NeoHookeanLogarithmic};
pub use ogden::{IncompressibleOgden, IsochoricOgden, Ogden, OgdenTerm};
pub use polynomial::{Polynomial, PolynomialTerm};
pub use pressurised::Pressurised;
pub use reinforced::ReinforcedNeoHookean;
pub use response::{IsotropicResponse, IsotropicSolid, ResponseForm};
pub use saint_venant_kirchhoff::SaintVenantKirchhoff;
pub use stiffness::{EngineeringConstants, Stiffness, TransverseConstants};
