//! Material derivatives of stresses, and those of one measure from those of another.

use piola_numerics::Real;
use piola_tensor::internal::rows::{product, sum};

use crate::rates::{GradientRate, VelocityGradient};
use crate::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};

/// The material derivative Ṡ of a quantity S: its rate at a body point, Pa/s for a stress.
///
/// Of a spatial tensor it is not objective; the other rates of this module are made from it.
///
/// # Example
/// ```
/// use piola_continuum::{CauchyStress, stress::rates::MaterialRate};
/// let rate = MaterialRate(CauchyStress::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?);
/// assert_eq!(rate.0.0.trace(), 1.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(transparent)]
pub struct MaterialRate<S>(
    /// Ṡ, in the components of S.
    pub S,
);

impl<T: Real> MaterialRate<CauchyStress<T>> {
    /// The material derivative of Kirchhoff's stress: τ̇ = J (Ṫ + T tr L).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn kirchhoff(
        &self,
        stress: &CauchyStress<T>,
        deformation: &impl Deformation<T>,
        velocity_gradient: &VelocityGradient<T>,
    ) -> MaterialRate<KirchhoffStress<T>> {
        let total = self.0.0 + stress.0 * velocity_gradient.divergence();
        MaterialRate(KirchhoffStress(total * deformation.jacobian()))
    }
}

impl<T: Real> MaterialRate<SecondPiola<T>> {
    /// The material derivative of the first Piola–Kirchhoff stress, by rows: Ṗ = Ḟ S + F Ṡ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola(
        &self,
        stress: &SecondPiola<T>,
        deformation: &impl Deformation<T>,
        gradient_rate: &GradientRate<T>,
    ) -> MaterialRate<FirstPiola<T>> {
        let convected = product(gradient_rate.rows(), stress.rows());
        let stressed = product(deformation.gradient_rows(), self.0.rows());
        MaterialRate(FirstPiola::trusted(sum(convected, stressed)))
    }
}
