//! Laws W(E) with S and ∂S/∂E in closed form: P = F S and ∂P/∂F follow.

use piola_continuum::stress::tangents::{FirstPiolaTangent, kernels};
use piola_continuum::tensor::rows::{product, transpose};
use piola_continuum::tensor::{FourthOrder, MajorSymmetric, PairSymmetric};
use piola_continuum::{Deformation, FirstPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use crate::ConstitutiveError;

/// An energy of Green's strain with its derivatives in closed form.
pub(super) trait StrainEnergy {
    /// W less W of the reference, J/m³.
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T;
    /// S = ∂W/∂E, Pa, without cancellation.
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T>;
    /// ∂S/∂E, Pa.
    fn tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> MajorSymmetric<T>;
    /// S and ∂S/∂E, with what they share computed once.
    #[inline(always)]
    fn stress_and_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        (self.stress(deformation), self.tangent(deformation))
    }
    /// W, S and ∂S/∂E, with what they share computed once.
    #[inline(always)]
    fn energy_stress_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, Symmetric<T>, MajorSymmetric<T>) {
        let (stress, tangent) = self.stress_and_tangent(deformation);
        (self.energy(deformation), stress, tangent)
    }
    /// Where the law has no answer.
    #[inline(always)]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), ConstitutiveError> {
        Ok(())
    }
}

/// P = F S.
#[inline(always)]
pub(super) fn nominal<T: Real>(stress: &Symmetric<T>, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    FirstPiola(from_rows(product(deformation.gradient_rows(), stress.rows())))
}

/// ∂P/∂F.
#[inline(always)]
pub(super) fn nominal_tangent<T: Real>(
    stress: &Symmetric<T>,
    tangent: &MajorSymmetric<T>,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    let mut components = kernels::first_piola_tangent(deformation.gradient_rows(), stress, &tangent.slots());
    // Symmetric to the last bit.
    for place in 1..9 {
        let (above, below) = components.split_at_mut(place);
        for (entry, mirror) in below[0].iter_mut().zip(above) {
            *entry = mirror[place];
        }
    }
    FirstPiolaTangent(FourthOrder { components })
}

/// C⁻¹ and 1 − C⁻¹, the latter without cancellation.
#[inline(always)]
pub(super) fn inverse_metric<T: Real>(deformation: &impl Deformation<T>) -> (Symmetric<T>, Symmetric<T>) {
    // F⁻¹ = 1 − K: 1 − C⁻¹ = K + Kᵀ − K Kᵀ.
    let k = deformation.spatial_displacement_rows();
    let less = piola_continuum::strain::kernels::almansi(transpose(k)) * T::lit(2.0);
    (Symmetric::gram(deformation.inverse_rows()), less)
}

/// A constant tensor over any scalar.
#[inline(always)]
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
#[inline(always)]
pub(super) fn constant_tangent<T: Real>(tensor: &MajorSymmetric) -> MajorSymmetric<T> {
    let mut components = [T::zero(); 21];
    let mut k = 0;
    while k < 21 {
        components[k] = T::lit(tensor.components[k]);
        k += 1;
    }
    MajorSymmetric { components }
}

/// Pairs of answers of a law in which stress and strain are linear: tangents share nothing with stresses, and W = ½ σ : ε.
macro_rules! linear_pairs {
    () => {
        #[inline(always)]
        fn energy_and_first_piola<T: piola_numerics::Real>(
            &self,
            deformation: &impl piola_continuum::Deformation<T>,
        ) -> (T, piola_continuum::FirstPiola<T>) {
            let stress = self.second_piola(deformation).0;
            let strain = piola_continuum::strain::LinearStrain::of(deformation).0;
            (T::lit(0.5) * stress.double_contraction(&strain), piola_continuum::FirstPiola(stress.matrix()))
        }
        #[inline(always)]
        fn energy_first_piola_and_tangent<T: piola_numerics::Real>(
            &self,
            deformation: &impl piola_continuum::Deformation<T>,
        ) -> (T, piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
            let (energy, stress) = self.energy_and_first_piola(deformation);
            (energy, stress, self.first_piola_tangent(deformation))
        }
        #[inline(always)]
        fn first_piola_and_tangent<T: piola_numerics::Real>(
            &self,
            deformation: &impl piola_continuum::Deformation<T>,
        ) -> (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
            (self.first_piola(deformation), self.first_piola_tangent(deformation))
        }
        #[inline(always)]
        fn second_piola_and_tangent<T: piola_numerics::Real>(
            &self,
            deformation: &impl piola_continuum::Deformation<T>,
        ) -> (piola_continuum::SecondPiola<T>, piola_continuum::stress::tangents::MaterialTangent<T>) {
            (self.second_piola(deformation), self.material_tangent(deformation))
        }
        #[inline(always)]
        fn cauchy_and_tangent<T: piola_numerics::Real>(
            &self,
            deformation: &impl piola_continuum::Deformation<T>,
        ) -> (piola_continuum::CauchyStress<T>, piola_continuum::stress::tangents::TruesdellTangent<T>) {
            (self.cauchy(deformation), self.truesdell_tangent(deformation))
        }
    };
}
pub(super) use linear_pairs;

/// Writes [`Hyperelastic`](super::Hyperelastic) for a law of Green's strain.
macro_rules! hyperelastic_of_strain {
    ($law:ty) => {
        impl $crate::solids::Hyperelastic for $law {
            #[inline(always)]
            fn energy<T: piola_numerics::Real>(&self, deformation: &impl piola_continuum::Deformation<T>) -> T {
                $crate::solids::strain_energy::StrainEnergy::energy(self, deformation)
            }
            #[inline(always)]
            fn check<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> Result<(), $crate::ConstitutiveError> {
                $crate::solids::strain_energy::StrainEnergy::check(self, deformation)
            }
            #[inline(always)]
            fn first_piola<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::FirstPiola<T> {
                $crate::solids::strain_energy::nominal(&self.stress(deformation), deformation)
            }
            #[inline(always)]
            fn energy_and_first_piola<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (T, piola_continuum::FirstPiola<T>) {
                let (energy, stress, _) = self.energy_stress_and_tangent(deformation);
                (energy, $crate::solids::strain_energy::nominal(&stress, deformation))
            }
            #[inline(always)]
            fn energy_first_piola_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (T, piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                let (energy, stress, tangent) = self.energy_stress_and_tangent(deformation);
                (
                    energy,
                    $crate::solids::strain_energy::nominal(&stress, deformation),
                    $crate::solids::strain_energy::nominal_tangent(&stress, &tangent, deformation),
                )
            }
            #[inline(always)]
            fn second_piola<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::SecondPiola<T> {
                piola_continuum::SecondPiola(self.stress(deformation))
            }
            #[inline(always)]
            fn kirchhoff<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::KirchhoffStress<T> {
                piola_continuum::KirchhoffStress(self.stress(deformation).congruence(deformation.gradient_rows()))
            }
            #[inline(always)]
            fn first_piola_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::stress::tangents::FirstPiolaTangent<T> {
                let (stress, tangent) = self.stress_and_tangent(deformation);
                $crate::solids::strain_energy::nominal_tangent(&stress, &tangent, deformation)
            }
            #[inline(always)]
            fn first_piola_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>) {
                let (stress, tangent) = self.stress_and_tangent(deformation);
                (
                    $crate::solids::strain_energy::nominal(&stress, deformation),
                    $crate::solids::strain_energy::nominal_tangent(&stress, &tangent, deformation),
                )
            }
            #[inline(always)]
            fn material_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> piola_continuum::stress::tangents::MaterialTangent<T> {
                piola_continuum::stress::tangents::MaterialTangent(self.tangent(deformation))
            }
            #[inline(always)]
            fn second_piola_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (piola_continuum::SecondPiola<T>, piola_continuum::stress::tangents::MaterialTangent<T>) {
                let (stress, tangent) = self.stress_and_tangent(deformation);
                (piola_continuum::SecondPiola(stress), piola_continuum::stress::tangents::MaterialTangent(tangent))
            }
            #[inline(always)]
            fn cauchy_and_tangent<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> (piola_continuum::CauchyStress<T>, piola_continuum::stress::tangents::TruesdellTangent<T>) {
                let (stress, tangent) = self.stress_and_tangent(deformation);
                let spatial = stress.congruence(deformation.gradient_rows());
                (
                    piola_continuum::KirchhoffStress(spatial).cauchy(deformation),
                    piola_continuum::stress::tangents::MaterialTangent(tangent).truesdell(deformation),
                )
            }
        }
    };
}
pub(super) use hyperelastic_of_strain;
