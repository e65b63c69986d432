//! Eulerian fluids: the stress is a pressure that depends on the density.

use piola_continuum::{CauchyStress, Deformation, SecondPiola, Symmetric};
use piola_numerics::{Dual, Real, parameters};

/// An Eulerian (elastic, barotropic) fluid.
///
/// ```text
/// T = −p(ρ) 1      ρ = ρ₀/det F      S = −p J C⁻¹
/// ```
/// | symbol | method | unit |
/// |---|---|---|
/// | ρ₀ | [`reference_density`](Self::reference_density) | kg/m³ |
/// | p | [`pressure`](Self::pressure) | Pa |
/// | dp/dρ | [`pressure_slope`](Self::pressure_slope), the square of the speed of sound | m²/s² |
/// | T, S | [`cauchy`](Self::cauchy), [`second_piola`](Self::second_piola) | Pa |
///
/// # Example
/// ```
/// use piola_fluids::{EulerianFluid, Polytropic};
/// use piola_continuum::DeformationGradient;
/// let gas = Polytropic::new(1000.0, 1.25, 2.0)?;
/// let half = DeformationGradient::diagonal([0.5, 1.0, 1.0])?;
/// assert_eq!(gas.cauchy(&half).0.components[0], -4000.0); // twice the density, four times the pressure
/// assert_eq!(gas.pressure_slope(1.25), 1600.0); // γ p/ρ
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// W(19.34).
pub trait EulerianFluid {
    /// ρ₀, kg/m³, where det F = 1.
    #[must_use]
    fn reference_density(&self) -> f64;

    /// p, Pa, at the density ρ, kg/m³.
    #[must_use]
    fn pressure<T: Real>(&self, density: T) -> T;

    /// dp/dρ, m²/s², the exact derivative of the pressure.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn pressure_slope<T: Real>(&self, density: T) -> T {
        self.pressure(Dual::variable(density)).tangent
    }

    /// ρ = ρ₀/det F, kg/m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn density<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        T::lit(self.reference_density()) / deformation.jacobian()
    }

    /// T = −p 1, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn cauchy<T: Real>(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(Symmetric::identity() * -self.pressure(self.density(deformation)))
    }

    /// S = −p J C⁻¹, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn second_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.cauchy(deformation).second_piola(deformation)
    }
}

parameters! {
    FluidsError;
    /// The polytropic gas.
    ///
    /// ```text
    /// p = p₀ (ρ/ρ₀)^γ
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | p₀ | `initial_pressure` | Pa | 0 < p₀ |
    /// | ρ₀ | `initial_density`, where det F = 1 | kg/m³ | 0 < ρ₀ |
    /// | γ | `exponent`; 1 at constant temperature | – | 0 < γ |
    ///
    /// # Accuracy
    /// 4 ulp beyond the rounding of the power, γ |ln (ρ/ρ₀)| ulp.
    ///
    /// # Example
    /// See [`EulerianFluid`].
    ///
    /// # Source
    /// An example of W(19.34).
    pub struct Polytropic("polytropic gas") {
        /// p₀, Pa.
        initial_pressure: "0 < p₀" => 0.0 < initial_pressure,
        /// ρ₀, kg/m³.
        initial_density: "0 < ρ₀" => 0.0 < initial_density,
        /// γ.
        exponent: "0 < γ" => 0.0 < exponent,
    }
}

impl EulerianFluid for Polytropic {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn reference_density(&self) -> f64 {
        self.initial_density
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pressure<T: Real>(&self, density: T) -> T {
        T::lit(self.initial_pressure) * (density / T::lit(self.initial_density)).powf(T::lit(self.exponent))
    }
}
