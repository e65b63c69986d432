//! The fluid of Prandtl and Eyring.

use piola_numerics::{Real, parameters};

use super::answers::{finite_rate, inverse_sinh};
use super::parameters::{Parameters, listed};
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

parameters! {
    FluidsError;
    /// The fluid of Prandtl and Eyring: flow by thermally activated jumps.
    ///
    /// ```text
    /// τ = τ₀ arsinh(λ k)      ζ = sinh(τ/τ₀)/λ
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | τ₀ | `stress` | Pa | 0 < τ₀ |
    /// | λ | `time` | s | 0 < λ |
    ///
    /// The viscosity at rest is τ₀ λ. ∫ ζ ds is closed; ∫ s ζ ds and ∫ s² ζ ds are where the lower end's share is at most half;
    /// ∫ ζ ds/s is left to quadrature.
    ///
    /// # Accuracy
    /// τ: 4 ulp; ζ: 4 ulp beyond the rounding of τ/τ₀; moments: 32 ulp beyond it.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Eyring, ViscometricFluid};
    /// let oil = Eyring::new(2.0, 0.5)?;
    /// assert_eq!(oil.viscosity(0.0), 1.0);
    /// assert!((oil.shear_stress(1.5) - 2.0 * 2.0_f64.ln()).abs() < 1e-15); // arsinh(3/4) = ln 2
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// H. Eyring, J. Chem. Phys. 4 (1936) 283; an example of the functions of W(23.13).
    pub struct Eyring("Eyring") {
        /// τ₀, Pa.
        stress: "0 < τ₀" => 0.0 < stress,
        /// λ, s.
        time: "0 < λ" => 0.0 < time,
    }
}

listed! {
    Eyring<2>: stress, time;
    |[stress, time], shear_rate| stress * inverse_sinh(time * shear_rate)
}

impl ViscometricFluid for Eyring {
    const NAME: &'static str = Self::NAME;
    const CLOSED_RATE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let size = Self::shear_stress_of(self.parameters().map(T::lit), shear_rate.abs());
        T::select(shear_rate.less_than(T::zero()), -size, size)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        let rate = (shear_stress / T::lit(self.stress)).sinh() / T::lit(self.time);
        finite_rate::<Self, T>(shear_stress, rate)
    }

    /// With x = s/τ₀: τ₀ᵖ⁺¹/λ ∫ xᵖ sinh x dx.
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let (a, b) = (from / self.stress, to / self.stress);
        let integral = match moment {
            FlowMoment::Reciprocal => return None,
            FlowMoment::Zeroth => 2.0 * f64::midpoint(b, a).sinh() * ((to - from) / self.stress / 2.0).sinh(),
            FlowMoment::First | FlowMoment::Second => {
                let (below, all) = (primitive(moment.power(), a), primitive(moment.power(), b));
                if all / 2.0 < below {
                    return None;
                }
                all - below
            }
        };
        let moment = integral * self.stress.powi(moment.power() + 1) / self.time;
        moment.is_finite().then_some(moment)
    }
}

/// ∫ xᵖ sinh x dx from 0 for p = 1, 2: x cosh x − sinh x and (x² + 2) cosh x − 2 x sinh x − 2, near 0 their series.
fn primitive(p: i32, x: f64) -> f64 {
    if x < 2.0 {
        // Σ x^(p + 2 + 2 j)/((p + 2 + 2 j) (2 j + 1)!)
        let (mut term, mut sum) = (x.powi(p + 2), 0.0);
        for j in 0..20 {
            sum += term / f64::from(p + 2 + 2 * j);
            term *= x * x / f64::from((2 * j + 2) * (2 * j + 3));
        }
        return sum;
    }
    match p {
        1 => x * x.cosh() - x.sinh(),
        _ => (x * x + 2.0) * x.cosh() - 2.0 * x * x.sinh() - 2.0,
    }
}
