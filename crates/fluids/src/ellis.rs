//! Ellis' fluid: the rate is explicit in the stress.

use piola_numerics::{Dual, Real, parameters};

use super::answers::{Relation, finite_rate, moment_of_power, moving, solve_from_above};
use super::parameters::{Parameters, listed};
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

parameters! {
    FluidsError;
    /// Ellis' fluid: linear at small stresses, a power law at large ones; the rate is explicit in the stress.
    ///
    /// ```text
    /// k = (τ/η₀) (1 + |τ/τ½|^(α − 1))
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | η₀ | `zero_rate_viscosity` | Pa s | 0 < η₀ |
    /// | τ½ | `half_stress`, at which the viscosity is η₀/2 | Pa | 0 < τ½ |
    /// | α | `exponent` | – | 1 ≤ α; 1/α is the exponent of the power law |
    ///
    /// All moments of ζ are closed. τ is found by Newton's method on a convex function.
    ///
    /// # Accuracy
    /// ζ and the moments: 4 ulp beyond the rounding of τ/τ½ to a power; τ: 4 ulp.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Ellis, ViscometricFluid};
    /// let solution = Ellis::new(4.0, 2.0, 3.0)?;
    /// assert_eq!(solution.shear_rate(4.0)?, 5.0); // 1 + (4/2)²
    /// assert_eq!(solution.shear_stress(-5.0), -4.0);
    /// assert_eq!(solution.viscosity(0.0), 4.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// S. Matsuhisa, R. B. Bird, A. I. Ch. E. Journal 11 (1965) 588; an example of the function ζ of W(23.42).
    pub struct Ellis("Ellis") {
        /// η₀, Pa s.
        zero_rate_viscosity: "0 < η₀" => 0.0 < zero_rate_viscosity,
        /// τ½, Pa.
        half_stress: "0 < τ½" => 0.0 < half_stress,
        /// α.
        exponent: "1 ≤ α" => 1.0 <= exponent,
    }
}

/// x = y + y^α, the rate and the stress in units of τ½.
struct Flow<T> {
    exponent: T,
}

impl<T: Real> Relation<T> for Flow<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at(&self, y: Dual<T>) -> Dual<T> {
        y + y.powf(Dual::constant(self.exponent))
    }
}

listed! {
    Ellis<3>: zero_rate_viscosity, half_stress, exponent;
    |[zero, half, exponent], shear_rate| {
        let x = zero * shear_rate / half;
        let (rest, size) = moving(x);
        // y ≤ x and y^α ≤ x.
        let start = T::select(rest, T::one(), size.min(size.powf(exponent.recip())));
        half * solve_from_above(&Flow { exponent }, x, start)
    }
}

impl ViscometricFluid for Ellis {
    const NAME: &'static str = Self::NAME;
    const CLOSED_RATE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let stress = Self::shear_stress_of(self.parameters().map(T::lit), shear_rate.abs());
        T::select(shear_rate.less_than(T::zero()), -stress, stress)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        let share = (shear_stress.abs() / T::lit(self.half_stress)).powf(T::lit(self.exponent - 1.0));
        let rate = shear_stress / T::lit(self.zero_rate_viscosity) * (T::one() + share);
        finite_rate::<Self, T>(shear_stress, rate)
    }

    /// ∫ sᵖ⁺¹ ds/η₀ + ∫ sᵖ⁺¹ (s/τ½)^(α − 1) ds/η₀.
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let power = moment.power() + 2;
        let sum = moment_of_power(power, 0.0, 1.0, from, to)
            + moment_of_power(power, self.exponent - 1.0, self.half_stress, from, to);
        Some(sum / self.zero_rate_viscosity)
    }
}
