//! The power law of Ostwald and de Waele.

use piola_numerics::{Real, parameters};

use super::answers::{finite_rate, moment_of_power, moving};
use super::parameters::{Parameters, listed};
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

parameters! {
    FluidsError;
    /// The power law of Ostwald and de Waele.
    ///
    /// ```text
    /// τ = K |k|ⁿ sign k
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | K | `consistency` | Pa sⁿ | 0 < K |
    /// | n | `exponent` | – | 0 < n |
    ///
    /// # Accuracy
    /// 4 ulp of τ and ζ beyond the rounding of the exponent, |ln k| ulp.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{PowerLaw, ViscometricFluid};
    /// let thinning = PowerLaw::new(3.0, 0.5)?;
    /// assert_eq!(thinning.shear_stress(-4.0), -6.0);
    /// assert_eq!(thinning.shear_rate(6.0)?, 4.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// An example of the functions of W(23.13).
    pub struct PowerLaw("power law") {
        /// K, Pa sⁿ.
        consistency: "0 < K" => 0.0 < consistency,
        /// n.
        exponent: "0 < n" => 0.0 < exponent,
    }
}

listed! {
    PowerLaw<2>: consistency, exponent;
    |[consistency, exponent], shear_rate| consistency * odd_power(shear_rate, exponent)
}

/// |x|ⁿ sign x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn odd_power<T: Real>(x: T, exponent: T) -> T {
    let size = x.abs();
    // At rest the power of a constant has no derivative, where the chain rule would make 0 · ∞ of it.
    let power = if 0 < T::ORDER && x == x.frozen() {
        let (rest, size) = moving(size);
        T::select(rest, T::zero(), size.powf(exponent))
    } else {
        size.powf(exponent)
    };
    T::select(x.less_than(T::zero()), -power, power)
}

impl ViscometricFluid for PowerLaw {
    const NAME: &'static str = Self::NAME;
    const CLOSED_RATE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        let rate = odd_power(shear_stress / T::lit(self.consistency), T::lit(self.exponent.recip()));
        finite_rate::<Self, T>(shear_stress, rate)
    }

    /// (to^q − from^q)/(q K^(1/n)) with q = p + 1 + 1/n; the difference through its ratio, so that a narrow interval keeps its digits.
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let power = moment.power() + 1;
        Some(moment_of_power(power, self.exponent.recip(), self.consistency, from, to))
    }
}
