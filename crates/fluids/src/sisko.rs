//! Sisko's fluid.

use piola_numerics::{Real, parameters};

use super::parameters::{Parameters, listed};
use super::power_law::odd_power;
use super::viscometric::{FlowMoment, ViscometricFluid};

parameters! {
    FluidsError;
    /// Sisko's fluid: a power law and a Newtonian fluid side by side; greases.
    ///
    /// ```text
    /// τ = η∞ k + K |k|ⁿ sign k
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | η∞ | `infinite_rate_viscosity` (of n < 1) | Pa s | 0 < η∞ |
    /// | K | `consistency` | Pa sⁿ | 0 ≤ K |
    /// | n | `exponent` | – | 0 < n |
    ///
    /// ζ is found by Newton's method; the moments ∫ sᵖ ζ ds = ∫ τᵖ k dτ, 0 ≤ p, are closed in the rate where the lower end's
    /// is at most half the upper's.
    ///
    /// # Accuracy
    /// τ: as the power law. Moments: that of ζ.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Sisko, ViscometricFluid};
    /// let grease = Sisko::new(0.5, 3.0, 0.5)?;
    /// assert_eq!(grease.shear_stress(4.0), 8.0);
    /// let rate: f64 = grease.shear_rate(8.0)?;
    /// assert!((rate - 4.0).abs() < 1e-14);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// A. W. Sisko, Ind. Eng. Chem. 50 (1958) 1789; an example of the functions of W(23.13).
    pub struct Sisko("Sisko") {
        /// η∞, Pa s.
        infinite_rate_viscosity: "0 < η∞" => 0.0 < infinite_rate_viscosity,
        /// K, Pa sⁿ.
        consistency: "0 ≤ K" => 0.0 <= consistency,
        /// n.
        exponent: "0 < n" => 0.0 < exponent,
    }
}

listed! {
    Sisko<3>: infinite_rate_viscosity, consistency, exponent;
    |[infinite, consistency, exponent], shear_rate|
        infinite * shear_rate + consistency * odd_power(shear_rate, exponent)
}

impl ViscometricFluid for Sisko {
    const NAME: &'static str = Self::NAME;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
    }

    /// ∫ τᵖ k τ′ dk, expanded in powers of k.
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let (a, b) = (self.shear_rate(from).ok()?, self.shear_rate(to).ok()?);
        if b / 2.0 < a {
            return None;
        }
        let n = self.exponent;
        // Each stress as a whole: η k and K kⁿ; the integral of k^q is k^(q + 1)/(q + 1).
        let primitive = |k: f64| {
            let (linear, power) = (self.infinite_rate_viscosity * k, self.consistency * k.powf(n));
            let sum = match moment {
                FlowMoment::Reciprocal => return None,
                FlowMoment::Zeroth => linear / 2.0 + n * power / (n + 1.0),
                FlowMoment::First => {
                    linear * linear / 3.0 + (1.0 + n) * linear * power / (n + 2.0) + n * power * power / (2.0 * n + 1.0)
                }
                FlowMoment::Second => {
                    linear * linear * linear / 4.0
                        + (n + 2.0) * linear * linear * power / (n + 3.0)
                        + (2.0 * n + 1.0) * linear * power * power / (2.0 * n + 2.0)
                        + n * power * power * power / (3.0 * n + 1.0)
                }
            };
            Some(k * sum)
        };
        Some(primitive(b)? - primitive(a)?)
    }
}
