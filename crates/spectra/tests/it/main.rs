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

/// Normal numbers of a seed: Box and Muller's transform of a linear congruence.
struct Normal(u64);

impl Normal {
    fn new(seed: u64) -> Self {
        let mut normal = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d);
        // The first numbers of neighbouring seeds are alike.
        for _ in 0..16 {
            normal.uniform();
        }
        normal
    }

    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        let (radius, angle) = ((-2.0 * self.uniform().ln()).sqrt(), core::f64::consts::TAU * self.uniform());
        radius * angle.cos()
    }
}
