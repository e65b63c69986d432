//! Laws W(E) of Green's strain: one's own function, differentiated in its six components.

use piola_continuum::internal::strain::green;
use piola_continuum::strain::GreenStrain;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::internal::Lanewise;
use piola_numerics::{Hessian, Real};
use piola_solids::internal::{first_piola_numbers, packed};
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::MajorSymmetric;
use piola_tensor::internal::rows::product;

use crate::methods::answers;

/// An energy of Green's strain E = ½ (Fᵀ F − 1), of any symmetry.
///
/// Write [`energy`](Self::energy); [`OfStrain`] makes a [`Hyperelastic`] law of it. An energy of C is one of 1 + 2 E.
///
/// # Example
/// A law in ten lines: W = ½ λ (tr E)² + μ E : E.
/// ```
/// use piola_continuum::{DeformationGradient, Symmetric};
/// use piola_laws::{EnergyOfStrain, OfStrain};
/// use piola_numerics::Real;
/// use piola_solids::Hyperelastic;
///
/// #[derive(Clone, Copy)]
/// struct Mine { lambda: f64, mu: f64 }
///
/// impl EnergyOfStrain for Mine {
///     #[inline(always)]
///     fn energy<T: Real>(&self, strain: &Symmetric<T>) -> T {
///         let trace = strain.trace();
///         T::lit(0.5 * self.lambda) * trace * trace + T::lit(self.mu) * strain.double_contraction(strain)
///     }
/// }
///
/// let law = OfStrain(Mine { lambda: 1.0, mu: 2.0 });
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// assert_eq!(law.second_piola(&bar).0.components[0], 7.5); // (λ + 2μ) E₁₁
/// assert_eq!(law.first_piola_tangent(&bar).entry(0, 0, 0, 0), 27.5); // S₁₁ + F₁₁² (λ + 2μ)
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub trait EnergyOfStrain: Clone {
    /// W of E, J/m³; zero at E = 0.
    ///
    /// For lanes mark it `#[inline(always)]`, and use no loop of a length known at run time only.
    #[must_use]
    fn energy<T: Real>(&self, strain: &Symmetric<T>) -> T;

    /// Refuses strains at which the law has no answer.
    ///
    /// # Errors
    /// [`SolidsError::BeyondLimit`]; most laws have no limit.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, _strain: &Symmetric<T>) -> Result<(), SolidsError> {
        Ok(())
    }
}

/// The law of an [`EnergyOfStrain`]: S and ∂S/∂E by one evaluation of the energy with six variables, each second derivative once;
/// P = F S and ∂P/∂F follow in closed form.
///
/// # Accuracy
/// That of the terms of the energy's derivative: those of the second order in E keep the relative accuracy of S at small strain.
///
/// # Example
/// See [`EnergyOfStrain`].
/// ```
/// use piola_continuum::{DeformationGradient, Symmetric};
/// use piola_laws::{EnergyOfStrain, OfStrain};
/// use piola_numerics::Real;
/// use piola_solids::Hyperelastic;
/// #[derive(Clone, Copy)]
/// struct Shear;
/// impl EnergyOfStrain for Shear {
///     fn energy<T: Real>(&self, strain: &Symmetric<T>) -> T {
///         strain.components[3] * strain.components[3] // W = E₁₂²
///     }
/// }
/// let sheared = DeformationGradient::simple_shear(0.5)?; // E₁₂ = ¼
/// assert_eq!(OfStrain(Shear).second_piola(&sheared).0.components[3], 0.25); // ½ ∂W/∂E₁₂
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfStrain<L>(
    /// The energy.
    pub L,
);

impl<L: EnergyOfStrain> OfStrain<L> {
    /// S and ∂S/∂E of E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress_and_tangent<T: Real>(&self, strain: &Symmetric<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        let [a, b, c, d, e, f] = strain.components;
        let varied = Symmetric {
            components: [
                Hessian::<T, 6, 21>::variable(a, 0),
                Hessian::variable(b, 1),
                Hessian::variable(c, 2),
                Hessian::variable(d, 3),
                Hessian::variable(e, 4),
                Hessian::variable(f, 5),
            ],
        };
        let energy = self.0.energy(&varied);
        let ([a, b, c, d, e, f], mut seconds) = (energy.partials(), energy.second_partials());
        // A component off the diagonal stands for two.
        let (half, quarter) = (T::lit(0.5), T::lit(0.25));
        macro_rules! halve {
            ($factor:ident: $($number:literal)*) => { $(seconds[$number] *= $factor;)* };
        }
        halve!(half: 3 4 5 8 9 10 12 13 14);
        halve!(quarter: 15 16 17 18 19 20);
        let stress = Symmetric { components: [a, b, c, half * d, half * e, half * f] };
        (stress, MajorSymmetric { components: seconds })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        self.stress_and_tangent(&GreenStrain::of(deformation).0)
    }
}

/// Answers of F and ∇u.
struct OfGreen<L>(OfStrain<L>);

impl<L: EnergyOfStrain> Lanewise<18, 9> for OfGreen<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 9] {
        let [f, h] = packed::gradients(inputs);
        packed::of_stress(product(f, self.0.stress_and_tangent(&green(h)).0.rows()))
    }
}

impl<L: EnergyOfStrain> Lanewise<18, 54> for OfGreen<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 54] {
        let [f, h] = packed::gradients(inputs);
        let (stress, tangent) = self.0.stress_and_tangent(&green(h));
        first_piola_numbers(f, &stress, &tangent)
    }
}

impl<L: EnergyOfStrain> Hyperelastic for OfStrain<L> {
    answers! { |self, deformation|
        energy -> T { self.0.energy(&GreenStrain::of(deformation).0) }
        check -> Result<(), SolidsError> { self.0.check(&GreenStrain::of(deformation).0) }
        first_piola -> FirstPiola<T> {
            packed::stress(T::lanewise(&OfGreen(self.clone()), packed::of_deformation(deformation)))
        }
        energy_and_first_piola -> (T, FirstPiola<T>) {
            (self.energy(deformation), self.first_piola(deformation))
        }
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
            let (stress, tangent) = self.first_piola_and_tangent(deformation);
            (self.energy(deformation), stress, tangent)
        }
        second_piola -> SecondPiola<T> { SecondPiola(self.at(deformation).0) }
        kirchhoff -> KirchhoffStress<T> {
            KirchhoffStress(self.at(deformation).0.congruence(deformation.gradient_rows()))
        }
        first_piola_tangent -> FirstPiolaTangent<T> { self.first_piola_and_tangent(deformation).1 }
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>) {
            packed::both(self.first_piola_and_upper_triangle(deformation))
        }
        first_piola_and_upper_triangle -> [T; 54] {
            T::lanewise(&OfGreen(self.clone()), packed::of_deformation(deformation))
        }
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>) {
            let (stress, tangent) = self.at(deformation);
            (SecondPiola(stress), MaterialTangent(tangent))
        }
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>) {
            let (stress, tangent) = self.second_piola_and_tangent(deformation);
            (stress.kirchhoff(deformation).cauchy(deformation), tangent.truesdell(deformation))
        }
    }
}
