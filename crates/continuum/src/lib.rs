//! Continuum mechanics: deformation, strain, stress, rates and balance.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod batch;
pub mod deformation;
mod error;
pub mod fields;
pub mod rates;
pub mod spectral;
pub mod strain;
pub mod stress;
pub mod tensor;

pub use deformation::{Deformation, DeformationGradient, DisplacementGradient, HomogeneousDeformation};
pub use error::ContinuumError;
pub use stress::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
pub use stress::{ReferenceNormal, UnitNormal};
pub use tensor::Symmetric;
