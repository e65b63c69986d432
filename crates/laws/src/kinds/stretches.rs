//! Laws of the principal stretches as one type.

use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::stretch::{self, StretchEnergy, Volume};
use piola_solids::{AnyVolumetric, Hencky, Hyperelastic, IncompressibleOgden, Ogden, SolidsError};

use super::kind;
use crate::methods::answers;

kind! {
    /// Any built-in law Σ w(ln λₐ) + U(J) of the stretches themselves: one kernel for the stress and tangent of all.
    ///
    /// # Accuracy
    /// That of the law.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::kinds::LawOfStretches;
    /// use piola_solids::{AnySolid, Hencky, Hyperelastic};
    /// let solid = AnySolid::from(Hencky::new(1.0, 2.0)?);
    /// let law = LawOfStretches::of(&solid).ok_or("a law of stretches")?;
    /// let sheared = DeformationGradient::diagonal([2.0, 0.5, 1.0])?;
    /// let stress: f64 = law.kirchhoff(&sheared).0.components[0];
    /// assert!((stress - 4.0 * 2.0_f64.ln()).abs() < 1e-14); // 2 μ ln λ₁
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    LawOfStretches {
        Ogden(Ogden<AnyVolumetric>),
        IncompressibleOgden(IncompressibleOgden),
        Hencky(Hencky<AnyVolumetric>),
    }
}

impl StretchEnergy for LawOfStretches<'_> {
    const ISOCHORIC: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        chosen!(self, law => Hyperelastic::check(*law, deformation))
    }
    fn is_incompressible(&self) -> bool {
        chosen!(self, law => Hyperelastic::is_incompressible(*law))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Real>(&self, x: T) -> T {
        chosen!(self, law => law.part(x))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope<T: Real>(&self, x: T) -> T {
        chosen!(self, law => law.slope(x))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, x: T) -> T {
        chosen!(self, law => law.curvature(x))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature_at_rest<T: Real>(&self) -> T {
        chosen!(self, law => law.curvature_at_rest())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn secant<T: Real>(&self, x: T, y: T) -> T {
        chosen!(self, law => law.secant(x, y))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        chosen!(self, law => law.volume_energy(volume))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        chosen!(self, law => law.volume_slope(volume))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T {
        chosen!(self, law => law.volume_curvature(volume))
    }
}

impl Hyperelastic for LawOfStretches<'_> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        StretchEnergy::check(self, deformation)
    }
    fn is_incompressible(&self) -> bool {
        StretchEnergy::is_incompressible(self)
    }

    crate::stretches::by_functions! {
        energy -> T,
        first_piola -> FirstPiola<T>,
        energy_and_first_piola -> (T, FirstPiola<T>),
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>),
        second_piola -> SecondPiola<T>,
        kirchhoff -> KirchhoffStress<T>,
        first_piola_tangent -> FirstPiolaTangent<T>,
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>),
        material_tangent -> MaterialTangent<T>,
        truesdell_tangent -> TruesdellTangent<T>,
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>),
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>),
    }
}
