//! Fluids whose stress is a function of the present velocity gradient, in three dimensions.

use piola_continuum::rates::VelocityGradient;
use piola_continuum::{CauchyStress, Symmetric};
use piola_numerics::Real;

/// A fluid whose stress beyond the pressure is a function of the present velocity gradient.
///
/// ```text
/// T = −p 1 + V(L)
/// ```
/// | symbol | method | unit |
/// |---|---|---|
/// | V = T + p 1 | [`extra_stress`](Self::extra_stress) | Pa |
/// | T | [`cauchy`](Self::cauchy) | Pa |
/// | V : D | [`dissipation`](Self::dissipation) | W/m³ |
///
/// # Example
/// A fluid of one's own:
/// ```
/// use piola_fluids::ViscousFluid;
/// use piola_continuum::Symmetric;
/// use piola_continuum::rates::VelocityGradient;
/// use piola_numerics::Real;
///
/// struct Water;
/// impl ViscousFluid for Water {
///     fn extra_stress<T: Real>(&self, l: &VelocityGradient<T>) -> Symmetric<T> {
///         l.rate_of_deformation().0 * T::lit(0.002)
///     }
/// }
/// let shear = VelocityGradient::from_rows([[0.0; 3], [50.0, 0.0, 0.0], [0.0; 3]])?;
/// assert_eq!(Water.cauchy(8.0, &shear).0.components, [-8.0, -8.0, -8.0, 0.05, 0.0, 0.0]);
/// assert_eq!(Water.dissipation(&shear), 2.5); // μ k²
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(19.21), W(19.33), B(4.82).
pub trait ViscousFluid {
    /// V = T + p 1, Pa, at the velocity gradient L, 1/s.
    #[must_use]
    fn extra_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T>;

    /// T = −p 1 + V, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn cauchy<T: Real>(&self, pressure: T, velocity_gradient: &VelocityGradient<T>) -> CauchyStress<T> {
        CauchyStress(self.extra_stress(velocity_gradient) - Symmetric::identity() * pressure)
    }

    /// V : D, W/m³: the power turned into heat.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn dissipation<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> T {
        self.extra_stress(velocity_gradient).double_contraction(&velocity_gradient.rate_of_deformation().0)
    }
}
