//! The plastic of Herschel and Bulkley.

use piola_numerics::{Real, parameters};

use super::answers::{beyond, finite_rate, moment_of_power, moving, shifted_power, signed, viscosity_with_limit};
use super::parameters::{Parameters, listed};
use super::power_law::odd_power;
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

parameters! {
    FluidsError;
    /// The plastic of Herschel and Bulkley: at rest up to a yield stress, a power law beyond.
    ///
    /// ```text
    /// τ = (τᵧ + K |k|ⁿ) sign k      ζ = ((|τ| − τᵧ)/K)^(1/n) sign τ where τᵧ < |τ|, else 0
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | τᵧ | `yield_stress` | Pa | 0 ≤ τᵧ |
    /// | K | `consistency` | Pa sⁿ | 0 < K |
    /// | n | `exponent` | – | 0 < n |
    ///
    /// The moments of ζ are closed, but for ∫ ζ ds/s with a yield stress.
    ///
    /// # Accuracy
    /// As the power law, close to yield too: ζ and the moments are those of the stress beyond yield.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{HerschelBulkley, ViscometricFluid};
    /// let ketchup = HerschelBulkley::new(10.0, 3.0, 0.5)?;
    /// assert_eq!(ketchup.shear_stress(4.0), 16.0);
    /// assert_eq!(ketchup.shear_rate(16.0)?, 4.0);
    /// assert_eq!(ketchup.shear_rate(-10.0)?, 0.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// W. H. Herschel, R. Bulkley, Kolloid-Z. 39 (1926) 291; an example of the functions of W(23.13).
    pub struct HerschelBulkley("Herschel-Bulkley") {
        /// τᵧ, Pa.
        yield_stress: "0 ≤ τᵧ" => 0.0 <= yield_stress,
        /// K, Pa sⁿ.
        consistency: "0 < K" => 0.0 < consistency,
        /// n.
        exponent: "0 < n" => 0.0 < exponent,
    }
}

listed! {
    HerschelBulkley<3>: yield_stress, consistency, exponent;
    |[yield_stress, consistency, exponent], shear_rate| yield_stress + consistency * odd_power(shear_rate, exponent)
}

impl ViscometricFluid for HerschelBulkley {
    const NAME: &'static str = Self::NAME;
    const CLOSED_RATE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let flowing = T::lit(self.consistency) * odd_power(shear_rate, T::lit(self.exponent));
        signed(shear_rate, T::lit(self.yield_stress)) + flowing
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn yield_stress(&self) -> f64 {
        self.yield_stress
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        let limit = if 0.0 < self.yield_stress || self.exponent < 1.0 {
            f64::INFINITY
        } else if 1.0 < self.exponent {
            0.0
        } else {
            self.consistency
        };
        viscosity_with_limit(self, shear_rate, limit)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        let (consistency, inverse) = (T::lit(self.consistency), T::lit(self.exponent.recip()));
        let rate = if 0.0 < self.yield_stress {
            let (rest, excess) = moving(beyond(shear_stress, T::lit(self.yield_stress)));
            signed(shear_stress, T::select(rest, T::zero(), (excess / consistency).powf(inverse)))
        } else {
            odd_power(shear_stress / consistency, inverse)
        };
        finite_rate::<Self, T>(shear_stress, rate)
    }

    /// With u = s − τᵧ: ∫ (τᵧ + u)ᵖ (u/K)^(1/n) du, expanded: terms are positive.
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let start = from.max(self.yield_stress);
        if to <= start {
            return Some(0.0);
        }
        let inverse = self.exponent.recip();
        let term = |power| {
            moment_of_power(power, inverse, self.consistency, start - self.yield_stress, to - self.yield_stress)
        };
        match shifted_power(moment, self.yield_stress) {
            Some((coefficients, count)) => {
                Some((0..count).zip(1..).map(|(i, power)| coefficients[i] * term(power)).sum())
            }
            None if 0.0 < self.yield_stress => None,
            None => Some(term(0)),
        }
    }
}
