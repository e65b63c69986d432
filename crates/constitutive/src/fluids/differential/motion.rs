//! Any motion of any differential fluid, by integration along it.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_integrators::{DormandPrince853, State, Tolerance, field};

use super::mode::{DifferentialFluid, Mode, ShearStresses};
use super::steady::steady_mode;
use crate::ConstitutiveError;
use crate::error::check_bound;
use crate::fluids::ViscometricFluid;

/// A motion that is followed: the stresses that a differential fluid remembers, and the time.
///
/// # Accuracy
/// The tolerance times a few, in units of the largest stress.
///
/// # Example
/// ```
/// use piola_constitutive::fluids::{ConvectedMaxwell, Following, UpperConvectedMaxwell};
/// let fluid = UpperConvectedMaxwell::new(2.0, 0.5)?;
/// let shear = [[0.0; 3], [3.0, 0.0, 0.0], [0.0; 3]];
/// let mut motion = Following::from_rest(&fluid, 1e-12)?;
/// let early = motion.advance(|_| shear, 0.25)?;
/// let exact = fluid.start_up(3.0, 0.25)?;
/// assert!((early.components[3] / exact.shear - 1.0).abs() < 1e-11);
/// let later = motion.advance(|_| [[0.0; 3]; 3], 0.75)?; // for one λ at rest
/// assert!((later.components[3] / early.components[3] * 1.0_f64.exp() - 1.0).abs() < 1e-11);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Following<'a, F> {
    fluid: &'a F,
    state: State,
    method: DormandPrince853,
}

impl<'a, F: DifferentialFluid> Following<'a, F> {
    /// From rest at t = 0; every mode is integrated with step control to the relative `tolerance`.
    ///
    /// # Errors
    /// [`ConstitutiveError::Integration`] for a tolerance that is not positive.
    pub fn from_rest(fluid: &'a F, tolerance: f64) -> Result<Self, ConstitutiveError> {
        // Stresses may start from zero: what is small beside the modulus of a mode counts for nothing.
        let modulus =
            fluid.modes().iter().map(|mode| mode.polymer_viscosity() / mode.time()).fold(f64::INFINITY, f64::min);
        let method = DormandPrince853::new(Tolerance::new(tolerance, 1e-3 * tolerance * modulus)?);
        Ok(Self { fluid, state: State::new(0.0, vec![0.0; 6 * fluid.modes().len()])?, method })
    }

    /// After a motion with the steady velocity gradient L until t = 0.
    ///
    /// # Errors
    /// As [`from_rest`](Self::from_rest); [`ConstitutiveError::BeyondLimit`] where the motion has no steady stress.
    pub fn from_steady(
        fluid: &'a F,
        velocity_gradient: &VelocityGradient,
        tolerance: f64,
    ) -> Result<Self, ConstitutiveError> {
        let mut following = Self::from_rest(fluid, tolerance)?;
        for (mode, y) in fluid.modes().iter().zip(following.state.values.chunks_exact_mut(6)) {
            y.copy_from_slice(&steady_mode(mode, velocity_gradient)?.components);
        }
        Ok(following)
    }

    /// t, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// T + p 1 without the solvent, Pa, now.
    #[must_use]
    pub fn polymer_stress(&self) -> Symmetric {
        self.state
            .values
            .chunks_exact(6)
            .fold(Symmetric::zero(), |sum, y| sum + Symmetric { components: core::array::from_fn(|i| y[i]) })
    }

    /// Follows the motion whose L(t), by rows, is `gradient` until the time t, and gives T + p 1, Pa, there. Allocates nothing
    /// after the first call.
    ///
    /// # Errors
    /// [`ConstitutiveError::OutOfBounds`] for a time before now; [`ConstitutiveError::Continuum`] for an L that is not finite
    /// there; [`ConstitutiveError::Integration`] where the run fails.
    pub fn advance(
        &mut self,
        gradient: impl Fn(f64) -> [[f64; 3]; 3],
        time: f64,
    ) -> Result<Symmetric, ConstitutiveError> {
        let (modes, before) = (self.fluid.modes(), self.state.time);
        check_bound(F::Mode::NAME, "time", time, "0 ≤ time, and no earlier than the one before", before <= time)?;
        let mut field = field(6 * modes.len(), |t, y: &[f64], rate: &mut [f64]| {
            // What is not finite stops the run, which names it.
            let l = VelocityGradient::from_rows(gradient(t));
            let (l, factor) = l.map_or((VelocityGradient::zero(), f64::NAN), |l| (l, 1.0));
            for (mode, (y, rate)) in modes.iter().zip(y.chunks_exact(6).zip(rate.chunks_exact_mut(6))) {
                let stress = Symmetric { components: core::array::from_fn(|i| y[i]) };
                rate.copy_from_slice(&mode.stress_rate(&stress, &l).components.map(|x| x * factor));
            }
        });
        self.method.integrate_to(&mut field, &mut self.state, time)?;
        let stretching = VelocityGradient::from_rows(gradient(time))?.stretching().0;
        Ok(self.polymer_stress() + stretching * (2.0 * self.fluid.total_solvent_viscosity()))
    }
}

/// T + p 1, Pa, at each of the `times`, s, of a motion from rest at t = 0 with the velocity gradient L(t).
///
/// `gradient` gives the rows of L at t. Every mode is integrated with step control to the relative `tolerance`. What is followed
/// without new memory for its stresses is a [`Following`].
///
/// # Errors
/// [`ConstitutiveError::OutOfBounds`] unless the times grow from 0 ≤ t; [`ConstitutiveError::Continuum`] for an L that is not
/// finite at one of them; [`ConstitutiveError::Integration`] where the run fails.
///
/// # Accuracy
/// The tolerance times a few, in units of the largest stress.
///
/// # Example
/// ```
/// use piola_constitutive::fluids::{ConvectedMaxwell, UpperConvectedMaxwell, follow};
/// let fluid = UpperConvectedMaxwell::new(2.0, 0.5)?;
/// let stress = follow(&fluid, |_| [[0.0; 3], [3.0, 0.0, 0.0], [0.0; 3]], &[0.25], 1e-12)?[0];
/// let exact = fluid.start_up(3.0, 0.25)?;
/// assert!((stress.components[3] / exact.shear - 1.0).abs() < 1e-11);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub fn follow<F: DifferentialFluid>(
    fluid: &F,
    gradient: impl Fn(f64) -> [[f64; 3]; 3],
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<Symmetric>, ConstitutiveError> {
    let mut motion = Following::from_rest(fluid, tolerance)?;
    times.iter().map(|&time| motion.advance(&gradient, time)).collect()
}

/// The stresses at each of the `times`, s, of a shear flow from rest at t = 0 with the rate k(t), 1/s.
///
/// # Errors
/// As [`follow`].
///
/// # Accuracy
/// As [`follow`].
///
/// # Example
/// Giesekus' fluid overshoots when shear starts:
/// ```
/// use piola_constitutive::fluids::{Giesekus, follow_shear};
/// let fluid = Giesekus::new(0.0, 1.0, 1.0, 0.3)?;
/// let stresses = follow_shear(&fluid, |_| 10.0, &[0.2, 20.0], 1e-10)?;
/// assert!(stresses[1].shear < stresses[0].shear);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub fn follow_shear<F: DifferentialFluid>(
    fluid: &F,
    shear_rate: impl Fn(f64) -> f64,
    times: &[f64],
    tolerance: f64,
) -> Result<Vec<ShearStresses>, ConstitutiveError> {
    let gradient = |t: f64| [[0.0; 3], [shear_rate(t), 0.0, 0.0], [0.0; 3]];
    Ok(follow(fluid, gradient, times, tolerance)?.iter().map(ShearStresses::of).collect())
}

/// The response to the oscillating shear γ = γ₀ sin ω t, after the start has been forgotten.
///
/// ```text
/// T₁₂ = γ₀ Σ (Gₙ′ sin nω t + Gₙ″ cos nω t), n odd      N₁ = γ₀² Σ (nₘ′ sin mω t + nₘ″ cos mω t), m even
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Oscillation {
    /// (Gₙ′, Gₙ″), Pa, of n = 1, 3, 5, ….
    pub shear: Vec<[f64; 2]>,
    /// (nₘ′, nₘ″), Pa, of m = 0, 2, 4, ….
    pub first_normal: Vec<[f64; 2]>,
    /// What is known of the error, beside the largest harmonic of T₁₂. Of fluids that are integrated: the largest harmonic that
    /// is forbidden, of even n, which is what is left of the start and the error of the integration. Of others: the difference
    /// between two rules of quadrature.
    pub residual: f64,
}

/// Points of a cycle.
pub(in crate::fluids) const POINTS: i32 = 64;

/// [`Oscillation`] of the amplitude γ₀ and the angular frequency ω, 1/s, with `harmonics` of each kind, at most 15.
///
/// The start is given `cycles` of the oscillation to be forgotten.
///
/// # Errors
/// [`ConstitutiveError::OutOfBounds`] unless 0 < γ₀, 0 < ω, 1 ≤ `harmonics` ≤ 15; and as [`follow`].
///
/// # Accuracy
/// That of [`follow`]; harmonics beyond the 63rd are taken for lower ones, and the start is forgotten to exp(−2 π cycles/(λ ω)).
///
/// # Example
/// ```
/// use piola_constitutive::fluids::{DifferentialFluid, OldroydB, oscillate};
/// let fluid = OldroydB::new(0.5, 2.0, 1.0)?;
/// let response = oscillate(&fluid, 5.0, 2.0, 2, 12, 1e-11)?;
/// // Linear in shear, however large.
/// assert!((response.shear[0][0] / fluid.storage_modulus(2.0) - 1.0).abs() < 1e-9);
/// assert!((response.shear[0][1] / fluid.loss_modulus(2.0) - 1.0).abs() < 1e-9);
/// assert!(response.shear[1][0].abs() < 1e-9);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub fn oscillate<F: DifferentialFluid>(
    fluid: &F,
    amplitude: f64,
    angular_frequency: f64,
    harmonics: usize,
    cycles: u32,
    tolerance: f64,
) -> Result<Oscillation, ConstitutiveError> {
    let name = F::Mode::NAME;
    check_oscillation(name, amplitude, angular_frequency, harmonics)?;
    let turn = core::f64::consts::TAU;
    let times: Vec<f64> =
        (0..POINTS).map(|point| (turn * f64::from(cycles) + phase(point)) / angular_frequency).collect();
    let rate = |t: f64| amplitude * angular_frequency * (angular_frequency * t).cos();
    let stresses = follow_shear(fluid, rate, &times, tolerance)?;
    Ok(harmonics_of(&stresses, amplitude, harmonics))
}

/// Refuses what no oscillation has.
pub(in crate::fluids) fn check_oscillation(
    name: &'static str,
    amplitude: f64,
    angular_frequency: f64,
    harmonics: usize,
) -> Result<(), ConstitutiveError> {
    check_bound(name, "amplitude", amplitude, "0 < γ₀", 0.0 < amplitude)?;
    check_bound(name, "angular frequency", angular_frequency, "0 < ω", 0.0 < angular_frequency)?;
    let asked = harmonics as f64;
    check_bound(name, "number of harmonics", asked, "1 ≤ harmonics ≤ 15", 1.0 <= asked && asked <= 15.0)
}

/// The phase of a point of a cycle.
pub(in crate::fluids) fn phase(point: i32) -> f64 {
    core::f64::consts::TAU * f64::from(point) / f64::from(POINTS)
}

/// The harmonics of stresses at equal phases of one cycle.
pub(in crate::fluids) fn harmonics_of(stresses: &[ShearStresses], amplitude: f64, harmonics: usize) -> Oscillation {
    let harmonic = |of: fn(&ShearStresses) -> f64, n: i32| {
        let mut parts = [0.0; 2];
        for (point, stresses) in (0..POINTS).zip(stresses) {
            // The angle within one turn: products of whole numbers are exact.
            let (sin, cos) = phase(n * point % POINTS).sin_cos();
            parts[0] += of(stresses) * sin;
            parts[1] += of(stresses) * cos;
        }
        let weight = if n == 0 { 1.0 } else { 2.0 } / f64::from(POINTS);
        parts.map(|part| weight * part)
    };
    let count = i32::try_from(harmonics).unwrap_or(15);
    let shear: Vec<_> = (0..count).map(|j| harmonic(|s| s.shear, 2 * j + 1).map(|g| g / amplitude)).collect();
    let first_normal = (0..count).map(|j| harmonic(|s| s.first, 2 * j).map(|n| n / (amplitude * amplitude))).collect();
    let size = |parts: [f64; 2]| parts[0].abs().max(parts[1].abs());
    let forbidden = (0..count).map(|j| size(harmonic(|s| s.shear, 2 * j)) / amplitude).fold(0.0, f64::max);
    let largest = shear.iter().map(|&parts| size(parts)).fold(0.0, f64::max);
    Oscillation { shear, first_normal, residual: forbidden / largest }
}
