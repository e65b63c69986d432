//! Fluids of the present rate: what they answer to a history is what they answer to its end.

use piola_continuum::rates::{AccelerationGradient, HomogeneousMotion, MotionRates, RivlinEricksen, VelocityGradient};
use piola_continuum::{DeformationGradient, Symmetric};

use super::{
    Moduli, SimpleFluid, check_flow, check_samples, extension_gradient, extensional_viscosity, gradient_between, shear,
};
use crate::error::check_bound;
use crate::motions::oscillation::check_oscillation;
use crate::{
    Bingham, CarreauYasuda, Casson, Cross, Ellis, Extension, Eyring, FluidsError, GeneralisedNewtonian,
    HerschelBulkley, LinearViscous, Newtonian, Oscillation, Papanastasiou, PowerLaw, ReinerRivlin,
    ReinerRivlinCoefficients, SecondOrder, ShearStresses, Sisko, ViscometricFluid, ViscousFluid,
};

/// Refuses a viscosity at rest that is infinite.
fn at_rest(law: &'static str, viscosity: f64) -> Result<f64, FluidsError> {
    let (quantity, limit) = ("viscosity at rest", f64::MAX);
    if viscosity.is_finite() {
        Ok(viscosity)
    } else {
        Err(FluidsError::BeyondLimit { law, quantity, value: viscosity, limit })
    }
}

/// L at the time t of a motion from rest at t = 0.
fn present(name: &'static str, motion: &impl HomogeneousMotion, t: f64) -> Result<VelocityGradient, FluidsError> {
    check_bound(name, "time", t, "0 < time", 0.0 < t)?;
    Ok(motion.velocity_gradient(t)?)
}

/// L between the last two samples.
fn last(name: &'static str, samples: &[(f64, DeformationGradient)]) -> Result<VelocityGradient, FluidsError> {
    check_samples(name, samples)?;
    gradient_between(&samples[samples.len() - 2], &samples[samples.len() - 1])
}

/// Steps of the rule for a quarter of a cycle: x = (π/2)/(1 + exp(−π sinh u)) at equal steps of u.
const STEPS: i32 = 140;
const STEP: f64 = 1.0 / 32.0;

/// The harmonics of stresses that depend on k = γ₀ ω cos ω t alone, from a quarter of a cycle: what is not smooth at rest is at
/// its end, where the points of the rule crowd.
fn harmonics(
    stresses: impl Fn(f64) -> ShearStresses,
    amplitude: f64,
    angular_frequency: f64,
    count: usize,
) -> Oscillation {
    let count = i32::try_from(count).unwrap_or(15);
    let quarter = core::f64::consts::FRAC_PI_2;
    let mut sums = [[[0.0; 2]; 2]; 15];
    for i in -STEPS..=STEPS {
        let u = STEP * f64::from(i);
        let fall = (-core::f64::consts::PI * u.sinh()).exp();
        let angle = quarter / (1.0 + fall);
        let weight = STEP * core::f64::consts::PI * u.cosh() * fall / (1.0 + fall) * angle;
        if !(0.0 < weight && weight.is_finite()) {
            continue;
        }
        let at = stresses(amplitude * angular_frequency * angle.sin());
        let odd = i.rem_euclid(2) == 1;
        for (j, sums) in (0..count).zip(&mut sums) {
            // cos n (π/2 − x) = sin (n π/2) sin n x for odd n, cos (n π/2) cos n x for even n.
            let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
            let parts = [
                sign * at.shear * (f64::from(2 * j + 1) * angle).sin(),
                sign * at.first * (f64::from(2 * j) * angle).cos(),
            ];
            for (sums, part) in sums.iter_mut().zip(parts) {
                sums[usize::from(odd)] += weight * part;
            }
        }
    }
    let mut oscillation = Oscillation { shear: Vec::new(), first_normal: Vec::new(), residual: 0.0 };
    let (mut largest, mut difference) = (0.0_f64, 0.0_f64);
    for (j, [shear, first]) in (0..count).zip(sums) {
        let whole = |sums: [f64; 2]| (sums[0] + sums[1]) / quarter;
        let modulus = 2.0 * whole(shear) / amplitude;
        largest = largest.max(modulus.abs());
        difference = difference.max(2.0 * (shear[0] - shear[1]).abs() / quarter / amplitude);
        let mean = if j == 0 { 1.0 } else { 2.0 };
        oscillation.shear.push([0.0, modulus]);
        oscillation.first_normal.push([0.0, mean * whole(first) / (amplitude * amplitude)]);
    }
    oscillation.residual = if 0.0 < largest { difference / largest } else { 0.0 };
    oscillation
}

macro_rules! present_rate {
    ($([$($generic:tt)*] $fluid:ty, $name:expr, $self:ident => $stresses:expr, $viscosity:expr);+ $(;)?) => {
        $(impl $($generic)* SimpleFluid for $fluid {
            fn response_to_steady(&$self, velocity_gradient: &VelocityGradient) -> Result<Symmetric, FluidsError> {
                Ok($stresses.extra_stress(velocity_gradient))
            }

            fn response_to_motion(
                &$self,
                motion: &impl HomogeneousMotion,
                t: f64,
                _tolerance: f64,
            ) -> Result<Symmetric, FluidsError> {
                Ok($stresses.extra_stress(&present($name, motion, t)?))
            }

            fn response_to_samples(
                &$self,
                samples: &[(f64, DeformationGradient)],
                _tolerance: f64,
            ) -> Result<Symmetric, FluidsError> {
                Ok($stresses.extra_stress(&last($name, samples)?))
            }

            fn response_to_start(
                &$self,
                shear_rate: f64,
                t: f64,
                _tolerance: f64,
            ) -> Result<ShearStresses, FluidsError> {
                check_flow($name, shear_rate, t)?;
                let rate = if 0.0 < t { shear_rate } else { 0.0 };
                Ok(ShearStresses::of(&$stresses.extra_stress(&shear(rate))))
            }

            fn response_to_stop(
                &$self,
                shear_rate: f64,
                t: f64,
                _tolerance: f64,
            ) -> Result<ShearStresses, FluidsError> {
                check_flow($name, shear_rate, t)?;
                Ok(ShearStresses::default())
            }

            fn response_to_small_oscillation(&$self, angular_frequency: f64) -> Result<Moduli, FluidsError> {
                check_oscillation($name, 1.0, angular_frequency, 1)?;
                Ok(Moduli { storage: 0.0, loss: at_rest($name, $viscosity)? * angular_frequency })
            }

            fn response_to_oscillation(
                &$self,
                amplitude: f64,
                angular_frequency: f64,
                count: usize,
                _tolerance: f64,
            ) -> Result<Oscillation, FluidsError> {
                check_oscillation($name, amplitude, angular_frequency, count)?;
                let stresses = |rate: f64| ShearStresses::of(&$stresses.extra_stress(&shear(rate)));
                Ok(harmonics(stresses, amplitude, angular_frequency, count))
            }

            fn response_to_extension(&$self, extension: Extension, rate: f64) -> Result<f64, FluidsError> {
                let l = extension_gradient($name, extension, rate)?;
                if rate.abs() <= 0.0 {
                    return Ok(extension.trouton_ratio() * at_rest($name, $viscosity)?);
                }
                Ok(extensional_viscosity(&$stresses.extra_stress(&l), extension, rate))
            }
        })+
    };
}

macro_rules! generalised_newtonian {
    ($($fluid:ident),+) => {
        present_rate! {
            $([] $fluid, $fluid::NAME, self => GeneralisedNewtonian::new(*self), ViscometricFluid::viscosity(self, 0.0));+
        }
    };
}
generalised_newtonian!(
    Newtonian,
    PowerLaw,
    Bingham,
    HerschelBulkley,
    Casson,
    CarreauYasuda,
    Cross,
    Ellis,
    Eyring,
    Sisko,
    Papanastasiou
);
present_rate! {
    [<F: ViscometricFluid>] GeneralisedNewtonian<F>, F::NAME, self => self, self.fluid().viscosity(0.0);
    [<C: ReinerRivlinCoefficients>] ReinerRivlin<C>, Self::NAME, self => self, ViscometricFluid::viscosity(self, 0.0);
    [] LinearViscous, Self::NAME, self => self, self.shear_viscosity();
}

/// The stress depends on the present rate and on how it changes.
impl SimpleFluid for SecondOrder {
    fn response_to_steady(&self, velocity_gradient: &VelocityGradient) -> Result<Symmetric, FluidsError> {
        Ok(self.extra_stress(velocity_gradient))
    }

    fn response_to_motion(
        &self,
        motion: &impl HomogeneousMotion,
        t: f64,
        _tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        check_bound(Self::NAME, "time", t, "0 < time", 0.0 < t)?;
        let MotionRates { deformation, rate, second_rate } = motion.rates(t)?;
        let l = VelocityGradient::of(&deformation, &rate);
        let acceleration = AccelerationGradient::of(&deformation, &second_rate);
        let [first, second] = RivlinEricksen::of_gradients(&[l.0, acceleration.0]);
        Ok(self.extra_stress_of(&first, &second))
    }

    fn response_to_samples(
        &self,
        samples: &[(f64, DeformationGradient)],
        _tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        Ok(self.extra_stress(&last(Self::NAME, samples)?))
    }

    fn response_to_start(&self, shear_rate: f64, t: f64, _tolerance: f64) -> Result<ShearStresses, FluidsError> {
        check_flow(Self::NAME, shear_rate, t)?;
        let rate = if 0.0 < t { shear_rate } else { 0.0 };
        Ok(ShearStresses::of(&self.extra_stress(&shear(rate))))
    }

    fn response_to_stop(&self, shear_rate: f64, t: f64, _tolerance: f64) -> Result<ShearStresses, FluidsError> {
        check_flow(Self::NAME, shear_rate, t)?;
        Ok(ShearStresses::default())
    }

    /// G′ = −α₁ ω², G″ = μ ω.
    fn response_to_small_oscillation(&self, angular_frequency: f64) -> Result<Moduli, FluidsError> {
        check_oscillation(Self::NAME, 1.0, angular_frequency, 1)?;
        let storage = -self.alpha1() * angular_frequency * angular_frequency;
        Ok(Moduli { storage, loss: self.viscosity_coefficient() * angular_frequency })
    }

    /// T₁₂ = μ k + α₁ k̇, N₁ = −2 α₁ k² = −α₁ γ₀² ω² (1 + cos 2 ω t).
    fn response_to_oscillation(
        &self,
        amplitude: f64,
        angular_frequency: f64,
        count: usize,
        _tolerance: f64,
    ) -> Result<Oscillation, FluidsError> {
        check_oscillation(Self::NAME, amplitude, angular_frequency, count)?;
        let Moduli { storage, loss } = self.response_to_small_oscillation(angular_frequency)?;
        let (mut shear, mut first_normal) = (vec![[0.0; 2]; count], vec![[0.0; 2]; count]);
        shear[0] = [storage, loss];
        for normal in first_normal.iter_mut().take(2) {
            *normal = [0.0, storage];
        }
        Ok(Oscillation { shear, first_normal, residual: 0.0 })
    }

    fn response_to_extension(&self, extension: Extension, rate: f64) -> Result<f64, FluidsError> {
        let l = extension_gradient(Self::NAME, extension, rate)?;
        if rate.abs() <= 0.0 {
            return Ok(extension.trouton_ratio() * self.viscosity_coefficient());
        }
        Ok(extensional_viscosity(&self.extra_stress(&l), extension, rate))
    }
}
