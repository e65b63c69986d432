//! Papanastasiou's regularised plastic.

use piola_numerics::{Real, parameters};

use super::answers::viscosity_with_limit;
use super::parameters::{Parameters, listed};
use super::power_law::odd_power;
use super::viscometric::ViscometricFluid;

parameters! {
    FluidsError;
    /// Papanastasiou's plastic: that of Herschel and Bulkley, with a yield stress that grows with the rate instead of a jump.
    ///
    /// ```text
    /// τ = K |k|ⁿ sign k + τᵧ (1 − exp(−m |k|)) sign k
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | τᵧ | `apparent_yield_stress` | Pa | 0 ≤ τᵧ |
    /// | K | `consistency` | Pa sⁿ | 0 < K |
    /// | n | `exponent`; 1 for Bingham's plastic | – | 0 < n |
    /// | m | `growth_time` | s | 0 < m |
    ///
    /// It flows at every stress: its [yield stress](ViscometricFluid::yield_stress) is zero. ζ is found by Newton's method.
    ///
    /// # Accuracy
    /// τ: as the power law; no cancellation at m k → 0.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Papanastasiou, ViscometricFluid};
    /// let cement = Papanastasiou::new(10.0, 2.0, 1.0, 100.0)?;
    /// assert_eq!(cement.viscosity(0.0), 1002.0); // 2 + 10 · 100
    /// assert_eq!(cement.shear_stress(5.0), 20.0); // as Bingham's
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// T. C. Papanastasiou, J. Rheol. 31 (1987) 385; an example of the functions of W(23.13).
    pub struct Papanastasiou("Papanastasiou") {
        /// τᵧ, Pa.
        apparent_yield_stress: "0 ≤ τᵧ" => 0.0 <= apparent_yield_stress,
        /// K, Pa sⁿ.
        consistency: "0 < K" => 0.0 < consistency,
        /// n.
        exponent: "0 < n" => 0.0 < exponent,
        /// m, s.
        growth_time: "0 < m" => 0.0 < growth_time,
    }
}

listed! {
    Papanastasiou<4>: apparent_yield_stress, consistency, exponent, growth_time;
    |[yield_stress, consistency, exponent, time], shear_rate|
        consistency * odd_power(shear_rate, exponent) - yield_stress * (-(time * shear_rate)).exp_m1()
}

impl ViscometricFluid for Papanastasiou {
    const NAME: &'static str = Self::NAME;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let size = Self::shear_stress_of(self.parameters().map(T::lit), shear_rate.abs());
        T::select(shear_rate.less_than(T::zero()), -size, size)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        let plastic = self.apparent_yield_stress * self.growth_time;
        let limit = if self.exponent < 1.0 {
            f64::INFINITY
        } else if 1.0 < self.exponent {
            plastic
        } else {
            plastic + self.consistency
        };
        viscosity_with_limit(self, shear_rate, limit)
    }
}
