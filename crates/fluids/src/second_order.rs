//! The second-order fluid.

use piola_numerics::{Real, parameters};

use super::viscometric::ViscometricFluid;

parameters! {
    FluidsError;
    /// The second-order fluid: any simple fluid with fading memory in slow flow, one order beyond the Newtonian.
    ///
    /// ```text
    /// T = −p 1 + μ A₁ + α₁ A₂ + α₂ A₁²
    /// in shear: τ = μ k,  σ₁ = N₂ = (2 α₁ + α₂) k²,  σ₂ = α₂ k²,  N₁ = −2 α₁ k²
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `viscosity_coefficient` | Pa s | 0 < μ |
    /// | α₁ | `alpha1`; negative where N₁ is positive, as measured | Pa s² | finite |
    /// | α₂ | `alpha2` | Pa s² | finite |
    ///
    /// As a `ViscousFluid` it is in a steady homogeneous flow, where Ȧ₁ = 0; elsewhere `extra_stress_of` takes A₁ and A₂.
    ///
    /// # Accuracy
    /// 4 ulp of each term.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{SecondOrder, ViscometricFluid};
    /// let fluid = SecondOrder::new(2.0, -0.5, 0.75)?;
    /// assert_eq!((fluid.shear_stress(2.0), fluid.sigma1(2.0), fluid.sigma2(2.0)), (4.0, -1.0, 3.0));
    /// assert_eq!(fluid.first_normal_stress_difference(2.0), 4.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// B. D. Coleman, W. Noll, Arch. Rational Mech. Anal. 6 (1960) 355; an example of the functions of W(23.13–23.24).
    pub struct SecondOrder("second-order fluid") {
        /// μ, Pa s.
        viscosity_coefficient: "0 < μ" => 0.0 < viscosity_coefficient,
        /// α₁, Pa s².
        alpha1: "finite" => true,
        /// α₂, Pa s².
        alpha2: "finite" => true,
    }
}

impl ViscometricFluid for SecondOrder {
    const NAME: &'static str = Self::NAME;
    const NORMAL_STRESSES: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        T::lit(self.viscosity_coefficient) * shear_rate
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        T::lit(2.0 * self.alpha1 + self.alpha2) * shear_rate * shear_rate
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        T::lit(self.alpha2) * shear_rate * shear_rate
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        T::lit(-2.0 * self.alpha1) * shear_rate * shear_rate
    }
}
