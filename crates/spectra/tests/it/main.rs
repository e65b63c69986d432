//! Spectra, their responses and their fits.

mod alloc;
mod continuous;
mod fits;
mod interconversion;
mod refusals;
mod responses;
mod superposition;

#[global_allocator]
static ALLOCATOR: piola_testkit::CountingAllocator = piola_testkit::CountingAllocator;

use piola_spectra::{RelaxationMode, RelaxationSpectrum};

/// A spectrum from pairs (g, τ).
fn spectrum(modes: &[(f64, f64)], equilibrium: f64) -> RelaxationSpectrum {
    let mode = |&(modulus, relaxation_time): &(f64, f64)| RelaxationMode { modulus, relaxation_time };
    RelaxationSpectrum::new(modes.iter().map(mode).collect(), equilibrium).expect("positive")
}
