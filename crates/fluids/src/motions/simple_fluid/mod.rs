//! Responses of every fluid: to steady motions, histories, start and stop of shear, oscillations, extension.

mod differential;
mod integral;
mod shifted;
mod viscous;

use piola_continuum::rates::{HomogeneousMotion, RelativeDeformation, VelocityGradient, logarithm};
use piola_continuum::{DeformationGradient, Symmetric};

use super::oscillation::Oscillation;
use super::shear_stresses::ShearStresses;
use crate::any::chosen_fluid;
use crate::error::{check_bound, check_finite};
use crate::{AnyFluid, Extension, FluidsError};

/// G′ and G″, Pa, of a small oscillating shear γ₀ sin ω t: T₁₂ = γ₀ (G′ sin ω t + G″ cos ω t).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Moduli {
    /// G′.
    pub storage: f64,
    /// G″.
    pub loss: f64,
}

/// A simple fluid: T + p 1 is a functional of the history of the deformation relative to now, the same for all observers.
///
/// ```text
/// T = −p 1 + G(Cₜ(t − s), s ≥ 0)      Q G(Cₜ) Qᵀ = G(Q Cₜ Qᵀ)
/// ```
/// How each fluid responds to a [steady motion](Self::response_to_steady), a [motion](Self::response_to_motion),
/// [samples](Self::response_to_samples) of one, the [start](Self::response_to_start) and the [stop](Self::response_to_stop) of
/// shear, a [small](Self::response_to_small_oscillation) and a [large](Self::response_to_oscillation) oscillation, and steady
/// [extension](Self::response_to_extension): by a formula ●, the root of one equation ○, six equations ◐, quadrature with an error ∫,
/// or integration to a tolerance →.
///
/// | fluid | steady | motion | samples | start, stop | small | large | extension |
/// |---|---|---|---|---|---|---|---|
/// | generalised Newtonian (for Ellis ○), Reiner–Rivlin, [`LinearViscous`](crate::LinearViscous) | ● | ● | ● | ● | ● ¹ | ∫ | ● |
/// | [`SecondOrder`](crate::SecondOrder) | ● | ● | ● | ● | ● | ● | ● |
/// | [`UpperConvectedMaxwell`](crate::UpperConvectedMaxwell), [`OldroydB`](crate::OldroydB) | ◐ ² | → ³ | ● | ● | ● | → | ● ² |
/// | [`Giesekus`](crate::Giesekus) | ◐ | → | → | → | ● | → | ● |
/// | Phan-Thien–Tanner, [`Slipping`](crate::Slipping) networks | ◐ | → | → | → | ● | → | ○ ² |
/// | [`Modes`](crate::Modes) of these | as one | → | → | → ³ | ● | → | as one |
/// | [`Kbkz`](crate::Kbkz) | ∫ ² | ∫ | ∫ | ∫ | ● | ∫ | ∫ ² |
///
/// ¹ An error where the viscosity at rest is infinite: with a yield stress, and of powers below 1. ² An error where the stress would
/// grow without end: 2 λ ε̇ ≥ 1 without anything that limits it. ³ By formulas through [`ConvectedMaxwell`](crate::ConvectedMaxwell).
///
/// Formulas are exact to rounding and quadratures to 1e-11, whatever the tolerance. An [`EulerianFluid`](crate::EulerianFluid) has a
/// pressure of the present density and no T + p 1.
///
/// # Example
/// ```
/// use piola_fluids::{Bingham, Extension, Giesekus, SimpleFluid};
/// fn overshoot(fluid: &impl SimpleFluid) -> Result<f64, piola_fluids::FluidsError> {
///     let [early, late] = [0.2, 30.0].map(|time| fluid.response_to_start(10.0, time, 1e-9));
///     Ok(early?.shear / late?.shear)
/// }
/// let mud = Bingham::new(3.0, 0.5)?;
/// assert_eq!(overshoot(&mud)?, 1.0);
/// assert!(1.0 < overshoot(&Giesekus::new(0.0, 1.0, 1.0, 0.3)?)?);
/// assert_eq!(mud.response_to_stop(10.0, 1.0, 1e-9)?.shear, 0.0);
/// let pulled = mud.response_to_extension(Extension::Planar, 2.0)?; // 2 · (3/4 + 0.5) · 4/2
/// assert!((pulled - 5.0).abs() < 1e-14);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// W(18.1), W(19.12–19.13), W(23.1–23.2).
pub trait SimpleFluid {
    /// T + p 1, Pa, in a steady isochoric motion with the velocity gradient L since always.
    ///
    /// # Errors
    /// [`FluidsError::BeyondLimit`] where the stress would have grown without end.
    fn response_to_steady(&self, velocity_gradient: &VelocityGradient) -> Result<Symmetric, FluidsError>;

    /// T + p 1, Pa, at the time t, s, of a smooth isochoric motion that began from rest at t = 0.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] unless 0 < t; [`FluidsError::Continuum`] where the motion is none;
    /// [`FluidsError::Integration`].
    fn response_to_motion(
        &self,
        motion: &impl HomogeneousMotion,
        t: f64,
        tolerance: f64,
    ) -> Result<Symmetric, FluidsError>;

    /// T + p 1, Pa, at the last of the `samples` (t, s, and F) of an isochoric motion from rest at the first. Between two
    /// samples the velocity gradient is taken as constant.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] for fewer than two samples, and unless the times grow;
    /// [`FluidsError::Continuum`] where two samples are half a turn or more apart; [`FluidsError::Integration`].
    fn response_to_samples(
        &self,
        samples: &[(f64, DeformationGradient)],
        tolerance: f64,
    ) -> Result<Symmetric, FluidsError>;

    /// The stresses at the time t, s, after the start of shear at the rate k, 1/s, from rest; none at t = 0.
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`]; [`FluidsError::OutOfBounds`] unless 0 ≤ t; [`FluidsError::Integration`].
    fn response_to_start(&self, shear_rate: f64, t: f64, tolerance: f64) -> Result<ShearStresses, FluidsError>;

    /// The stresses at the time t, s, after the end of a long steady shear at the rate k, 1/s.
    ///
    /// # Errors
    /// As [`response_to_start`](Self::response_to_start).
    fn response_to_stop(&self, shear_rate: f64, t: f64, tolerance: f64) -> Result<ShearStresses, FluidsError>;

    /// G′ and G″ at the angular frequency ω, 1/s.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] unless 0 < ω; [`FluidsError::BeyondLimit`] where the viscosity at rest is
    /// infinite.
    fn response_to_small_oscillation(&self, angular_frequency: f64) -> Result<Moduli, FluidsError>;

    /// The response to the shear γ₀ sin ω t since always, with `harmonics` of each kind.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] unless 0 < γ₀, 0 < ω, 1 ≤ `harmonics` ≤ 15; [`FluidsError::Integration`].
    fn response_to_oscillation(
        &self,
        amplitude: f64,
        angular_frequency: f64,
        harmonics: usize,
        tolerance: f64,
    ) -> Result<Oscillation, FluidsError>;

    /// The stress difference of a steady [`Extension`] at the rate ε̇, 1/s, divided by ε̇, Pa s; at rest its limit.
    ///
    /// # Errors
    /// [`FluidsError::BeyondLimit`] where the stress would have grown without end, or the viscosity at rest is infinite.
    fn response_to_extension(&self, extension: Extension, rate: f64) -> Result<f64, FluidsError>;
}

/// L of simple shear.
fn shear(rate: f64) -> VelocityGradient {
    VelocityGradient(nalgebra::Matrix3::new(0.0, 0.0, 0.0, rate, 0.0, 0.0, 0.0, 0.0, 0.0))
}

/// L of an extension.
fn extension_gradient(name: &'static str, extension: Extension, rate: f64) -> Result<VelocityGradient, FluidsError> {
    check_finite(name, "rate of extension", rate)?;
    Ok(VelocityGradient(nalgebra::Matrix3::from_diagonal(&extension.rates(rate).into())))
}

/// The stress difference over the rate, or the limit at rest.
fn extensional_viscosity(stress: &Symmetric, extension: Extension, rate: f64) -> f64 {
    let [a, b, c, ..] = stress.components;
    extension.difference([a, b, c]) / rate
}

/// Refuses rates that are not finite and times before the start.
fn check_flow(name: &'static str, shear_rate: f64, t: f64) -> Result<(), FluidsError> {
    check_finite(name, "shear rate", shear_rate)?;
    check_bound(name, "time", t, "0 ≤ time", 0.0 <= t)
}

/// Refuses too few samples, and times that do not grow.
fn check_samples(name: &'static str, samples: &[(f64, DeformationGradient)]) -> Result<(), FluidsError> {
    let count = samples.len() as f64;
    check_bound(name, "number of samples", count, "2 ≤ number", 2.0 <= count)?;
    for pair in samples.windows(2) {
        check_bound(name, "time", pair[1].0, "each time is later than the one before", pair[0].0 < pair[1].0)?;
    }
    Ok(())
}

/// The velocity gradient that leads from one sample to the next.
fn gradient_between(
    (before, first): &(f64, DeformationGradient),
    (t, second): &(f64, DeformationGradient),
) -> Result<VelocityGradient, FluidsError> {
    let step = RelativeDeformation::of(first, second)?;
    Ok(VelocityGradient::new(logarithm(step.displacement.matrix())? / (t - before))?)
}

/// Each fluid's own.
impl SimpleFluid for AnyFluid {
    fn response_to_steady(&self, velocity_gradient: &VelocityGradient) -> Result<Symmetric, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_steady(velocity_gradient))
    }

    fn response_to_motion(
        &self,
        motion: &impl HomogeneousMotion,
        t: f64,
        tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_motion(motion, t, tolerance))
    }

    fn response_to_samples(
        &self,
        samples: &[(f64, DeformationGradient)],
        tolerance: f64,
    ) -> Result<Symmetric, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_samples(samples, tolerance))
    }

    fn response_to_start(&self, shear_rate: f64, t: f64, tolerance: f64) -> Result<ShearStresses, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_start(shear_rate, t, tolerance))
    }

    fn response_to_stop(&self, shear_rate: f64, t: f64, tolerance: f64) -> Result<ShearStresses, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_stop(shear_rate, t, tolerance))
    }

    fn response_to_small_oscillation(&self, angular_frequency: f64) -> Result<Moduli, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_small_oscillation(angular_frequency))
    }

    fn response_to_oscillation(
        &self,
        amplitude: f64,
        angular_frequency: f64,
        harmonics: usize,
        tolerance: f64,
    ) -> Result<Oscillation, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_oscillation(amplitude, angular_frequency, harmonics, tolerance))
    }

    fn response_to_extension(&self, extension: Extension, rate: f64) -> Result<f64, FluidsError> {
        chosen_fluid!(self, fluid => fluid.response_to_extension(extension, rate))
    }
}
