//! The Newtonian fluid in shear.

use piola_numerics::{Real, parameters};

use super::answers::finite_rate;
use super::parameters::{Parameters, listed};
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

parameters! {
    FluidsError;
    /// The incompressible Newtonian fluid.
    ///
    /// ```text
    /// τ = μ k      T = −p 1 + 2 μ D
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `viscosity_coefficient` | Pa s | 0 < μ |
    ///
    /// # Accuracy
    /// One rounding.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Newtonian, ViscometricFluid};
    /// let water = Newtonian::new(0.001)?;
    /// assert_eq!(water.shear_stress(50.0), 0.05);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// W(19.33), written there with μ for the field's 2 μ.
    pub struct Newtonian("Newtonian") {
        /// μ, Pa s.
        viscosity_coefficient: "0 < μ" => 0.0 < viscosity_coefficient,
    }
}

listed! {
    Newtonian<1>: viscosity_coefficient;
    |[mu], shear_rate| mu * shear_rate
}

impl ViscometricFluid for Newtonian {
    const NAME: &'static str = Self::NAME;
    const CLOSED_RATE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        Self::shear_stress_of(self.parameters().map(T::lit), shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        finite_rate::<Self, T>(shear_stress, shear_stress / T::lit(self.viscosity_coefficient))
    }

    /// (toᵖ⁺² − fromᵖ⁺²)/((p + 2) μ).
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let (sum, width) = (to + from, to - from);
        let difference = match moment {
            FlowMoment::Reciprocal => width,
            FlowMoment::Zeroth => width * (sum / 2.0),
            FlowMoment::First => width * ((to * to + to * from + from * from) / 3.0),
            FlowMoment::Second => width * (sum * (to * to + from * from) / 4.0),
        };
        Some(difference / self.viscosity_coefficient)
    }
}
