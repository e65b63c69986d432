//! Relaxation and retardation spectra of linear viscoelasticity.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod continuous;
mod data;
mod error;
mod fitting;
mod interlacing;
mod kernel;
mod retardation;
mod search;
mod spectrum;
mod superposition;

pub use continuous::{ContinuousSpectrum, fit_continuous, fit_continuous_until};
pub use data::SpectrumData;
pub use error::SpectraError;
pub use fitting::{ModeCount, RetardationFit, SpectrumFit, SpectrumOptions, fit_spectrum, fit_spectrum_until};
pub use retardation::{RetardationMode, RetardationSpectrum};
pub use spectrum::{RelaxationMode, RelaxationSpectrum};
pub use superposition::{
    CurveShift, IsothermalCurve, ShiftFit, fit_arrhenius, fit_williams_landel_ferry, horizontal_shifts,
    shifts_along_both_axes,
};
