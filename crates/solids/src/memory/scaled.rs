//! A share of a law.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::Real;

use crate::Hyperelastic;
use crate::SolidsError;
use crate::error::check_bound;

/// A law with its energy, stresses and tangents multiplied by a factor.
///
/// # Example
/// ```
/// use piola_solids::memory::Scaled;
/// use piola_solids::{Hyperelastic, MooneyRivlin};
/// use piola_continuum::DeformationGradient;
/// let half = Scaled::new(MooneyRivlin::stress_free(0.5, 0.25, 1.0)?, 0.5)?;
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// assert_eq!(half.cauchy(&shear).0.components[3], 0.375); // half of μ k
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<L>"))]
pub struct Scaled<L> {
    law: L,
    factor: f64,
}

impl<L> Scaled<L> {
    /// Of a law and a factor.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`]; [`SolidsError::OutOfBounds`] unless 0 ≤ factor.
    pub fn new(law: L, factor: f64) -> Result<Self, SolidsError> {
        check_bound("a share of a law", "factor", factor, "0 ≤ factor", 0.0 <= factor)?;
        Ok(Self { law, factor })
    }

    /// Of a law and any factor: also a negative one, which takes a part away from a sum.
    #[must_use]
    pub const fn unchecked(law: L, factor: f64) -> Self {
        Self { law, factor }
    }

    /// The law.
    #[must_use]
    pub const fn law(&self) -> &L {
        &self.law
    }

    /// The factor.
    #[must_use]
    pub const fn factor(&self) -> f64 {
        self.factor
    }
}

impl<L: Hyperelastic> Hyperelastic for Scaled<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.law.energy(deformation) * T::lit(self.factor)
    }

    fn reference_energy(&self) -> f64 {
        self.law.reference_energy() * self.factor
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        self.law.check(deformation)
    }

    fn is_incompressible(&self) -> bool {
        self.law.is_incompressible()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        let factor = T::lit(self.factor);
        FirstPiola(self.law.first_piola(deformation).0.map(|x| x * factor))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_and_first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> (T, FirstPiola<T>) {
        let factor = T::lit(self.factor);
        let (energy, stress) = self.law.energy_and_first_piola(deformation);
        (energy * factor, FirstPiola(stress.0.map(|x| x * factor)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
        let factor = T::lit(self.factor);
        let (energy, stress, tangent) = self.law.energy_first_piola_and_tangent(deformation);
        (energy * factor, FirstPiola(stress.0.map(|x| x * factor)), scaled(tangent, self.factor))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        scaled(self.law.first_piola_tangent(deformation), self.factor)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        let factor = T::lit(self.factor);
        let (stress, tangent) = self.law.first_piola_and_tangent(deformation);
        (FirstPiola(stress.0.map(|x| x * factor)), scaled(tangent, self.factor))
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn scaled<T: Real>(mut tangent: FirstPiolaTangent<T>, factor: f64) -> FirstPiolaTangent<T> {
    for entry in tangent.0.components.as_flattened_mut() {
        *entry *= T::lit(factor);
    }
    tangent
}

read_with!(new of Scaled<L: Sized> { law: L, factor: f64 });
