//! Bingham's plastic.

use piola_numerics::internal::excess_over_logarithm;
use piola_numerics::{Real, parameters};

use super::answers::{beyond, finite_rate, moment_of_power, shifted_power, signed, viscosity_with_limit};
use super::parameters::{Parameters, listed};
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

parameters! {
    FluidsError;
    /// Bingham's plastic: at rest up to a yield stress, linear beyond.
    ///
    /// ```text
    /// τ = (τᵧ + μ |k|) sign k      ζ = (|τ| − τᵧ) sign τ / μ where τᵧ < |τ|, else 0
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | τᵧ | `yield_stress` | Pa | 0 ≤ τᵧ |
    /// | μ | `plastic_viscosity` | Pa s | 0 < μ |
    ///
    /// All moments of ζ are closed.
    ///
    /// # Accuracy
    /// 2 ulp of τ and, also close to yield, of ζ; 16 ulp of the moments, in narrow intervals and close to yield too: they
    /// are sums of positive terms in s − τᵧ.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Bingham, FlowMoment, ViscometricFluid};
    /// let mud = Bingham::new(3.0, 0.5)?;
    /// assert_eq!(mud.shear_stress(-4.0), -5.0);
    /// assert_eq!(mud.shear_rate(2.9)?, 0.0);
    /// assert_eq!(mud.flow_moment(FlowMoment::Zeroth, 0.0, 5.0), Some(4.0)); // a triangle: 2 Pa wide, 4/s high
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// E. C. Bingham, *Fluidity and Plasticity* (1922); an example of the functions of W(23.13).
    pub struct Bingham("Bingham") {
        /// τᵧ, Pa.
        yield_stress: "0 ≤ τᵧ" => 0.0 <= yield_stress,
        /// μ, Pa s.
        plastic_viscosity: "0 < μ" => 0.0 < plastic_viscosity,
    }
}

listed! {
    Bingham<2>: yield_stress, plastic_viscosity;
    |[yield_stress, viscosity], shear_rate| yield_stress + viscosity * shear_rate
}

impl ViscometricFluid for Bingham {
    const NAME: &'static str = Self::NAME;
    const CLOSED_RATE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        signed(shear_rate, T::lit(self.yield_stress)) + T::lit(self.plastic_viscosity) * shear_rate
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn yield_stress(&self) -> f64 {
        self.yield_stress
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        let limit = if 0.0 < self.yield_stress { f64::INFINITY } else { self.plastic_viscosity };
        viscosity_with_limit(self, shear_rate, limit)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        let rate = if 0.0 < self.yield_stress {
            signed(shear_stress, beyond(shear_stress, T::lit(self.yield_stress)))
        } else {
            shear_stress
        };
        finite_rate::<Self, T>(shear_stress, rate / T::lit(self.plastic_viscosity))
    }

    /// With u = s − τᵧ: ∫ (τᵧ + u)ᵖ u du/μ, expanded; for p = −1 the difference w − τᵧ ln(1 + w/a) over [a, a + w] as
    /// w (a − τᵧ)/a + τᵧ (w/a − ln(1 + w/a)).
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let start = from.max(self.yield_stress);
        if to <= start {
            return Some(0.0);
        }
        let (lower, upper, width) = (start - self.yield_stress, to - self.yield_stress, to - start);
        let sum = match shifted_power(moment, self.yield_stress) {
            Some((coefficients, count)) => (0..count)
                .zip(2..)
                .map(|(i, power)| coefficients[i] * moment_of_power(power, 0.0, 1.0, lower, upper))
                .sum(),
            None if 0.0 < start => width * lower / start + self.yield_stress * excess_over_logarithm(width / start),
            None => width,
        };
        Some(sum / self.plastic_viscosity)
    }
}
