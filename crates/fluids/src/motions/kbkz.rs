//! K-BKZ fluids: start and stop of shear, steady flows of any kind, motions and samples, oscillations.

use piola_continuum::rates::{
    HomogeneousMotion, RelativeDeformation, VelocityGradient, exponential_minus_identity_rows, exponential_rows,
    logarithm,
};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::linear::matrix3::{inverse_and_determinant, rows_of};
use piola_tensor::internal::rows::{Rows, product, product_transposed, scaled, sum};

use super::oscillation::{Oscillation, POINTS, check_oscillation, harmonics_of, phase};
use super::quadrature::{integrate, integrate_between};
use super::shear_stresses::ShearStresses;
use crate::error::{check_bound, check_finite};
use crate::{Damping, FluidsError, Integral, Kbkz, Relaxation};

/// s over the longest λ beyond which nothing is remembered of a strain that does not grow: e^(−665).
const HORIZON: f64 = 665.0;
/// ln of the s/λ beyond which nothing of a history is remembered.
const HEIGHT: f64 = 6.5;
/// The largest modulus of the entries of exp(± s L) that a strain is formed of.
const LARGEST: f64 = 1e90;

/// Cₜ⁻¹ − 1, tr Cₜ⁻¹ − 3 and tr Cₜ − 3, from Fₜ − 1 and its inverse's change: no large numbers are subtracted, nor small ones from 1.
fn strains(change: Rows<f64>, inverse_change: Rows<f64>) -> (Symmetric, f64, f64) {
    let of = |d: Rows<f64>, square: Rows<f64>| Symmetric::symmetric_part(sum(square, sum(d, d)));
    let strain = of(inverse_change, product_transposed(inverse_change, inverse_change));
    let other = of(change, product_transposed(change, change));
    (strain, strain.trace().max(0.0), other.trace().max(0.0))
}

/// F⁻¹ − 1 from F − 1.
fn inverse_change(change: Rows<f64>) -> Rows<f64> {
    let mut gradient = change;
    for (i, row) in gradient.iter_mut().enumerate() {
        row[i] += 1.0;
    }
    scaled(product(inverse_and_determinant(gradient).0, change), -1.0)
}

impl<H: Damping> Kbkz<H> {
    /// T + p 1, Pa, now, from the history Cₜ⁻¹(t − s) of a motion that began from rest `age` seconds ago; ∞ for one that lasts
    /// since always.
    ///
    /// By adaptive quadrature in ln s, with its error bound. The motion must be smooth within (0, age).
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] unless 0 < age.
    pub fn stress_of_history(
        &self,
        inverse: impl Fn(f64) -> Symmetric,
        age: f64,
    ) -> Result<Integral<Symmetric>, FluidsError> {
        let end = if age < f64::INFINITY { age } else { HEIGHT.exp() * self.longest() };
        check_bound(H::NAME, "age", end, "0 < age", 0.0 < end)?;
        let damped = |s: f64| {
            let inverse = inverse(s);
            let strain = inverse - Symmetric::identity();
            // tr C = tr of the inverse, where det C = 1: the second invariant of C⁻¹.
            let second = 0.5 * (inverse.trace() * inverse.trace() - inverse.double_contraction(&inverse)) - 3.0;
            strain * self.damping().factor(strain.trace().max(0.0), second.max(0.0))
        };
        let remembered = integrate(|s| (damped(s) * self.memory_function(s)).components, end);
        let older = if age < f64::INFINITY { damped(age) * self.relaxation_modulus(age) } else { Symmetric::zero() };
        let value = Symmetric { components: remembered.value } + older;
        Ok(remembered.within(value, value.norm()))
    }

    /// The stresses at the time t after the start of shear at the rate k from rest, and the bound of their errors.
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`]; [`FluidsError::OutOfBounds`] unless 0 < t.
    pub fn start_up(&self, shear_rate: f64, t: f64) -> Result<Integral<ShearStresses>, FluidsError> {
        check_finite(H::NAME, "shear rate", shear_rate)?;
        check_bound(H::NAME, "time", t, "0 < time", 0.0 < t)?;
        let parts = |strain: f64| {
            let damped = self.damping().factor(strain * strain, strain * strain);
            [damped * strain, damped * strain * strain]
        };
        let remembered = integrate(|s| parts(shear_rate * s).map(|part| self.memory_function(s) * part), t);
        let older = parts(shear_rate * t).map(|part| self.relaxation_modulus(t) * part);
        let value =
            ShearStresses { shear: remembered.value[0] + older[0], first: remembered.value[1] + older[1], second: 0.0 };
        Ok(remembered.within(value, value.shear.abs().max(value.first)))
    }

    /// The stresses at the time t after the end of a long steady shear at the rate k, and the bound of their errors.
    ///
    /// ```text
    /// ∫ m(t + s) h(k² s²) (k s, k² s²) ds
    /// ```
    ///
    /// # Errors
    /// As [`start_up`](Self::start_up).
    pub fn cessation(&self, shear_rate: f64, t: f64) -> Result<Integral<ShearStresses>, FluidsError> {
        check_finite(H::NAME, "shear rate", shear_rate)?;
        check_bound(H::NAME, "time", t, "0 < time", 0.0 < t)?;
        let left = integrate(
            |s| {
                let strain = shear_rate * s;
                let damped = self.memory_function(t + s) * self.damping().factor(strain * strain, strain * strain);
                [damped * strain, damped * strain * strain]
            },
            HEIGHT.exp() * self.longest(),
        );
        let value = ShearStresses { shear: left.value[0], first: left.value[1], second: 0.0 };
        Ok(left.within(value, value.shear.abs().max(value.first)))
    }

    /// T₁₂ and N₁ at the time t after a step of shear γ: G(t) h γ and G(t) h γ².
    #[must_use]
    pub fn step_strain(&self, strain: f64, t: f64) -> ShearStresses {
        let damped = self.relaxation_modulus(t) * self.damping().factor(strain * strain, strain * strain);
        ShearStresses { shear: damped * strain, first: damped * strain * strain, second: 0.0 }
    }

    /// The longest λ, s.
    fn longest(&self) -> f64 {
        self.memory().iter().map(|term| term.time).fold(0.0, f64::max)
    }

    /// (Cₜ⁻¹ − 1) h, from Fₜ − 1 and the change of its inverse.
    fn damped(&self, change: Rows<f64>, inverse_change: Rows<f64>) -> Symmetric {
        let (strain, first, second) = strains(change, inverse_change);
        strain * self.damping().factor(first, second)
    }

    /// T + p 1, Pa, in a steady motion with the velocity gradient L since always, and the bound of its error.
    ///
    /// ```text
    /// ∫ m(s) h (exp(s L) exp(s L)ᵀ − 1) ds
    /// ```
    /// By adaptive quadrature in ln s; of strains that grow beyond 10⁹⁰ the rest is that of an exponential.
    ///
    /// # Errors
    /// [`FluidsError::BeyondLimit`] where the damped strain grows faster than it is forgotten; without damping that is
    /// where an eigenvalue of 2 λ L is 1 or more.
    pub fn steady_stress(&self, velocity_gradient: &VelocityGradient) -> Result<Integral<Symmetric>, FluidsError> {
        let l = velocity_gradient.rows();
        let at = |s: f64| {
            let changes = [-s, s].map(|s| exponential_minus_identity_rows(scaled(l, s)));
            self.damped(changes[0], changes[1])
        };
        let within = |s: f64| {
            [-s, s].into_iter().all(|s| exponential_rows(scaled(l, s)).as_flattened().iter().all(|x| x.abs() < LARGEST))
        };
        let longest = self.longest();
        let mut end = HORIZON * longest;
        if !within(end) {
            let (mut low, mut high) = (0.0, end);
            for _ in 0..200 {
                let middle = f64::midpoint(low, high);
                (low, high) = if within(middle) { (middle, high) } else { (low, middle) };
                if high - low <= 1e-3 * high {
                    break;
                }
            }
            end = low;
        }
        let remembered = integrate(|s| (at(s) * self.memory_function(s)).components, end);
        let (last, before) = (at(end), at(0.9 * end).norm());
        let growth = if 0.0 < last.norm() && 0.0 < before { (last.norm() / before).ln() / (0.1 * end) } else { 0.0 };
        let rate = growth * longest;
        if 1.0 <= rate {
            let (law, quantity) = (H::NAME, "λ times the rate at which the damped strain grows");
            return Err(FluidsError::BeyondLimit { law, quantity, value: rate, limit: 1.0 });
        }
        let rest: f64 = self
            .memory()
            .iter()
            .map(|term| term.viscosity / term.time * (-end / term.time).exp() / (1.0 - growth.max(0.0) * term.time))
            .sum();
        let value = Symmetric { components: remembered.value } + last * rest;
        Ok(remembered.within(value, value.norm()))
    }

    /// T + p 1, Pa, at the time t of a motion that began from rest at t = 0, and the bound of its error.
    ///
    /// By adaptive quadrature in ln s; the motion must be smooth within (0, t) and isochoric.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] unless 0 < t.
    pub fn stress_along(&self, motion: &impl HomogeneousMotion, t: f64) -> Result<Integral<Symmetric>, FluidsError> {
        check_bound(H::NAME, "time", t, "0 < time", 0.0 < t)?;
        let at = |s: f64| {
            let change = rows_of(&motion.relative_displacement(t, -s));
            self.damped(change, inverse_change(change))
        };
        let remembered = integrate(|s| (at(s) * self.memory_function(s)).components, t);
        let value = Symmetric { components: remembered.value } + at(t) * self.relaxation_modulus(t);
        Ok(remembered.within(value, value.norm()))
    }

    /// T + p 1, Pa, at the last of the `samples` (t, s, and F), of a body at rest before the first, and the bound of the error
    /// of the quadrature.
    ///
    /// Between two samples the velocity gradient is taken as constant.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] for fewer than two samples, and unless the times grow;
    /// [`FluidsError::Continuum`] where two samples are half a turn or more apart.
    pub fn stress_of_samples(
        &self,
        samples: &[(f64, DeformationGradient)],
    ) -> Result<Integral<Symmetric>, FluidsError> {
        let count = samples.len() as f64;
        check_bound(H::NAME, "number of samples", count, "2 ≤ number", 2.0 <= count)?;
        let mut total = Integral { value: Symmetric::zero(), bound: 0.0, evaluations: 0 };
        // F at the end of an interval relative to now, less 1.
        let (mut later, mut elapsed) = ([[0.0; 3]; 3], 0.0);
        for pair in samples.windows(2).rev() {
            let [(before, first), (t, second)] = pair else { continue };
            check_bound(H::NAME, "time", *t, "each time is later than the one before", before < t)?;
            let step = RelativeDeformation::of(first, second)?;
            let l = rows_of(&(logarithm(step.displacement.matrix())? / (t - before)));
            let at = |s: f64| {
                // Fₜ = exp(−L (s − elapsed)) Fₜ(end).
                let back = exponential_minus_identity_rows(scaled(l, elapsed - s));
                sum(sum(back, later), product(back, later))
            };
            let f = |s: f64| {
                let change = at(s);
                (self.damped(change, inverse_change(change)) * self.memory_function(s)).components
            };
            let next = elapsed + (t - before);
            let part = if elapsed <= 0.0 { integrate(f, next) } else { integrate_between(f, elapsed, next) };
            total.value += Symmetric { components: part.value };
            total.bound += part.bound;
            total.evaluations += part.evaluations;
            later = at(next);
            elapsed = next;
        }
        total.value += self.damped(later, inverse_change(later)) * self.relaxation_modulus(elapsed);
        Ok(total.within(total.value, total.value.norm()))
    }

    /// The response to the oscillating shear γ = γ₀ sin ω t since always, with `harmonics` of each kind.
    ///
    /// Within a cycle the memory is that of all cycles before, Σ (η/λ²) e^(−s/λ)/(1 − e^(−2 π/(λ ω))).
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] unless 0 < γ₀, 0 < ω, 1 ≤ `harmonics` ≤ 15.
    ///
    /// # Accuracy
    /// That of quadrature, 1e-12; harmonics beyond the 63rd are taken for lower ones.
    pub fn oscillation(
        &self,
        amplitude: f64,
        angular_frequency: f64,
        harmonics: usize,
    ) -> Result<Oscillation, FluidsError> {
        check_oscillation(H::NAME, amplitude, angular_frequency, harmonics)?;
        let period = core::f64::consts::TAU / angular_frequency;
        let memory = |s: f64| -> f64 {
            let term = |term: &Relaxation| {
                term.viscosity / term.time * (-s / term.time).exp() / term.time / -(-period / term.time).exp_m1()
            };
            self.memory().iter().map(term).sum()
        };
        let mut stresses = [ShearStresses::default(); POINTS as usize];
        for (point, stresses) in (0..POINTS).zip(&mut stresses) {
            // sin ω t − sin ω (t − s).
            let integral = integrate(
                |s| {
                    let half = 0.5 * angular_frequency * s;
                    let strain = 2.0 * amplitude * (phase(point) - half).cos() * half.sin();
                    let damped = memory(s) * self.damping().factor(strain * strain, strain * strain);
                    [damped * strain, damped * strain * strain]
                },
                period,
            );
            *stresses = ShearStresses { shear: integral.value[0], first: integral.value[1], second: 0.0 };
        }
        Ok(harmonics_of(&stresses, amplitude, harmonics))
    }
}
