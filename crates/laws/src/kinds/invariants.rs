//! Laws of I₁, I₂ and J as one type.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::invariant::{self, Curvatures, InvariantEnergy, Invariants, Slopes};
use piola_solids::{
    AnyIsochoric, AnyVolumetric, BlatzKo, Compressible, Hyperelastic, IncompressibleSolid, MooneyRivlin, NeoHookean,
    Polynomial, SolidsError,
};

use super::kind;
use crate::methods::answers;

kind! {
    /// A built-in law W(I₁, I₂, J) of the table of the [module](super): one kernel for the stress and tangent of all.
    ///
    /// # Accuracy
    /// That of the law.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::kinds::LawOfInvariants;
    /// use piola_solids::{AnySolid, Compressible, Hyperelastic, isochoric, volumetric};
    /// let (shape, volume) = (isochoric::MooneyRivlin::new(0.5, 0.25)?, volumetric::Quadratic::new(10.0)?);
    /// let solid = AnySolid::from(Compressible::new(shape, volume));
    /// let law = LawOfInvariants::of(&solid).ok_or("a law of invariants")?;
    /// let shear = DeformationGradient::simple_shear(0.5)?;
    /// let stress: f64 = law.cauchy(&shear).0.components[3];
    /// assert!((stress - 0.75).abs() < 1e-15); // 2 (C₁₀ + C₀₁) k
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    LawOfInvariants {
        Compressible(Compressible<AnyIsochoric, AnyVolumetric>),
        Incompressible(IncompressibleSolid<AnyIsochoric>),
        Polynomial(Polynomial),
        MooneyRivlin(MooneyRivlin),
        NeoHookean(NeoHookean<AnyVolumetric>),
        BlatzKo(BlatzKo),
    }
}

impl InvariantEnergy for LawOfInvariants<'_> {
    const SECOND: bool = true;
    const CURVED: bool = true;

    answers! { |self, deformation|
        energy -> T { chosen!(self, law => Hyperelastic::energy(*law, deformation)) }
        check -> Result<(), SolidsError> {
            match self {
                // In lanes its answers tell: they are not finite where the law refuses.
                Self::Compressible(_) if 1 < T::LANES => Ok(()),
                law => chosen!(law, law => Hyperelastic::check(*law, deformation)),
            }
        }
    }

    fn reference_energy(&self) -> f64 {
        chosen!(self, law => Hyperelastic::reference_energy(*law))
    }
    fn is_incompressible(&self) -> bool {
        chosen!(self, law => Hyperelastic::is_incompressible(*law))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        chosen!(self, law => law.slopes(invariants))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        chosen!(self, law => law.curvatures(invariants))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_and_curvatures<T: Real>(&self, invariants: &Invariants<T>) -> (Slopes<T>, Curvatures<T>) {
        chosen!(self, law => law.slopes_and_curvatures(invariants))
    }
}

impl Hyperelastic for LawOfInvariants<'_> {
    fn reference_energy(&self) -> f64 {
        InvariantEnergy::reference_energy(self)
    }
    fn is_incompressible(&self) -> bool {
        InvariantEnergy::is_incompressible(self)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_derivative<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
        direction: &Matrix3<T>,
    ) -> FirstPiola<T> {
        invariant::first_piola_derivative(self, deformation, direction)
    }

    answers! { |self, deformation|
        energy -> T { InvariantEnergy::energy(self, deformation) }
        check -> Result<(), SolidsError> { InvariantEnergy::check(self, deformation) }
        first_piola -> FirstPiola<T> { invariant::first_piola(self, deformation) }
        energy_and_first_piola -> (T, FirstPiola<T>) { invariant::energy_and_first_piola(self, deformation) }
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
            invariant::energy_first_piola_and_tangent(self, deformation)
        }
        second_piola -> SecondPiola<T> { invariant::second_piola(self, deformation) }
        kirchhoff -> KirchhoffStress<T> { invariant::kirchhoff(self, deformation) }
        first_piola_tangent -> FirstPiolaTangent<T> { invariant::first_piola_tangent(self, deformation) }
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>) {
            invariant::first_piola_and_tangent(self, deformation)
        }
        first_piola_and_upper_triangle -> [T; 54] { invariant::first_piola_and_upper_triangle(self, deformation) }
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>) {
            invariant::second_piola_and_tangent(self, deformation)
        }
    }
}
