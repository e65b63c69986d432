//! The sum of two laws.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};

use crate::methods::answers;

/// Two laws in parallel: they share the deformation, and their energies and stresses add.
///
/// ```text
/// W = W₁ + W₂        P = P₁ + P₂        ∂P/∂F = ∂P₁/∂F + ∂P₂/∂F
/// ```
/// A sum is a law: three are `Sum(a, Sum(b, c))`. A factor is [`Scaled`](super::Scaled).
///
/// # Accuracy
/// That of the two, of the larger of their stresses.
///
/// # Example
/// Rubber with a bulk stiffness beside its own.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::algebra::{OfVolume, Sum};
/// use piola_solids::volumetric::Quadratic;
/// use piola_solids::{Hyperelastic, MooneyRivlin};
/// let law = Sum(MooneyRivlin::stress_free(0.5, 0.25, 1.0)?, OfVolume(Quadratic::new(10.0)?));
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// assert_eq!(law.cauchy(&shear).0.components[3], 0.75); // μ k: the volume is kept
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("parallel", "network", "composite"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sum<A, B>(
    /// The first law.
    pub A,
    /// The second law.
    pub B,
);

#[cfg_attr(not(debug_assertions), inline(always))]
fn added<T: Real>(mut a: FirstPiolaTangent<T>, b: &FirstPiolaTangent<T>) -> FirstPiolaTangent<T> {
    let mut row = 0;
    while row < 9 {
        let mut column = 0;
        while column < 9 {
            a.0.components[row][column] += b.0.components[row][column];
            column += 1;
        }
        row += 1;
    }
    a
}

impl<A: Hyperelastic, B: Hyperelastic> Hyperelastic for Sum<A, B> {
    const REFUSED_IS_NOT_FINITE: bool = A::REFUSED_IS_NOT_FINITE && B::REFUSED_IS_NOT_FINITE;
    const KNOWS_DEFORMATIONS: bool = A::KNOWS_DEFORMATIONS || B::KNOWS_DEFORMATIONS;

    fn reference_energy(&self) -> f64 {
        self.0.reference_energy() + self.1.reference_energy()
    }

    fn is_incompressible(&self) -> bool {
        self.0.is_incompressible() || self.1.is_incompressible()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_derivative<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
        direction: &Matrix3<T>,
    ) -> FirstPiola<T> {
        let first = self.0.first_piola_derivative(deformation, direction).0;
        FirstPiola(first + self.1.first_piola_derivative(deformation, direction).0)
    }

    answers! { |self, deformation|
        energy -> T { self.0.energy(deformation) + self.1.energy(deformation) }
        check -> Result<(), SolidsError> {
            self.0.check(deformation)?;
            self.1.check(deformation)
        }
        first_piola -> FirstPiola<T> {
            FirstPiola(self.0.first_piola(deformation).0 + self.1.first_piola(deformation).0)
        }
        energy_and_first_piola -> (T, FirstPiola<T>) {
            let (first, second) = (self.0.energy_and_first_piola(deformation), self.1.energy_and_first_piola(deformation));
            (first.0 + second.0, FirstPiola(first.1.0 + second.1.0))
        }
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
            let (w, p, a) = self.0.energy_first_piola_and_tangent(deformation);
            let (v, q, b) = self.1.energy_first_piola_and_tangent(deformation);
            (w + v, FirstPiola(p.0 + q.0), added(a, &b))
        }
        second_piola -> SecondPiola<T> {
            SecondPiola(self.0.second_piola(deformation).0 + self.1.second_piola(deformation).0)
        }
        kirchhoff -> KirchhoffStress<T> {
            KirchhoffStress(self.0.kirchhoff(deformation).0 + self.1.kirchhoff(deformation).0)
        }
        first_piola_tangent -> FirstPiolaTangent<T> {
            added(self.0.first_piola_tangent(deformation), &self.1.first_piola_tangent(deformation))
        }
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>) {
            let ((p, a), (q, b)) =
                (self.0.first_piola_and_tangent(deformation), self.1.first_piola_and_tangent(deformation));
            (FirstPiola(p.0 + q.0), added(a, &b))
        }
        first_piola_and_upper_triangle -> [T; 54] {
            let mut numbers = self.0.first_piola_and_upper_triangle(deformation);
            let others = self.1.first_piola_and_upper_triangle(deformation);
            let mut k = 0;
            while k < 54 {
                numbers[k] += others[k];
                k += 1;
            }
            numbers
        }
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>) {
            let ((s, c), (t, d)) =
                (self.0.second_piola_and_tangent(deformation), self.1.second_piola_and_tangent(deformation));
            (SecondPiola(s.0 + t.0), MaterialTangent(c.0 + d.0))
        }
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>) {
            let ((s, c), (t, d)) = (self.0.cauchy_and_tangent(deformation), self.1.cauchy_and_tangent(deformation));
            (CauchyStress(s.0 + t.0), TruesdellTangent(c.0 + d.0))
        }
    }
}
