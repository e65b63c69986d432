//! The isochoric part of one law and the volumetric part of another.

use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_solids::internal::{Unimodular, UnimodularDeformation, first_piola_numbers, inverse_metric, packed};
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::Rows;
use piola_tensor::{MajorSymmetric, PairSymmetric};

use crate::methods::answers;
use crate::varied::lifted;

/// A solid that changes its shape as one law says and its volume as another (Flory's decomposition).
///
/// ```text
/// W = W₁(J^(−1/3) F) + W₂(J^(1/3) 1)
/// S = J^(−2/3) (S̄ − ⅓ (S̄ : C) C⁻¹) + J U′ C⁻¹        S̄ = S₁(J^(−1/3) F),   U(J) = W₂(J^(1/3) 1)
/// ```
/// Any two laws will do, anisotropic ones too.
///
/// # Accuracy
/// That of S₁ and S₂; a few ulp of S₁ × the condition number of F beside it.
///
/// # Example
/// Mooney and Rivlin's solid with the volume of St. Venant and Kirchhoff's.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::algebra::Decoupled;
/// use piola_solids::{Hyperelastic, MooneyRivlin, SaintVenantKirchhoff};
/// let law = Decoupled { shape: MooneyRivlin::stress_free(0.5, 0.25, 1.0)?, volume: SaintVenantKirchhoff::new(1.0, 3.0)? };
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// assert!((law.cauchy(&shear).0.components[3] - 0.75_f64).abs() < 1e-15); // μ k
/// let grown: f64 = law.cauchy(&DeformationGradient::dilatation(2.0)?).0.components[0];
/// assert!((grown - 6.75).abs() < 1e-14); // (3 λ + 2 μ) E F²/J with E = 3/2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// P. J. Flory, Trans. Faraday Soc. 57 (1961) 829–838.
#[doc(alias("isochoric", "volumetric", "Flory"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Decoupled<A, B> {
    /// The law of the change of shape.
    pub shape: A,
    /// The law of the change of volume.
    pub volume: B,
}

/// A dilatation λ 1, kept as λ and λ − 1.
#[derive(Clone, Copy)]
struct Dilatation<T> {
    stretch: T,
    elongation: T,
}

impl<T: Real> Dilatation<T> {
    /// J^(1/3) 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(deformation: &impl Deformation<T>) -> Self {
        let Unimodular { third, third_change, .. } =
            Unimodular::of(deformation.volume_change(), deformation.jacobian());
        let stretch = third.recip();
        Self { stretch, elongation: -(third_change * stretch) }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn spherical<T: Real>(x: T) -> Rows<T> {
    let o = T::zero();
    [[x, o, o], [o, x, o], [o, o, x]]
}

impl<T: Real> Deformation<T> for Dilatation<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        spherical(self.stretch)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        spherical(self.elongation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        lifted(self.displacement_rows(), lift)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        self.stretch * self.stretch * self.stretch
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        let x = self.elongation;
        x * (T::lit(3.0) + x * (T::lit(3.0) + x))
    }
}

impl<A: Hyperelastic, B: Hyperelastic> Decoupled<A, B> {
    /// J U′ = ⅓ λ² tr S₂ at λ 1, λ = J^(1/3).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean<T: Real>(&self, dilatation: &Dilatation<T>) -> T {
        let trace = self.volume.second_piola(dilatation).0.trace();
        T::lit(1.0 / 3.0) * (dilatation.stretch * dilatation.stretch) * trace
    }

    /// S, of S̄, C⁻¹ and J U′; and ⅓ S̄ : C.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress_of<T: Real>(
        shape: &Symmetric<T>,
        deformation: &impl Deformation<T>,
        inverse: &Symmetric<T>,
        scale: T,
    ) -> (Symmetric<T>, T) {
        let right = piola_continuum::internal::strain::right_cauchy_green(deformation.gradient_rows());
        let pressure = T::lit(1.0 / 3.0) * shape.double_contraction(&right);
        ((*shape - *inverse * pressure) * scale, pressure)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        let (inverse, _) = inverse_metric(deformation);
        let Unimodular { two_thirds, .. } = Unimodular::of(deformation.volume_change(), deformation.jacobian());
        let shape = self.shape.second_piola(&UnimodularDeformation::of(deformation)).0;
        let (stress, _) = Self::stress_of(&shape, deformation, &inverse, two_thirds);
        stress + inverse * self.mean(&Dilatation::of(deformation))
    }

    /// S, and ∂S/∂E = J^(−4/3) ℙ : ℂ̄ : ℙᵀ + ⅔ J^(−2/3) (S̄ : C) (C⁻¹ ⊙ C⁻¹ − ⅓ C⁻¹ ⊗ C⁻¹) − ⅔ (S̃ ⊗ C⁻¹ + C⁻¹ ⊗ S̃), S̃ the part
    /// of the shape, with that of the volume.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress_and_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        let (two, third, ninth) = (T::lit(2.0), T::lit(1.0 / 3.0), T::lit(1.0 / 9.0));
        let (inverse, _) = inverse_metric(deformation);
        let Unimodular { two_thirds, .. } = Unimodular::of(deformation.volume_change(), deformation.jacobian());
        let (shape, tangent) = self.shape.second_piola_and_tangent(&UnimodularDeformation::of(deformation));
        let (stress, pressure) = Self::stress_of(&shape.0, deformation, &inverse, two_thirds);

        // ℙ : ℂ̄ : ℙᵀ = ℂ̄ − ⅓ (C⁻¹ ⊗ Z + Z ⊗ C⁻¹) + ⅑ (C : Z) C⁻¹ ⊗ C⁻¹ with Z = ℂ̄ : C.
        let right = piola_continuum::internal::strain::right_cauchy_green(deformation.gradient_rows());
        let image = tangent.0.contract(&right);
        let square = two_thirds * two_thirds;
        let dyad = MajorSymmetric::dyad(&inverse);
        let square_dyad = MajorSymmetric::square_dyad(&inverse);
        let projected = tangent.0 - MajorSymmetric::symmetric_dyad(&inverse, &image) * (two * third)
            + dyad * (ninth * image.double_contraction(&right));
        let bending = (square_dyad - dyad * third) * (two * pressure * two_thirds);
        let mixed = MajorSymmetric::symmetric_dyad(&stress, &inverse) * (two * two * third);

        // J (J U′)′ = ⅓ (⅔ λ² tr S₂ + ⅓ λ⁴ 1 : ℂ₂ : 1).
        let dilatation = Dilatation::of(deformation);
        let (volume, stiffness) = self.volume.second_piola_and_tangent(&dilatation);
        let one = Symmetric::identity();
        let lambda = dilatation.stretch * dilatation.stretch;
        let mean = third * lambda * volume.0.trace();
        let along = stiffness.0.contract(&one).trace();
        let growth = two * third * mean + ninth * (lambda * lambda * along);
        let spherical = dyad * growth - square_dyad * (two * mean);
        (stress + inverse * mean, projected * square + bending - mixed + spherical)
    }
}

impl<A: Hyperelastic, B: Hyperelastic> Hyperelastic for Decoupled<A, B> {
    fn reference_energy(&self) -> f64 {
        self.shape.reference_energy() + self.volume.reference_energy()
    }

    answers! { |self, deformation|
        energy -> T {
            self.shape.energy(&UnimodularDeformation::of(deformation)) + self.volume.energy(&Dilatation::of(deformation))
        }
        check -> Result<(), SolidsError> {
            self.shape.check(&UnimodularDeformation::of(deformation))?;
            self.volume.check(&Dilatation::of(deformation))
        }
        first_piola -> FirstPiola<T> { self.second_piola(deformation).first_piola(deformation) }
        energy_and_first_piola -> (T, FirstPiola<T>) { (self.energy(deformation), self.first_piola(deformation)) }
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
            let (stress, tangent) = self.first_piola_and_tangent(deformation);
            (self.energy(deformation), stress, tangent)
        }
        second_piola -> SecondPiola<T> { SecondPiola(self.stress(deformation)) }
        kirchhoff -> KirchhoffStress<T> {
            KirchhoffStress(self.stress(deformation).congruence(deformation.gradient_rows()))
        }
        first_piola_tangent -> FirstPiolaTangent<T> { self.first_piola_and_tangent(deformation).1 }
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>) {
            packed::both(self.first_piola_and_upper_triangle(deformation))
        }
        first_piola_and_upper_triangle -> [T; 54] {
            let (stress, tangent) = self.stress_and_tangent(deformation);
            first_piola_numbers(deformation.gradient_rows(), &stress, &tangent)
        }
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>) {
            let (stress, tangent) = self.stress_and_tangent(deformation);
            (SecondPiola(stress), MaterialTangent(tangent))
        }
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>) {
            let (stress, tangent) = self.second_piola_and_tangent(deformation);
            (stress.kirchhoff(deformation).cauchy(deformation), tangent.truesdell(deformation))
        }
    }
}
