//! Laws with S and ∂S/∂E in closed form as one type.

use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{FirstPiola, SecondPiola};
use piola_numerics::linear::matrix3::from_rows;
use piola_solids::internal::{first_piola_numbers, packed};
use piola_solids::{
    AnisotropicSaintVenantKirchhoff, Fung, HolzapfelGasserOgden, Hyperelastic, ReinforcedNeoHookean,
    SaintVenantKirchhoff, SolidsError,
};
use piola_tensor::internal::rows::product;

use super::kind;
use crate::methods::answers;

kind! {
    /// A built-in law that gives S and ∂S/∂E: one kernel for P and ∂P/∂F of all.
    ///
    /// # Accuracy
    /// That of the law's S and ∂S/∂E; P = F S and ∂P/∂F add a few ulp.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::kinds::LawOfStrain;
    /// use piola_solids::{AnySolid, Fibre, Hyperelastic, ReinforcedNeoHookean};
    /// let solid = AnySolid::from(ReinforcedNeoHookean::new(2.0, 0.0, 1.0, Fibre::new([1.0, 0.0, 0.0])?)?);
    /// let law = LawOfStrain::of(&solid).ok_or("a law of strain")?;
    /// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
    /// let stress: f64 = law.first_piola(&bar).0[(0, 0)];
    /// assert!((stress - 15.0).abs() < 1e-14); // μ (λ₁ − 1/λ₁) + 2 k λ₁ (λ₁² − 1)
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    LawOfStrain {
        HolzapfelGasserOgden(HolzapfelGasserOgden),
        ReinforcedNeoHookean(ReinforcedNeoHookean),
        SaintVenantKirchhoff(SaintVenantKirchhoff),
        AnisotropicSaintVenantKirchhoff(AnisotropicSaintVenantKirchhoff),
        Fung(Fung),
    }
}

impl Hyperelastic for LawOfStrain<'_> {
    answers! { |self, deformation|
        energy -> T { chosen!(self, law => law.energy(deformation)) }
        check -> Result<(), SolidsError> { chosen!(self, law => law.check(deformation)) }
        first_piola -> FirstPiola<T> {
            let stress = self.second_piola(deformation).0;
            FirstPiola(from_rows(product(deformation.gradient_rows(), stress.rows())))
        }
        energy_and_first_piola -> (T, FirstPiola<T>) { (self.energy(deformation), self.first_piola(deformation)) }
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
            let (stress, tangent) = self.first_piola_and_tangent(deformation);
            (self.energy(deformation), stress, tangent)
        }
        second_piola -> SecondPiola<T> { chosen!(self, law => law.second_piola(deformation)) }
        first_piola_tangent -> FirstPiolaTangent<T> { self.first_piola_and_tangent(deformation).1 }
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>) {
            packed::both(self.first_piola_and_upper_triangle(deformation))
        }
        first_piola_and_upper_triangle -> [T; 54] {
            let (stress, tangent) = self.second_piola_and_tangent(deformation);
            first_piola_numbers(deformation.gradient_rows(), &stress.0, &tangent.0)
        }
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>) {
            chosen!(self, law => law.second_piola_and_tangent(deformation))
        }
    }
}
