//! The power law of Ostwald and de Waele.

use piola_numerics::Real;

use super::parameters::{Parameters, fluid_of_parameters};
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::ConstitutiveError;

fluid_of_parameters! {
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
    /// use piola_constitutive::fluids::{PowerLaw, ViscometricFluid};
    /// let thinning = PowerLaw::new(3.0, 0.5)?;
    /// assert_eq!(thinning.shear_stress(-4.0), -6.0);
    /// assert_eq!(thinning.shear_rate(6.0)?, 4.0);
    /// # Ok::<(), piola_constitutive::ConstitutiveError>(())
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

impl Parameters<2> for PowerLaw {
    const NAMES: [&'static str; 2] = ["consistency", "exponent"];

    fn parameters(&self) -> [f64; 2] {
        [self.consistency, self.exponent]
    }

    fn from_parameters([consistency, exponent]: [f64; 2]) -> Result<Self, ConstitutiveError> {
        Self::new(consistency, exponent)
    }

    #[inline(always)]
    fn shear_stress_of<T: Real>([consistency, exponent]: [T; 2], shear_rate: T) -> T {
        consistency * odd_power(shear_rate, exponent)
    }
}

/// |x|ⁿ sign x.
#[inline(always)]
pub(super) fn odd_power<T: Real>(x: T, exponent: T) -> T {
    let power = x.abs().powf(exponent);
    T::select(x.less_than(T::zero()), -power, power)
}

impl ViscometricFluid for PowerLaw {
    const NAME: &'static str = Self::NAME;

    #[inline(always)]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
    }

    #[inline(always)]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, ConstitutiveError> {
        Ok(odd_power(shear_stress / T::lit(self.consistency), T::lit(self.exponent.recip())))
    }

    /// (to^q − from^q)/(q K^(1/n)) with q = p + 1 + 1/n; the difference through its ratio, so that a narrow interval keeps its digits.
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let power = f64::from(moment.power() + 1);
        let inverse = self.exponent.recip();
        let q = power + inverse;
        // to^q = to^(p+1) K^(1/n) ζ(to): no power of a large or small number alone.
        let whole = to.powf(power) * (to / self.consistency).powf(inverse);
        let share = if from > 0.0 { -(q * ((from - to) / to).ln_1p()).exp_m1() } else { 1.0 };
        Some(if to > 0.0 { whole * share / q } else { 0.0 })
    }
}
