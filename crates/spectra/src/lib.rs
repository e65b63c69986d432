//! Relaxation spectra of linear viscoelasticity.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod continuous;
mod data;
mod error;
mod fitting;
mod kernel;
mod retardation;
mod spectrum;
mod superposition;

pub use continuous::{ContinuousSpectrum, fit_continuous};
pub use data::SpectrumData;
pub use error::SpectraError;
pub use fitting::{ModeCount, SpectrumFit, SpectrumOptions, fit_spectrum};
pub use retardation::{RetardationMode, RetardationSpectrum};
pub use spectrum::{RelaxationMode, RelaxationSpectrum};
pub use superposition::{IsothermalCurve, ShiftFit, fit_arrhenius, fit_williams_landel_ferry, horizontal_shifts};
