//! Differential fluids, of one mode or of several.

use piola_continuum::rates::{HomogeneousMotion, VelocityGradient};
use piola_continuum::{DeformationGradient, Symmetric};

use super::{Moduli, SimpleFluid, check_flow, check_samples, gradient_between, shear};
use crate::error::check_bound;
use crate::motions::oscillation::check_oscillation;
use crate::{
    ConvectedMaxwell, DifferentialFluid, ExponentialPhanThienTanner, Extension, FluidsError, Following, Giesekus,
    LinearPhanThienTanner, Mode, Modes, NetworkMode, OldroydB, Oscillation, ShearStresses, Slipping, SteadyStress,
    StressRate, UpperConvectedMaxwell, ViscometricFluid, oscillate,
};

/// By formulas.
mod exact {
    use super::{
        ConvectedMaxwell, DeformationGradient, FluidsError, ShearStresses, Symmetric, ViscometricFluid, check_samples,
        gradient_between,
    };

    pub(super) fn samples<F: ConvectedMaxwell>(
        fluid: &F,
        samples: &[(f64, DeformationGradient)],
        _tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        check_samples(F::Mode::NAME, samples)?;
        let mut memory = vec![Symmetric::zero(); fluid.modes().len()];
        fluid.advance_through(&mut memory, samples)?;
        let last = gradient_between(&samples[samples.len() - 2], &samples[samples.len() - 1])?;
        let solvent = last.rate_of_deformation().0 * (2.0 * fluid.total_solvent_viscosity());
        Ok(memory.iter().fold(solvent, |sum, stress| sum + *stress))
    }

    pub(super) fn start<F: ConvectedMaxwell>(
        fluid: &F,
        shear_rate: f64,
        t: f64,
        _tolerance: f64,
    ) -> Result<ShearStresses, FluidsError> {
        fluid.start_up(shear_rate, t)
    }

    pub(super) fn stop<F: ConvectedMaxwell>(
        fluid: &F,
        shear_rate: f64,
        t: f64,
        _tolerance: f64,
    ) -> Result<ShearStresses, FluidsError> {
        fluid.cessation(shear_rate, t)
    }
}

/// By integration.
mod followed {
    use super::{
        DeformationGradient, DifferentialFluid, FluidsError, Following, ShearStresses, StressRate, Symmetric,
        ViscometricFluid, check_flow, check_samples, gradient_between, shear,
    };

    pub(super) fn samples<F: DifferentialFluid<Mode: StressRate>>(
        fluid: &F,
        samples: &[(f64, DeformationGradient)],
        tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        check_samples(F::Mode::NAME, samples)?;
        let mut motion = Following::from_rest(fluid, tolerance)?;
        let mut stress = Symmetric::zero();
        for pair in samples.windows(2) {
            let rows = gradient_between(&pair[0], &pair[1])?.rows();
            stress = motion.advance(|_| rows, pair[1].0 - samples[0].0)?;
        }
        Ok(stress)
    }

    pub(super) fn start<F: DifferentialFluid<Mode: StressRate>>(
        fluid: &F,
        shear_rate: f64,
        t: f64,
        tolerance: f64,
    ) -> Result<ShearStresses, FluidsError> {
        check_flow(F::Mode::NAME, shear_rate, t)?;
        if t <= 0.0 {
            return Ok(ShearStresses::default());
        }
        let rows = shear(shear_rate).rows();
        Ok(ShearStresses::of(&Following::from_rest(fluid, tolerance)?.advance(|_| rows, t)?))
    }

    pub(super) fn stop<F: DifferentialFluid<Mode: StressRate>>(
        fluid: &F,
        shear_rate: f64,
        t: f64,
        tolerance: f64,
    ) -> Result<ShearStresses, FluidsError> {
        check_flow(F::Mode::NAME, shear_rate, t)?;
        let mut motion = Following::from_steady(fluid, &shear(shear_rate), tolerance)?;
        motion.advance(|_| [[0.0; 3]; 3], t)?;
        Ok(ShearStresses::of(&motion.polymer_stress()))
    }
}

macro_rules! differential {
    ($([$($generic:tt)*] $fluid:ty, $way:ident);+ $(;)?) => {
        $(impl $($generic)* SimpleFluid for $fluid {
            fn response_to_steady(&self, velocity_gradient: &VelocityGradient) -> Result<Symmetric, FluidsError> {
                self.steady_stress(velocity_gradient)
            }

            fn response_to_motion(
                &self,
                motion: &impl HomogeneousMotion,
                t: f64,
                tolerance: f64,
            ) -> Result<Symmetric, FluidsError> {
                check_bound(<Self as DifferentialFluid>::Mode::NAME, "time", t, "0 < time", 0.0 < t)?;
                let gradient = |t: f64| motion.velocity_gradient(t).map_or([[f64::NAN; 3]; 3], |l| l.rows());
                Following::from_rest(self, tolerance)?.advance(gradient, t)
            }

            fn response_to_samples(
                &self,
                samples: &[(f64, DeformationGradient)],
                tolerance: f64,
            ) -> Result<Symmetric, FluidsError> {
                $way::samples(self, samples, tolerance)
            }

            fn response_to_start(
                &self,
                shear_rate: f64,
                t: f64,
                tolerance: f64,
            ) -> Result<ShearStresses, FluidsError> {
                $way::start(self, shear_rate, t, tolerance)
            }

            fn response_to_stop(
                &self,
                shear_rate: f64,
                t: f64,
                tolerance: f64,
            ) -> Result<ShearStresses, FluidsError> {
                $way::stop(self, shear_rate, t, tolerance)
            }

            fn response_to_small_oscillation(&self, angular_frequency: f64) -> Result<Moduli, FluidsError> {
                check_oscillation(<Self as DifferentialFluid>::Mode::NAME, 1.0, angular_frequency, 1)?;
                let (storage, loss) = (self.storage_modulus(angular_frequency), self.loss_modulus(angular_frequency));
                Ok(Moduli { storage, loss })
            }

            fn response_to_oscillation(
                &self,
                amplitude: f64,
                angular_frequency: f64,
                count: usize,
                tolerance: f64,
            ) -> Result<Oscillation, FluidsError> {
                let longest = self.modes().iter().map(Mode::time).fold(0.0, f64::max);
                // The start is forgotten to the tolerance.
                let cycles = longest * angular_frequency * -tolerance.ln() / core::f64::consts::TAU;
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
                let cycles = (cycles.ceil() + 1.0) as u32;
                oscillate(self, amplitude, angular_frequency, count, cycles, tolerance)
            }

            fn response_to_extension(&self, extension: Extension, rate: f64) -> Result<f64, FluidsError> {
                self.extensional_viscosity(extension, rate)
            }
        })+
    };
}

differential! {
    [] UpperConvectedMaxwell, exact;
    [] OldroydB, exact;
    [] Giesekus, followed;
    [] LinearPhanThienTanner, followed;
    [] ExponentialPhanThienTanner, followed;
    [<M: NetworkMode + StressRate>] Slipping<M>, followed;
    [<M: StressRate>] Modes<M>, followed;
}
