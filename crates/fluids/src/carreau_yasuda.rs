//! The fluid of Carreau and Yasuda.

use piola_numerics::{Mask, Real, parameters};

use super::answers::moving;
use super::parameters::{Parameters, listed};
use super::viscometric::ViscometricFluid;

parameters! {
    FluidsError;
    /// The fluid of Carreau and Yasuda: two plateaus of the viscosity and a power law between them.
    ///
    /// ```text
    /// τ = η k      η = η∞ + (η₀ − η∞) (1 + (λ |k|)^a)^((n − 1)/a)
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | η₀ | `zero_rate_viscosity` | Pa s | 0 < η₀ |
    /// | η∞ | `infinite_rate_viscosity` | Pa s | 0 ≤ η∞; η∞ ≤ η₀ where 1 < n |
    /// | λ | `time` | s | 0 ≤ λ |
    /// | n | `exponent` | – | 0 < n |
    /// | a | `transition` | – | 0 < a; 2 is Carreau's fluid |
    ///
    /// Within the bounds τ grows. ζ is found by Newton's method.
    ///
    /// # Accuracy
    /// 8 ulp of η beyond the rounding of λ |k| to a power, |ln λ k| ulp; no overflow of (λ |k|)^a.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{CarreauYasuda, ViscometricFluid};
    /// let melt = CarreauYasuda::new(8.0, 0.0, 1.0, 0.5, 1.0)?;
    /// assert_eq!(melt.viscosity(3.0), 4.0); // 8/√4
    /// assert_eq!(melt.viscosity(0.0), 8.0);
    /// let rate: f64 = melt.shear_rate(12.0)?;
    /// assert!((rate - 3.0).abs() < 1e-14);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// P. J. Carreau, Trans. Soc. Rheol. 16 (1972) 99; K. Yasuda, thesis (MIT, 1979); an example of the functions of W(23.13).
    pub struct CarreauYasuda("Carreau-Yasuda") {
        /// η₀, Pa s.
        zero_rate_viscosity: "0 < η₀" => 0.0 < zero_rate_viscosity,
        /// η∞, Pa s.
        infinite_rate_viscosity: "0 ≤ η∞, and η∞ ≤ η₀ where 1 < n: τ grows" =>
            0.0 <= infinite_rate_viscosity && (exponent <= 1.0 || infinite_rate_viscosity <= zero_rate_viscosity),
        /// λ, s.
        time: "0 ≤ λ" => 0.0 <= time,
        /// n.
        exponent: "0 < n" => 0.0 < exponent,
        /// a.
        transition: "0 < a" => 0.0 < transition,
    }
}

/// η at |k|, 0 < |k|.
#[cfg_attr(not(debug_assertions), inline(always))]
fn viscosity_of<T: Real>([zero, infinite, time, exponent, transition]: [T; 5], rate: T) -> T {
    let (slow, x) = moving(time * rate);
    // (1 + x^a)^(1/a) = x (1 + x^−a)^(1/a): the power formed is at most one.
    let large = T::one().less_than(x);
    let y = T::select(large, x.recip(), x);
    let power = (exponent - T::one()) / transition;
    let near = (power * y.powf(transition).ln_1p()).exp();
    let share = if large.any() {
        T::select(large, T::select(large, x, T::one()).powf(exponent - T::one()) * near, near)
    } else {
        near
    };
    infinite + (zero - infinite) * T::select(slow, T::one(), share)
}

listed! {
    CarreauYasuda<5>: zero_rate_viscosity, infinite_rate_viscosity, time, exponent, transition;
    |parameters, shear_rate| {
        let (rest, rate) = moving(shear_rate);
        shear_rate * T::select(rest, parameters[0], viscosity_of(parameters, rate))
    }
}

impl ViscometricFluid for CarreauYasuda {
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
