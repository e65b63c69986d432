//! The law of an energy of invariants.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::{Dual, Hessian, Real};
use piola_solids::internal::packed;
use piola_solids::invariant::{self, Curvatures, InvariantEnergy, Invariants, Slopes};
use piola_solids::{Hyperelastic, SolidsError};

use super::at_deformation::AtDeformation;
use super::energy::EnergyOfInvariants;
use super::excesses::MOST_FAMILIES;
use super::fibres;
use super::variables::{FIRST, LOGARITHM, SECOND, Variables};
use crate::methods::answers;

/// The law of an [`EnergyOfInvariants`]: every stress and tangent by exact derivatives of the energy in its arguments.
///
/// ```text
/// P = s F⁻ᵀ + (2 w₁ + 4 w₂)(F − F⁻ᵀ) + 2 w₂ F ((I₁ − 3) 1 − (C − 1)) + Σ 2 w₄ F a ⊗ a + Σ 2 w₅ F (a ⊗ C a + C a ⊗ a)
/// s = ∂W/∂ ln J at fixed I₁ − 3 − 2 ln J and I₂ − 3 − 4 ln J
/// ```
///
/// # Accuracy
/// P, S, τ relative 1e-13 down to ∇u = 1e-16 for an energy whose terms keep their digits, see [`Excesses`](super::Excesses); tangents a few ulp of
/// their norm. For J far below 1 the stress loses the digits that J^(−2/3) has before the point.
///
/// # Example
/// A neo-Hookean matrix with fibres along 1, W = ½ μ (I₁ − 3 − 2 ln J) + ½ k (I₄ − 1)², in uniaxial strain.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::{EnergyOfInvariants, Excesses, OfInvariants};
/// use piola_numerics::Real;
/// use piola_solids::Hyperelastic;
///
/// #[derive(Clone, Copy)]
/// struct Reinforced;
///
/// impl EnergyOfInvariants for Reinforced {
///     const FIBRES: usize = 1;
///     #[inline(always)]
///     fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
///         at.first_excess() + T::lit(0.5) * at.fourth(0) * at.fourth(0) // μ = 2, k = 1
///     }
/// }
///
/// let stretched = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// let stress = OfInvariants(Reinforced).first_piola(&stretched).0;
/// assert_eq!(stress[(0, 0)], 15.0); // μ (λ − 1/λ) + 2 k λ (λ² − 1)
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfInvariants<L>(
    /// The energy.
    pub L,
);

impl<L: EnergyOfInvariants> OfInvariants<L> {
    /// The energy in the variables of the [module](super).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn varied<T: Real>(&self, isotropic: &Invariants<T>) -> Hessian<T, 3, 6> {
        self.0.energy(&Variables { isotropic, fibres: [[T::zero(); 2]; MOST_FAMILIES], families: 0, second: L::SECOND })
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn slopes<T: Real>(energy: &Hessian<T, 3, 6>) -> Slopes<T> {
    let [first, second, residual] = energy.partials();
    Slopes { first, second, residual, volume: residual - T::lit(2.0) * first - T::lit(4.0) * second }
}

/// By I₁, I₂ and J from those by a, b and θ: ∂/∂J = J⁻¹ D, D = ∂/∂θ − 2 ∂/∂a − 4 ∂/∂b.
#[cfg_attr(not(debug_assertions), inline(always))]
fn curvatures<T: Real>(energy: &Hessian<T, 3, 6>, slopes: &Slopes<T>, jacobian: T) -> Curvatures<T> {
    let (two, four, reciprocal) = (T::lit(2.0), T::lit(4.0), jacobian.recip());
    let second = |i: usize, j: usize| energy.second_partial(i, j);
    let (aa, ab, bb) = (second(FIRST, FIRST), second(FIRST, SECOND), second(SECOND, SECOND));
    let first_turn = second(FIRST, LOGARITHM) - two * aa - four * ab;
    let second_turn = second(SECOND, LOGARITHM) - two * ab - four * bb;
    let straight = second(LOGARITHM, LOGARITHM) - two * second(FIRST, LOGARITHM) - four * second(SECOND, LOGARITHM);
    let bending = straight - two * first_turn - four * second_turn;
    Curvatures {
        first_first: aa,
        first_second: ab,
        second_second: bb,
        first_volume: first_turn * reciprocal,
        second_volume: second_turn * reciprocal,
        volume_volume: (bending - slopes.volume) * (reciprocal * reciprocal),
    }
}

impl<L: EnergyOfInvariants> InvariantEnergy for OfInvariants<L> {
    const SECOND: bool = L::SECOND;
    const CURVED: bool = L::CURVED;
    const STRAIGHT: bool = L::STRAIGHT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.0.energy(&AtDeformation { deformation, law: &self.0 })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        self.0.check(&AtDeformation { deformation, law: &self.0 })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        slopes(&self.varied(invariants))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        self.slopes_and_curvatures(invariants).1
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_and_curvatures<T: Real>(&self, invariants: &Invariants<T>) -> (Slopes<T>, Curvatures<T>) {
        let energy = self.varied(invariants);
        let slopes = slopes(&energy);
        (slopes, curvatures(&energy, &slopes, invariants.jacobian))
    }
}

impl<L: EnergyOfInvariants> Hyperelastic for OfInvariants<L> {
    const KNOWS_DEFORMATIONS: bool = L::STRAIGHT && L::FIBRES == 0;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_derivative<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
        direction: &Matrix3<T>,
    ) -> FirstPiola<T> {
        if L::FIBRES == 0 {
            return invariant::first_piola_derivative(self, deformation, direction);
        }
        let varied = deformation.lifted(|i, j, x| Dual::new(x, direction[(i, j)]));
        FirstPiola(self.first_piola(&varied).0.map(|x| x.tangent))
    }

    answers! { |self, deformation|
        energy -> T { InvariantEnergy::energy(self, deformation) }
        check -> Result<(), SolidsError> { InvariantEnergy::check(self, deformation) }
        first_piola -> FirstPiola<T> {
            if L::FIBRES == 0 {
                invariant::first_piola(self, deformation)
            } else {
                packed::stress(fibres::first_piola(&self.0, deformation))
            }
        }
        energy_and_first_piola -> (T, FirstPiola<T>) {
            (InvariantEnergy::energy(self, deformation), self.first_piola(deformation))
        }
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
            let (stress, tangent) = self.first_piola_and_tangent(deformation);
            (InvariantEnergy::energy(self, deformation), stress, tangent)
        }
        second_piola -> SecondPiola<T> {
            if L::FIBRES == 0 {
                invariant::second_piola(self, deformation)
            } else {
                SecondPiola(fibres::stress_and_tangent(&self.0, deformation).0)
            }
        }
        kirchhoff -> KirchhoffStress<T> {
            if L::FIBRES == 0 {
                invariant::kirchhoff(self, deformation)
            } else {
                self.second_piola(deformation).kirchhoff(deformation)
            }
        }
        first_piola_tangent -> FirstPiolaTangent<T> { self.first_piola_and_tangent(deformation).1 }
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>) {
            if L::FIBRES == 0 {
                invariant::first_piola_and_tangent(self, deformation)
            } else {
                packed::both(fibres::first_piola_and_upper_triangle(&self.0, deformation))
            }
        }
        first_piola_and_upper_triangle -> [T; 54] {
            if L::FIBRES == 0 {
                invariant::first_piola_and_upper_triangle(self, deformation)
            } else {
                fibres::first_piola_and_upper_triangle(&self.0, deformation)
            }
        }
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>) {
            if L::FIBRES == 0 {
                invariant::second_piola_and_tangent(self, deformation)
            } else {
                let (stress, tangent) = fibres::stress_and_tangent(&self.0, deformation);
                (SecondPiola(stress), MaterialTangent(tangent))
            }
        }
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>) {
            let (stress, tangent) = self.second_piola_and_tangent(deformation);
            (stress.kirchhoff(deformation).cauchy(deformation), tangent.truesdell(deformation))
        }
    }
}
