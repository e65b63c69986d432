//! The compressible Newtonian fluid.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_numerics::{Real, parameters};

use super::viscous::ViscousFluid;
use crate::FluidsError;

parameters! {
    FluidsError;
    /// The compressible Newtonian fluid of Navier and Stokes.
    ///
    /// ```text
    /// T = −p 1 + λ tr D 1 + 2 μ D
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | λ | `second_viscosity` | Pa s | 0 ≤ 3 λ + 2 μ, to rounding |
    /// | μ | `shear_viscosity` | Pa s | 0 ≤ μ |
    ///
    /// Within the bounds no flow has a negative dissipation.
    ///
    /// # Accuracy
    /// 2 ulp of each term.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{LinearViscous, ViscousFluid};
    /// use piola_continuum::rates::VelocityGradient;
    /// let gas = LinearViscous::new(0.5, 0.75)?;
    /// let expansion = VelocityGradient::from_rows([[2.0, 0.0, 0.0], [0.0; 3], [0.0; 3]])?;
    /// assert_eq!(gas.extra_stress(&expansion).components[0], 4.0); // (λ + 2 μ) 2
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// W(19.33), written there with μ for the field's 2 μ; B(4.83).
    pub struct LinearViscous("linear viscous fluid") {
        /// λ, Pa s.
        second_viscosity: "0 ≤ 3 λ + 2 μ" =>
            -4.0 * f64::EPSILON * shear_viscosity.abs() <= 3.0 * second_viscosity + 2.0 * shear_viscosity,
        /// μ, Pa s.
        shear_viscosity: "0 ≤ μ" => 0.0 <= shear_viscosity,
    }
}

impl LinearViscous {
    /// Stokes' fluid, λ = −⅔ μ: volume changes without viscosity.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn stokes(shear_viscosity: f64) -> Result<Self, FluidsError> {
        Self::new(-2.0 / 3.0 * shear_viscosity, shear_viscosity)
    }

    /// κ = λ + ⅔ μ, Pa s: the viscosity of volume changes.
    #[must_use]
    pub fn bulk_viscosity(&self) -> f64 {
        self.second_viscosity + 2.0 / 3.0 * self.shear_viscosity
    }
}

impl ViscousFluid for LinearViscous {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extra_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let rate = velocity_gradient.rate_of_deformation().0;
        let volume = T::lit(self.second_viscosity) * velocity_gradient.divergence();
        rate * T::lit(2.0 * self.shear_viscosity) + Symmetric::identity() * volume
    }
}
