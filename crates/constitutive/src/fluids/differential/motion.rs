//! Any motion of any differential fluid, by integration along it.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_integrators::{DormandPrince853, State, Tolerance, field};

use super::mode::{DifferentialFluid, Mode, ShearStresses};
use crate::ConstitutiveError;
use crate::error::check_bound;
use crate::fluids::ViscometricFluid;

/// T + p 1, Pa, at each of the `times`, s, of a motion from rest at t = 0 with the velocity gradient L(t).
///
/// `gradient` gives the rows of L at t. Every mode is integrated with step control to the relative `tolerance`.
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
    let modes = fluid.modes();
    let name = F::Mode::NAME;
    let rest = VelocityGradient::zero();
    let mut field = field(6 * modes.len(), |t, y: &[f64], rate: &mut [f64]| {
        // What is not finite stops the run, which names it.
        let l = VelocityGradient::from_rows(gradient(t));
        let (l, factor) = l.map_or((rest, f64::NAN), |l| (l, 1.0));
        for (mode, (y, rate)) in modes.iter().zip(y.chunks_exact(6).zip(rate.chunks_exact_mut(6))) {
            let stress = Symmetric { components: core::array::from_fn(|i| y[i]) };
            rate.copy_from_slice(&mode.stress_rate(&stress, &l).components.map(|x| x * factor));
        }
    });
    let mut state = State::new(0.0, vec![0.0; 6 * modes.len()])?;
    // Stresses start from zero: what is small beside the modulus of a mode counts for nothing.
    let modulus = modes.iter().map(|mode| mode.polymer_viscosity() / mode.time()).fold(f64::INFINITY, f64::min);
    let mut method = DormandPrince853::new(Tolerance::new(tolerance, 1e-3 * tolerance * modulus)?);
    let mut before = 0.0;
    let mut stresses = Vec::with_capacity(times.len());
    for &time in times {
        check_bound(name, "time", time, "0 ≤ time, and no earlier than the one before", before <= time)?;
        before = time;
        method.integrate_to(&mut field, &mut state, time)?;
        let solvent =
            VelocityGradient::from_rows(gradient(time))?.stretching().0 * (2.0 * fluid.total_solvent_viscosity());
        let polymer = state
            .values
            .chunks_exact(6)
            .fold(solvent, |sum, y| sum + Symmetric { components: core::array::from_fn(|i| y[i]) });
        stresses.push(polymer);
    }
    Ok(stresses)
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
    /// The largest harmonic of T₁₂ that is forbidden, of even n, beside the largest of all: what is left of the start, and the
    /// error of the integration.
    pub residual: f64,
}

/// Points of a cycle.
const POINTS: i32 = 64;

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
    check_bound(name, "amplitude", amplitude, "0 < γ₀", 0.0 < amplitude)?;
    check_bound(name, "angular frequency", angular_frequency, "0 < ω", 0.0 < angular_frequency)?;
    let asked = harmonics as f64;
    check_bound(name, "number of harmonics", asked, "1 ≤ harmonics ≤ 15", 1.0 <= asked && asked <= 15.0)?;
    let turn = core::f64::consts::TAU;
    let phase = |point: i32| turn * f64::from(point) / f64::from(POINTS);
    let times: Vec<f64> =
        (0..POINTS).map(|point| (turn * f64::from(cycles) + phase(point)) / angular_frequency).collect();
    let rate = |t: f64| amplitude * angular_frequency * (angular_frequency * t).cos();
    let stresses = follow_shear(fluid, rate, &times, tolerance)?;
    let harmonic = |of: fn(&ShearStresses) -> f64, n: i32| {
        let mut parts = [0.0; 2];
        for (point, stresses) in (0..POINTS).zip(&stresses) {
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
    Ok(Oscillation { shear, first_normal, residual: forbidden / largest })
}
