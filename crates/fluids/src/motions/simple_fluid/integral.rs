//! K-BKZ fluids.

use piola_continuum::rates::{HomogeneousMotion, VelocityGradient};
use piola_continuum::{DeformationGradient, Symmetric};

use super::{Moduli, SimpleFluid, check_flow, extension_gradient, extensional_viscosity};
use crate::motions::oscillation::check_oscillation;
use crate::{Damping, Extension, FluidsError, Kbkz, Oscillation, ShearStresses, ViscometricFluid};

/// No tolerance is looked at: quadratures are to 1e-13, and what is known of their error is with the fluid's own methods.
impl<H: Damping> SimpleFluid for Kbkz<H> {
    fn response_to_steady(&self, velocity_gradient: &VelocityGradient) -> Result<Symmetric, FluidsError> {
        Ok(self.steady_stress(velocity_gradient)?.value)
    }

    fn response_to_motion(
        &self,
        motion: &impl HomogeneousMotion,
        t: f64,
        _tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        Ok(self.stress_along(motion, t)?.value)
    }

    fn response_to_samples(
        &self,
        samples: &[(f64, DeformationGradient)],
        _tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        Ok(self.stress_of_samples(samples)?.value)
    }

    fn response_to_start(&self, shear_rate: f64, t: f64, _tolerance: f64) -> Result<ShearStresses, FluidsError> {
        check_flow(H::NAME, shear_rate, t)?;
        if t <= 0.0 { Ok(ShearStresses::default()) } else { Ok(self.start_up(shear_rate, t)?.value) }
    }

    fn response_to_stop(&self, shear_rate: f64, t: f64, _tolerance: f64) -> Result<ShearStresses, FluidsError> {
        check_flow(H::NAME, shear_rate, t)?;
        if t <= 0.0 {
            let shear = self.shear_stress(shear_rate);
            let first = self.first_normal_stress_difference(shear_rate);
            return Ok(ShearStresses { shear, first, second: 0.0 });
        }
        Ok(self.cessation(shear_rate, t)?.value)
    }

    fn response_to_small_oscillation(&self, angular_frequency: f64) -> Result<Moduli, FluidsError> {
        check_oscillation(H::NAME, 1.0, angular_frequency, 1)?;
        Ok(Moduli { storage: self.storage_modulus(angular_frequency), loss: self.loss_modulus(angular_frequency) })
    }

    fn response_to_oscillation(
        &self,
        amplitude: f64,
        angular_frequency: f64,
        count: usize,
        _tolerance: f64,
    ) -> Result<Oscillation, FluidsError> {
        self.oscillation(amplitude, angular_frequency, count)
    }

    fn response_to_extension(&self, extension: Extension, rate: f64) -> Result<f64, FluidsError> {
        let l = extension_gradient(H::NAME, extension, rate)?;
        if rate.abs() <= 0.0 {
            return Ok(extension.trouton_ratio() * self.zero_rate_viscosity());
        }
        Ok(extensional_viscosity(&self.steady_stress(&l)?.value, extension, rate))
    }
}
