//! Large oscillations: the harmonics of the stresses.

use super::following::follow_shear;
use super::shear_stresses::ShearStresses;
use super::stress_rate::StressRate;
use crate::error::check_bound;
use crate::{DifferentialFluid, FluidsError, ViscometricFluid};

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
    /// Estimate of the error relative to the largest harmonic of T₁₂. Of fluids that are integrated: the largest harmonic that
    /// is forbidden, of even n, which is what is left of the start and the error of the integration. Of others: the difference
    /// between two rules of quadrature.
    pub residual: f64,
}

/// Points of a cycle.
pub(super) const POINTS: i32 = 64;

/// [`Oscillation`] of the amplitude γ₀ and the angular frequency ω, 1/s, with `harmonics` of each kind, at most 15.
///
/// The start is given `cycles` of the oscillation to be forgotten.
///
/// # Errors
/// [`FluidsError::OutOfBounds`] unless 0 < γ₀, 0 < ω, 1 ≤ `harmonics` ≤ 15; and as [`follow`](crate::follow).
///
/// # Accuracy
/// That of [`follow`](crate::follow); harmonics beyond the 63rd are taken for lower ones, and the start is forgotten to exp(−2 π cycles/(λ ω)).
///
/// # Example
/// ```
/// use piola_fluids::{DifferentialFluid, OldroydB, oscillate};
/// let fluid = OldroydB::new(0.5, 2.0, 1.0)?;
/// let response = oscillate(&fluid, 5.0, 2.0, 2, 12, 1e-11)?;
/// // Linear in shear, however large.
/// assert!((response.shear[0][0] / fluid.storage_modulus(2.0) - 1.0).abs() < 1e-9);
/// assert!((response.shear[0][1] / fluid.loss_modulus(2.0) - 1.0).abs() < 1e-9);
/// assert!(response.shear[1][0].abs() < 1e-9);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
pub fn oscillate<F: DifferentialFluid<Mode: StressRate>>(
    fluid: &F,
    amplitude: f64,
    angular_frequency: f64,
    harmonics: usize,
    cycles: u32,
    tolerance: f64,
) -> Result<Oscillation, FluidsError> {
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
pub(super) fn check_oscillation(
    name: &'static str,
    amplitude: f64,
    angular_frequency: f64,
    harmonics: usize,
) -> Result<(), FluidsError> {
    check_bound(name, "amplitude", amplitude, "0 < γ₀", 0.0 < amplitude)?;
    check_bound(name, "angular frequency", angular_frequency, "0 < ω", 0.0 < angular_frequency)?;
    let asked = harmonics as f64;
    check_bound(name, "number of harmonics", asked, "1 ≤ harmonics ≤ 15", 1.0 <= asked && asked <= 15.0)
}

/// The phase of a point of a cycle.
pub(super) fn phase(point: i32) -> f64 {
    core::f64::consts::TAU * f64::from(point) / f64::from(POINTS)
}

/// The harmonics of stresses at equal phases of one cycle.
pub(super) fn harmonics_of(stresses: &[ShearStresses], amplitude: f64, harmonics: usize) -> Oscillation {
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
