//! An energy of the change of volume as a law.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::invariant::{self, Curvatures, InvariantEnergy, Invariants, Slopes};
use piola_solids::volumetric::Volumetric;
use piola_solids::{Hyperelastic, SolidsError};

use crate::methods::answers;

/// The law W = U(J) of an energy of the change of volume: a fluid's, to be added to a solid's.
///
/// ```text
/// τ = J U′ 1        P = J U′ F⁻ᵀ
/// ```
///
/// # Accuracy
/// That of U.
///
/// # Example
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::algebra::OfVolume;
/// use piola_solids::Hyperelastic;
/// use piola_solids::volumetric::Quadratic;
/// let law = OfVolume(Quadratic::new(10.0)?);
/// let grown: f64 = law.cauchy(&DeformationGradient::dilatation(2.0)?).0.components[0];
/// assert!((grown - 70.0).abs() < 1e-13); // κ (J − 1), J = 8
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OfVolume<U>(
    /// U.
    pub U,
);

impl<U: Volumetric> InvariantEnergy for OfVolume<U> {
    const SECOND: bool = false;
    const CURVED: bool = false;
    const STRAIGHT: bool = U::STRAIGHT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.0.energy(deformation.volume_change(), deformation.jacobian())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        let volume = self.0.mean_kirchhoff(invariants.change, invariants.jacobian);
        Slopes { first: T::zero(), second: T::zero(), residual: volume, volume }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        Curvatures::of_volume(self.0.curvature(invariants.change, invariants.jacobian))
    }
}

impl<U: Volumetric> Hyperelastic for OfVolume<U> {
    const KNOWS_DEFORMATIONS: bool = U::STRAIGHT;

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
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>) {
            let (stress, tangent) = invariant::second_piola_and_tangent(self, deformation);
            (stress.cauchy(deformation), tangent.truesdell(deformation))
        }
    }
}
