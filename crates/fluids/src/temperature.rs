//! Temperature: every time of a fluid shrinks by one factor.

use piola_numerics::{Real, parameters};

use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;
use crate::error::check_bound;

/// The molar gas constant R, J/(mol K), exact by the definition of the unit.
const GAS_CONSTANT: f64 = 8.314_462_618_153_24;

/// Shift of the times of a fluid with its temperature.
pub trait TemperatureShift {
    /// Its name in errors.
    const NAME: &'static str;

    /// ln aₜ at the temperature, K.
    ///
    /// # Errors
    /// [`FluidsError::OutOfBounds`] outside the temperatures for which it is meant.
    fn logarithm(&self, temperature: f64) -> Result<f64, FluidsError>;

    /// aₜ: times at the temperature, K, in units of those at the reference temperature.
    ///
    /// # Errors
    /// As [`logarithm`](Self::logarithm).
    fn factor(&self, temperature: f64) -> Result<f64, FluidsError> {
        Ok(self.logarithm(temperature)?.exp())
    }

    /// The fluid at another temperature than that, the reference, for which it is given.
    ///
    /// # Errors
    /// As [`logarithm`](Self::logarithm), and [`FluidsError::OutOfBounds`] where aₜ is not a number beyond zero.
    fn shifted<F: ViscometricFluid>(&self, fluid: F, temperature: f64) -> Result<Shifted<F>, FluidsError> {
        Shifted::new(fluid, self.factor(temperature)?)
    }
}

parameters! {
    FluidsError;
    /// The shift of Arrhenius: jumps over a barrier, far above the glass transition.
    ///
    /// ```text
    /// ln aₜ = (E/R) (1/θ − 1/θ₀)
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | E | `activation_energy` | J/mol | 0 ≤ E |
    /// | θ₀ | `reference_temperature` | K | 0 < θ₀ |
    ///
    /// # Accuracy
    /// 4 ulp of ln aₜ, near θ₀ too.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Arrhenius, Newtonian, TemperatureShift, ViscometricFluid};
    /// let shift = Arrhenius::new(8.31446261815324 * 600.0, 300.0)?;
    /// assert_eq!(shift.logarithm(400.0)?, -0.5); // 600/400 − 600/300
    /// let warm = shift.shifted(Newtonian::new(2.0)?, 400.0)?;
    /// assert!((warm.viscosity(1.0) - 2.0 * (-0.5_f64).exp()).abs() < 1e-15);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// S. Arrhenius, Z. phys. Chem. 4 (1889) 226.
    pub struct Arrhenius("Arrhenius") {
        /// E, J/mol.
        activation_energy: "0 ≤ E" => 0.0 <= activation_energy,
        /// θ₀, K.
        reference_temperature: "0 < θ₀" => 0.0 < reference_temperature,
    }
}

parameters! {
    FluidsError;
    /// The shift of Williams, Landel and Ferry: free volume, up to 100 K above the glass transition.
    ///
    /// ```text
    /// log₁₀ aₜ = −C₁ (θ − θ₀)/(C₂ + θ − θ₀)      θ₀ − C₂ < θ
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | C₁ | `strength` | – | 0 ≤ C₁ |
    /// | C₂ | `width` | K | 0 < C₂ |
    /// | θ₀ | `reference_temperature` | K | 0 < θ₀ |
    ///
    /// # Accuracy
    /// 4 ulp of ln aₜ.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{TemperatureShift, WilliamsLandelFerry};
    /// let shift = WilliamsLandelFerry::new(8.0, 100.0, 373.0)?;
    /// assert!((shift.factor(473.0)? - 1e-4).abs() < 1e-18); // 10^(−8 · 100/200)
    /// assert!(shift.factor(273.0).is_err()); // no molecule moves
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// M. L. Williams, R. F. Landel, J. D. Ferry, J. Am. Chem. Soc. 77 (1955) 3701.
    pub struct WilliamsLandelFerry("Williams-Landel-Ferry") {
        /// C₁.
        strength: "0 ≤ C₁" => 0.0 <= strength,
        /// C₂, K.
        width: "0 < C₂" => 0.0 < width,
        /// θ₀, K.
        reference_temperature: "0 < θ₀" => 0.0 < reference_temperature,
    }
}

impl TemperatureShift for Arrhenius {
    const NAME: &'static str = Self::NAME;

    fn logarithm(&self, temperature: f64) -> Result<f64, FluidsError> {
        check_bound(Self::NAME, "temperature", temperature, "0 < θ", 0.0 < temperature)?;
        let share = (self.reference_temperature - temperature) / (temperature * self.reference_temperature);
        Ok(self.activation_energy / GAS_CONSTANT * share)
    }
}

impl TemperatureShift for WilliamsLandelFerry {
    const NAME: &'static str = Self::NAME;

    fn logarithm(&self, temperature: f64) -> Result<f64, FluidsError> {
        let above = temperature - self.reference_temperature;
        let flows = 0.0 < self.width + above;
        check_bound(Self::NAME, "temperature", temperature, "θ₀ − C₂ < θ", flows)?;
        Ok(-self.strength * core::f64::consts::LN_10 * (above / (self.width + above)))
    }
}

/// A fluid all of whose times are multiplied by aₜ, with the same moduli and yield stress.
///
/// ```text
/// τ(k) = τ₀(aₜ k)      σ(k) = σ₀(aₜ k)      η(k) = aₜ η₀(aₜ k)      ζ(τ) = ζ₀(τ)/aₜ
/// ```
/// Any motion is answered by the fluid's own clock: as a `SimpleFluid` it answers as the fluid at the reference temperature does to the
/// same deformations in times 1/aₜ as long.
///
/// # Example
/// ```
/// use piola_fluids::{Bingham, Shifted, ViscometricFluid};
/// let cold = Shifted::new(Bingham::new(1.0, 2.0)?, 3.0)?;
/// assert_eq!(cold.shear_stress(0.5), 4.0); // 1 + 2 · 3 · 0.5
/// assert_eq!(cold.shear_rate(4.0)?, 0.5);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shifted<F> {
    fluid: F,
    factor: f64,
}

impl<F: ViscometricFluid> Shifted<F> {
    /// Of the fluid at the reference temperature and aₜ.
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`]; [`FluidsError::OutOfBounds`] unless 0 < aₜ.
    pub fn new(fluid: F, factor: f64) -> Result<Self, FluidsError> {
        check_bound(F::NAME, "shift factor", factor, "0 < aₜ", 0.0 < factor)?;
        Ok(Self { fluid, factor })
    }

    /// The fluid at the reference temperature.
    #[must_use]
    pub const fn fluid(&self) -> &F {
        &self.fluid
    }

    /// aₜ.
    #[must_use]
    pub const fn factor(&self) -> f64 {
        self.factor
    }
}

impl<F: ViscometricFluid> ViscometricFluid for Shifted<F> {
    const NAME: &'static str = F::NAME;
    const NORMAL_STRESSES: bool = F::NORMAL_STRESSES;
    const CLOSED_RATE: bool = F::CLOSED_RATE;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        self.fluid.shear_stress(T::lit(self.factor) * shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        self.fluid.sigma1(T::lit(self.factor) * shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        self.fluid.sigma2(T::lit(self.factor) * shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        self.fluid.first_normal_stress_difference(T::lit(self.factor) * shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn yield_stress(&self) -> f64 {
        self.fluid.yield_stress()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        T::lit(self.factor) * self.fluid.viscosity(T::lit(self.factor) * shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        Ok(self.fluid.shear_rate(shear_stress)? / T::lit(self.factor))
    }

    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        Some(self.fluid.flow_moment(moment, from, to)? / self.factor)
    }
}
