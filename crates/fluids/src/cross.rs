//! Cross's fluid.

use piola_numerics::{Real, parameters};

use super::answers::moving;
use super::parameters::{Parameters, listed};
use super::viscometric::ViscometricFluid;

parameters! {
    FluidsError;
    /// Cross's fluid: two plateaus of the viscosity.
    ///
    /// ```text
    /// τ = η k      η = η∞ + (η₀ − η∞)/(1 + (λ |k|)^m)
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | η₀ | `zero_rate_viscosity` | Pa s | 0 < η₀ |
    /// | η∞ | `infinite_rate_viscosity` | Pa s | 0 ≤ η∞ |
    /// | λ | `time` | s | 0 ≤ λ |
    /// | m | `exponent` | – | 0 < m; where 1 < m: (m − 1)² (η₀ − η∞) ≤ 4 m η∞ |
    ///
    /// Within the bounds τ grows; a steeper fall of the viscosity than that would make it fall. ζ is found by Newton's method.
    ///
    /// # Accuracy
    /// 8 ulp of η beyond the rounding of λ |k| to a power, |ln λ k| ulp.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Cross, ViscometricFluid};
    /// let paint = Cross::new(9.0, 1.0, 4.0, 0.5)?;
    /// assert_eq!(paint.viscosity(2.25), 3.0); // 1 + 8/(1 + 3)
    /// let rate: f64 = paint.shear_rate(6.75)?;
    /// assert!((rate - 2.25).abs() < 1e-14);
    /// assert!(Cross::new(9.0, 0.0, 4.0, 2.0).is_err()); // τ would fall
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// M. M. Cross, J. Colloid Sci. 20 (1965) 417; an example of the functions of W(23.13). The bound on m is the least slope
    /// of τ, at (λ k)^m = (m + 1)/(m − 1).
    pub struct Cross("Cross") {
        /// η₀, Pa s.
        zero_rate_viscosity: "0 < η₀" => 0.0 < zero_rate_viscosity,
        /// η∞, Pa s.
        infinite_rate_viscosity: "0 ≤ η∞" => 0.0 <= infinite_rate_viscosity,
        /// λ, s.
        time: "0 ≤ λ" => 0.0 <= time,
        /// m.
        exponent: "0 < m, and (m − 1)² (η₀ − η∞) ≤ 4 m η∞ where 1 < m: τ grows" => 0.0 < exponent
            && (exponent <= 1.0
                || (exponent - 1.0) * (exponent - 1.0) * (zero_rate_viscosity - infinite_rate_viscosity)
                    <= 4.0 * exponent * infinite_rate_viscosity),
    }
}

/// η at |k|, 0 < |k|.
#[cfg_attr(not(debug_assertions), inline(always))]
fn viscosity_of<T: Real>([zero, infinite, time, exponent]: [T; 4], rate: T) -> T {
    let (slow, x) = moving(time * rate);
    infinite + (zero - infinite) / (T::one() + T::select(slow, T::zero(), x.powf(exponent)))
}

listed! {
    Cross<4>: zero_rate_viscosity, infinite_rate_viscosity, time, exponent;
    |parameters, shear_rate| {
        let (rest, rate) = moving(shear_rate);
        shear_rate * T::select(rest, parameters[0], viscosity_of(parameters, rate))
    }
}

impl ViscometricFluid for Cross {
    const NAME: &'static str = Self::NAME;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        let (rest, rate) = moving(shear_rate);
        let viscosity = viscosity_of(self.parameters().map(T::lit), rate);
        T::select(rest, T::lit(self.zero_rate_viscosity), viscosity)
    }
}
