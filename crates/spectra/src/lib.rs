//! Relaxation spectra of linear viscoelasticity.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod data;
mod error;
mod fitting;
mod kernel;
mod retardation;
mod spectrum;

pub use data::SpectrumData;
pub use error::SpectraError;
pub use fitting::{ModeCount, SpectrumFit, SpectrumOptions, fit_spectrum};
pub use retardation::{RetardationMode, RetardationSpectrum};
pub use spectrum::{RelaxationMode, RelaxationSpectrum};
