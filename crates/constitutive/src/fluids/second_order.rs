//! The second-order fluid.

use piola_continuum::Symmetric;
use piola_continuum::rates::{RivlinEricksen, VelocityGradient};
use piola_numerics::Real;

use super::viscometric::ViscometricFluid;
use super::viscous::ViscousFluid;
use piola_numerics::parameters;

parameters! {
    ConstitutiveError;
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
    /// As a [`ViscousFluid`] it is in a steady homogeneous flow, where Ȧ₁ = 0; elsewhere
    /// [`extra_stress_of`](Self::extra_stress_of) takes A₁ and A₂.
    ///
    /// # Accuracy
    /// 4 ulp of each term.
    ///
    /// # Example
    /// ```
    /// use piola_constitutive::fluids::{SecondOrder, ViscometricFluid, ViscousFluid};
    /// use piola_continuum::rates::VelocityGradient;
    /// let fluid = SecondOrder::new(2.0, -0.5, 0.75)?;
    /// let shear = VelocityGradient::from_rows([[0.0; 3], [2.0, 0.0, 0.0], [0.0; 3]])?;
    /// assert_eq!(fluid.extra_stress(&shear).components, [-1.0, 3.0, 0.0, 4.0, 0.0, 0.0]);
    /// assert_eq!(fluid.first_normal_stress_difference(2.0), 4.0);
    /// # Ok::<(), piola_constitutive::ConstitutiveError>(())
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

impl SecondOrder {
    /// T + p 1, Pa, from the Rivlin–Ericksen tensors A₁ and A₂ of any flow.
    #[inline(always)]
    #[must_use]
    pub fn extra_stress_of<T: Real>(&self, first: &RivlinEricksen<T>, second: &RivlinEricksen<T>) -> Symmetric<T> {
        first.0 * T::lit(self.viscosity_coefficient)
            + second.0 * T::lit(self.alpha1)
            + first.0.square() * T::lit(self.alpha2)
    }
}

impl ViscousFluid for SecondOrder {
    #[inline(always)]
    fn extra_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let first = RivlinEricksen::first(velocity_gradient);
        let second = first.next(&Symmetric::zero(), velocity_gradient);
        self.extra_stress_of(&first, &second)
    }
}

impl ViscometricFluid for SecondOrder {
    const NAME: &'static str = Self::NAME;
    const NORMAL_STRESSES: bool = true;

    #[inline(always)]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        T::lit(self.viscosity_coefficient) * shear_rate
    }

    #[inline(always)]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        T::lit(2.0 * self.alpha1 + self.alpha2) * shear_rate * shear_rate
    }

    #[inline(always)]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        T::lit(self.alpha2) * shear_rate * shear_rate
    }

    #[inline(always)]
    fn first_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        T::lit(-2.0 * self.alpha1) * shear_rate * shear_rate
    }
}
