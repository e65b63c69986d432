//! Laws W(E) with S and ∂S/∂E in closed form: P = F S and ∂P/∂F follow.

use piola_continuum::internal::strain::green;
use piola_continuum::{Deformation, FirstPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::internal::Lanewise;
use piola_numerics::linear::matrix3::{dot, from_rows};
use piola_tensor::internal::rows::{Rows, product, transpose};
use piola_tensor::{MajorSymmetric, PairSymmetric, SLOT};

use super::packed;
use crate::SolidsError;

/// An energy of Green's strain with its derivatives in closed form.
pub(super) trait StrainEnergy {
    /// See [`Hyperelastic::REFUSED_IS_NOT_FINITE`](super::Hyperelastic::REFUSED_IS_NOT_FINITE).
    const REFUSED_IS_NOT_FINITE: bool = false;

    /// W less W of the reference, J/m³.
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T;
    /// S = ∂W/∂E, Pa, without cancellation.
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T>;
    /// ∂S/∂E, Pa.
    fn tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> MajorSymmetric<T>;
    /// S and ∂S/∂E, with what they share computed once.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress_and_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        (self.stress(deformation), self.tangent(deformation))
    }
    /// W, S and ∂S/∂E, with what they share computed once.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_stress_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, Symmetric<T>, MajorSymmetric<T>) {
        let (stress, tangent) = self.stress_and_tangent(deformation);
        (self.energy(deformation), stress, tangent)
    }
    /// P = F S.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        first_piola_of(&self.stress(deformation), deformation)
    }
    /// P and the 45 entries of ∂P/∂F on and above its diagonal: what batches write.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn upper_triangle<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        let (stress, tangent) = self.stress_and_tangent(deformation);
        first_piola_numbers(deformation.gradient_rows(), &stress, &tangent)
    }
    /// Where the law has no answer.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        Ok(())
    }
}

/// A law of straight code that asks for nothing but Green's strain: P and ∂P/∂F in one loop over lanes.
pub(super) trait GreenEnergy: Copy {
    /// S of E.
    fn green_stress<T: Real>(&self, strain: &Symmetric<T>) -> Symmetric<T>;
    /// S and ∂S/∂E of E.
    fn green_stress_and_tangent<T: Real>(&self, strain: &Symmetric<T>) -> (Symmetric<T>, MajorSymmetric<T>);

    /// P.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn in_lanes<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        packed::stress(T::lanewise(&OfGreen(*self), packed::of_deformation(deformation)))
    }
    /// P and the upper triangle of ∂P/∂F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn both_in_lanes<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        T::lanewise(&OfGreen(*self), packed::of_deformation(deformation))
    }
}

/// Answers of F and ∇u.
struct OfGreen<L>(L);

impl<L: GreenEnergy> Lanewise<18, 9> for OfGreen<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 9] {
        let [f, h] = packed::gradients(inputs);
        packed::of_stress(product(f, self.0.green_stress(&green(h)).rows()))
    }
}

impl<L: GreenEnergy> Lanewise<18, 54> for OfGreen<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 54] {
        let [f, h] = packed::gradients(inputs);
        let (stress, tangent) = self.0.green_stress_and_tangent(&green(h));
        first_piola_numbers(f, &stress, &tangent)
    }
}

/// P = F S.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_piola_of<T: Real>(stress: &Symmetric<T>, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    FirstPiola(from_rows(product(deformation.gradient_rows(), stress.rows())))
}

/// P and the upper triangle of ∂P/∂F, `δ_ij S_AB + F_iC C_CADB F_jD`.
///
/// The kernel of `continuum` serves tangents without major symmetry, too: 81 entries in loops. A loop over lanes around that does
/// not become vectors (75 ns a point for St. Venant and Kirchhoff's law of any symmetry); 45 entries written out do (9 ns).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn first_piola_numbers<T: Real>(f: Rows<T>, stress: &Symmetric<T>, tangent: &MajorSymmetric<T>) -> [T; 54] {
    let (s, slots) = (stress.rows(), tangent.slots());
    let mut entries = [[T::zero(); 9]; 9];
    macro_rules! row {
        ($r:literal: $($c:literal)+) => {{
            let [x, y, z] = [&slots[SLOT[0][$r % 3]], &slots[SLOT[1][$r % 3]], &slots[SLOT[2][$r % 3]]];
            let [p, q, r] = f[$r / 3];
            macro_rules! half {
                ($k:literal) => {
                    p * x[$k] + q * y[$k] + r * z[$k]
                };
            }
            let half = [half!(0), half!(1), half!(2), half!(3), half!(4), half!(5)];
            $(
                let entry = dot(f[$c / 3], [half[SLOT[0][$c % 3]], half[SLOT[1][$c % 3]], half[SLOT[2][$c % 3]]]);
                entries[$r][$c] = if $r / 3 == $c / 3 { entry + s[$r % 3][$c % 3] } else { entry };
            )+
        }};
    }
    rows_of_upper_triangle!(row);
    packed::of_both(product(f, s), &entries)
}

/// C⁻¹ and 1 − C⁻¹, the latter without cancellation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn inverse_metric<T: Real>(deformation: &impl Deformation<T>) -> (Symmetric<T>, Symmetric<T>) {
    // F⁻¹ = 1 − K: 1 − C⁻¹ = K + Kᵀ − K Kᵀ.
    let k = deformation.spatial_displacement_rows();
    let less = piola_continuum::internal::strain::almansi(transpose(k)) * T::lit(2.0);
    (Symmetric::gram(deformation.inverse_rows()), less)
}

/// A constant tensor over any scalar.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn constant<T: Real>(tensor: &Symmetric) -> Symmetric<T> {
    // A loop: `map` would be a call, which lanes pay with all their registers.
    let mut components = [T::zero(); 6];
    let mut k = 0;
    while k < 6 {
        components[k] = T::lit(tensor.components[k]);
        k += 1;
    }
    Symmetric { components }
}

/// A constant tensor over any scalar.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn constant_tangent<T: Real>(tensor: &MajorSymmetric) -> MajorSymmetric<T> {
    let mut components = [T::zero(); 21];
    let mut k = 0;
    while k < 21 {
        components[k] = T::lit(tensor.components[k]);
        k += 1;
    }
    MajorSymmetric { components }
}

/// Stress and the upper triangle of a tangent that is that of strain. Written out as [`first_piola_numbers`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn linear_numbers<T: Real>(stress: &Symmetric<T>, tangent: &MajorSymmetric<T>) -> [T; 54] {
    let slots = tangent.slots();
    let mut entries = [[T::zero(); 9]; 9];
    macro_rules! row {
        ($r:literal: $($c:literal)+) => { $(
            entries[$r][$c] = slots[SLOT[$r / 3][$r % 3]][SLOT[$c / 3][$c % 3]];
        )+ };
    }
    rows_of_upper_triangle!(row);
    packed::of_both(stress.rows(), &entries)
}

/// Pairs of answers of a law in which stress and strain are linear: tangents share nothing with stresses, and W = ½ σ : ε.
macro_rules! linear_pairs {
    () => {
        answers! { |self, deformation|
            energy_and_first_piola -> (T, piola_continuum::FirstPiola<T>) {
                let stress = self.second_piola(deformation).0;
                let strain = piola_continuum::strain::LinearStrain::of(deformation).0;
                (T::lit(0.5) * stress.double_contraction(&strain), piola_continuum::FirstPiola(stress.matrix()))
            }
            energy_first_piola_and_tangent ->
                (T, piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                let (energy, stress) = self.energy_and_first_piola(deformation);
                (energy, stress, self.first_piola_tangent(deformation))
            }
            first_piola_and_tangent ->
                (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                (self.first_piola(deformation), self.first_piola_tangent(deformation))
            }
            second_piola_and_tangent ->
                (piola_continuum::SecondPiola<T>, piola_continuum::stress::tangents::MaterialTangent<T>) {
                (self.second_piola(deformation), self.material_tangent(deformation))
            }
            cauchy_and_tangent ->
                (piola_continuum::CauchyStress<T>, piola_continuum::stress::tangents::TruesdellTangent<T>) {
                (self.cauchy(deformation), self.truesdell_tangent(deformation))
            }
        }
    };
}
pub(super) use linear_pairs;

/// Writes [`Hyperelastic`](super::Hyperelastic) for a law of Green's strain.
macro_rules! hyperelastic_of_strain {
    ($law:ty) => {
        impl $crate::Hyperelastic for $law {
            const REFUSED_IS_NOT_FINITE: bool = <$law as $crate::strain_energy::StrainEnergy>::REFUSED_IS_NOT_FINITE;

            answers! { |self, deformation|
                energy -> T { $crate::strain_energy::StrainEnergy::energy(self, deformation) }
                check -> Result<(), $crate::SolidsError> { $crate::strain_energy::StrainEnergy::check(self, deformation) }
                first_piola -> piola_continuum::FirstPiola<T> {
                    $crate::strain_energy::StrainEnergy::first_piola(self, deformation)
                }
                energy_and_first_piola -> (T, piola_continuum::FirstPiola<T>) {
                    let (energy, stress, _) = self.energy_stress_and_tangent(deformation);
                    (energy, $crate::strain_energy::first_piola_of(&stress, deformation))
                }
                energy_first_piola_and_tangent ->
                    (T, piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                    let (energy, stress, tangent) = self.energy_stress_and_tangent(deformation);
                    let f = deformation.gradient_rows();
                    let numbers = $crate::strain_energy::first_piola_numbers(f, &stress, &tangent);
                    let (stress, tangent) = $crate::packed::both(numbers);
                    (energy, stress, tangent)
                }
                second_piola -> piola_continuum::SecondPiola<T> {
                    piola_continuum::SecondPiola(self.stress(deformation))
                }
                kirchhoff -> piola_continuum::KirchhoffStress<T> {
                    piola_continuum::KirchhoffStress(self.stress(deformation).congruence(deformation.gradient_rows()))
                }
                first_piola_tangent -> piola_continuum::stress::tangents::FirstPiolaTangent<T> {
                    self.first_piola_and_tangent(deformation).1
                }
                first_piola_and_tangent ->
                    (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                    $crate::packed::both(self.upper_triangle(deformation))
                }
                first_piola_and_upper_triangle -> [T; 54] { self.upper_triangle(deformation) }
                material_tangent -> piola_continuum::stress::tangents::MaterialTangent<T> {
                    piola_continuum::stress::tangents::MaterialTangent(self.tangent(deformation))
                }
                second_piola_and_tangent ->
                    (piola_continuum::SecondPiola<T>, piola_continuum::stress::tangents::MaterialTangent<T>) {
                    let (stress, tangent) = self.stress_and_tangent(deformation);
                    (piola_continuum::SecondPiola(stress), piola_continuum::stress::tangents::MaterialTangent(tangent))
                }
                cauchy_and_tangent ->
                    (piola_continuum::CauchyStress<T>, piola_continuum::stress::tangents::TruesdellTangent<T>) {
                    let (stress, tangent) = self.stress_and_tangent(deformation);
                    let spatial = stress.congruence(deformation.gradient_rows());
                    (
                        piola_continuum::KirchhoffStress(spatial).cauchy(deformation),
                        piola_continuum::stress::tangents::MaterialTangent(tangent).truesdell(deformation),
                    )
                }
            }
        }
    };
}
pub(super) use hyperelastic_of_strain;
