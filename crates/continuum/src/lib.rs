//! Continuum mechanics at a point: deformation, strain, rates, stress and tangents.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod deformation;
mod error;
mod measures;
pub mod polar;
pub mod rates;
pub mod strain;
pub mod stress;

pub use deformation::{Deformation, DeformationGradient, DisplacementGradient, HomogeneousDeformation};
pub use error::ContinuumError;
pub use piola_tensor::Symmetric;
pub use stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
pub use stress::{ReferenceNormal, UnitNormal};

/// What only Piola's own crates need: kernels on plain arrays.
#[doc(hidden)]
pub mod internal {
    pub use crate::deformation::gradient::check_jacobian;

    /// Of rates.
    pub mod rates {
        pub use crate::rates::kernels::*;
    }
    /// Of strains.
    pub mod strain {
        pub use crate::deformation::moderate::{MODERATE, is_moderate, square};
        pub use crate::strain::kernels::*;
    }
    /// Of stresses.
    pub mod stress {
        pub use crate::stress::kernels::*;
        pub use piola_tensor::internal::product_symmetrized;
    }
    /// Of tangents.
    pub mod tangents {
        pub use crate::stress::tangents::kernels::*;
    }
}
