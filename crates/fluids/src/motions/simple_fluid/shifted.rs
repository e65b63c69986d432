//! Fluids at another temperature: their clock goes 1/aₜ times as fast.
//!
//! All times of a fluid are aₜ times those at the reference temperature, and its moduli are the same. What it answers to a motion is
//! then what it answers at the reference temperature to the same deformations in times 1/aₜ as long:
//!
//! ```text
//! Gθ(Cₜ(t − s), s ≥ 0) = G(Cₜ(t − aₜ s), s ≥ 0)      L → aₜ L,   t → t/aₜ,   ω → aₜ ω
//! ```

use nalgebra::Matrix3;
use piola_continuum::rates::{HomogeneousMotion, VelocityGradient};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;

use super::{Moduli, SimpleFluid};
use crate::{Extension, FluidsError, Oscillation, ShearStresses, Shifted, ViscometricFluid};

/// A motion by another clock: F(aₜ t).
struct Rescaled<'m, M> {
    motion: &'m M,
    factor: f64,
}

impl<M: HomogeneousMotion> HomogeneousMotion for Rescaled<'_, M> {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        self.motion.gradient(T::lit(self.factor) * t)
    }

    fn relative_displacement<T: Real>(&self, t: T, lapse: T) -> Matrix3<T> {
        let factor = T::lit(self.factor);
        self.motion.relative_displacement(factor * t, factor * lapse)
    }
}

/// The response at the reference temperature, by the fluid's own clock, with its accuracy and errors.
impl<F: ViscometricFluid + SimpleFluid> SimpleFluid for Shifted<F> {
    fn response_to_steady(&self, velocity_gradient: &VelocityGradient) -> Result<Symmetric, FluidsError> {
        self.fluid().response_to_steady(&VelocityGradient::new(velocity_gradient.0 * self.factor())?)
    }

    fn response_to_motion(
        &self,
        motion: &impl HomogeneousMotion,
        t: f64,
        tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        let rescaled = Rescaled { motion, factor: self.factor() };
        self.fluid().response_to_motion(&rescaled, t / self.factor(), tolerance)
    }

    fn response_to_samples(
        &self,
        samples: &[(f64, DeformationGradient)],
        tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        let rescaled: Vec<_> = samples.iter().map(|(t, gradient)| (t / self.factor(), *gradient)).collect();
        self.fluid().response_to_samples(&rescaled, tolerance)
    }

    fn response_to_start(&self, shear_rate: f64, t: f64, tolerance: f64) -> Result<ShearStresses, FluidsError> {
        self.fluid().response_to_start(self.factor() * shear_rate, t / self.factor(), tolerance)
    }

    fn response_to_stop(&self, shear_rate: f64, t: f64, tolerance: f64) -> Result<ShearStresses, FluidsError> {
        self.fluid().response_to_stop(self.factor() * shear_rate, t / self.factor(), tolerance)
    }

    fn response_to_small_oscillation(&self, angular_frequency: f64) -> Result<Moduli, FluidsError> {
        self.fluid().response_to_small_oscillation(self.factor() * angular_frequency)
    }

    fn response_to_oscillation(
        &self,
        amplitude: f64,
        angular_frequency: f64,
        harmonics: usize,
        tolerance: f64,
    ) -> Result<Oscillation, FluidsError> {
        self.fluid().response_to_oscillation(amplitude, self.factor() * angular_frequency, harmonics, tolerance)
    }

    fn response_to_extension(&self, extension: Extension, rate: f64) -> Result<f64, FluidsError> {
        Ok(self.factor() * self.fluid().response_to_extension(extension, self.factor() * rate)?)
    }
}
