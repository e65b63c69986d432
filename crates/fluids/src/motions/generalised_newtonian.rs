//! Generalised Newtonian fluids in three dimensions.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_numerics::{Mask, Real};

use super::viscous::ViscousFluid;
use crate::ViscometricFluid;

/// A generalised Newtonian fluid in any isochoric flow: a viscosity that depends on the rate of deformation.
///
/// ```text
/// T = −p 1 + 2 η(k) D      k = √(2 D : D)      η = τ(k)/k
/// ```
/// The fluid inside gives τ; it must have no normal stress differences, which is checked when the program is compiled.
///
/// Where D = 0 a fluid with a yield stress is solid: its extra stress is not determined, and zero is returned.
///
/// # Accuracy
/// That of τ; neither small nor large D overflow.
///
/// # Example
/// ```
/// use piola_fluids::{GeneralisedNewtonian, PowerLaw, ViscousFluid};
/// use piola_continuum::rates::VelocityGradient;
/// let fluid = GeneralisedNewtonian::new(PowerLaw::new(3.0, 0.5)?);
/// let shear = VelocityGradient::from_rows([[0.0; 3], [4.0, 0.0, 0.0], [0.0; 3]])?;
/// assert_eq!(fluid.extra_stress(&shear).components, [0.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// A case of W(19.21).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
pub struct GeneralisedNewtonian<F> {
    fluid: F,
}

impl<F: ViscometricFluid> GeneralisedNewtonian<F> {
    /// Of the fluid that gives τ.
    #[must_use]
    pub const fn new(fluid: F) -> Self {
        const { assert!(!F::NORMAL_STRESSES, "the fluid has normal stress differences, that 2 η D lacks") };
        Self { fluid }
    }

    /// The fluid that gives τ.
    #[must_use]
    pub const fn fluid(&self) -> &F {
        &self.fluid
    }
}

impl<F: ViscometricFluid> ViscousFluid for GeneralisedNewtonian<F> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extra_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let rate = velocity_gradient.rate_of_deformation().0;
        let largest = rate.components.iter().fold(T::zero(), |largest, x| largest.max(x.abs())).frozen();
        let rest = largest.at_most(T::zero());
        let scale = T::select(rest, T::one(), largest);
        // D in units of its largest component; 2 η D = 2 D τ/k. At rest any direction serves.
        let mut direction = rate * scale.recip();
        direction.components[3] = T::select(rest, T::one(), direction.components[3]);
        let size = (T::lit(2.0) * direction.double_contraction(&direction)).sqrt();
        let flowing = direction * (T::lit(2.0) * self.fluid.shear_stress(scale * size) / size);
        if !rest.any() {
            return flowing;
        }
        let viscosity = self.fluid.viscosity(T::zero()).frozen();
        let solid = !viscosity.is_finite();
        let slow = rate * (T::lit(2.0) * T::select(solid, T::zero(), viscosity));
        Symmetric { components: core::array::from_fn(|i| T::select(rest, slow.components[i], flowing.components[i])) }
    }
}
