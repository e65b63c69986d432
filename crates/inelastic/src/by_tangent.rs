//! Derivatives of an elastic law by the chain rule, from its own S and ∂S/∂E.

use piola_continuum::internal::strain::right_cauchy_green;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{product, product_transposed};
use piola_tensor::{MajorSymmetric, PairSymmetric};

/// An elastic law that numbers with first derivatives pass through by the chain rule.
///
/// ```text
/// W = W₀ + S₀ : δE        S = S₀ + ∂S/∂E : δE        P = F S        τ = F S Fᵀ
/// ```
/// S₀ and ∂S/∂E are those of the law at plain numbers; δE is E without its value. So a law that is chosen at run time is compiled for
/// plain numbers alone, whatever the equations of a step are differentiated by. Of plain numbers only S₀ is computed. Lanes and numbers
/// with second derivatives go through the law itself.
///
/// # Accuracy
/// That of the law's S and ∂S/∂E; derivatives add 8 ulp of |F|² |∂S/∂E|.
///
/// # Example
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{ByTangent, InelasticPoint, ReeseGovindjee, StepControl};
/// use piola_solids::{AnySolid, SaintVenantKirchhoff};
/// let spring = ByTangent(AnySolid::from(SaintVenantKirchhoff::new(1.0, 2.0)?));
/// let law = ReeseGovindjee::new(spring.clone(), spring, 0.5)?;
/// let shear = DeformationGradient::simple_shear(1e-3)?;
/// let stress = InelasticPoint::new(&law).advance(&shear, 1e-9, &StepControl::one_step())?.first_piola.0;
/// assert!((stress[(0, 1)] - 4e-3).abs() < 1e-8); // 2 μ k
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct ByTangent<L>(pub L);

/// Tells scalars of one value with at most first derivatives from others.
struct Simple<T>(T);

impl<T: Real> Simple<T> {
    const IS: bool = T::LANES == 1 && T::ORDER <= 1;
}

impl<L: Hyperelastic> ByTangent<L> {
    /// S₀ and ∂S/∂E.
    #[inline(never)]
    fn plain(&self, deformation: &impl Deformation<f64>) -> (SecondPiola, MajorSymmetric) {
        let (stress, tangent) = self.0.second_piola_and_tangent(deformation);
        (stress, tangent.0)
    }

    /// S₀ alone.
    #[inline(never)]
    fn plain_stress(&self, deformation: &impl Deformation<f64>) -> SecondPiola {
        self.0.second_piola(deformation)
    }

    fn chained<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        let at = deformation.lifted(|_, _, x| x.primal(0));
        if T::ORDER == 0 {
            return Symmetric { components: self.plain_stress(&at).0.components.map(T::lit) };
        }
        let (stress, tangent) = self.plain(&at);
        let mut components = stress.0.components.map(T::lit);
        let (rows, change) = (tangent.slots(), change(deformation));
        for (component, row) in components.iter_mut().zip(rows) {
            for (place, (entry, change)) in row.into_iter().zip(change.components).enumerate() {
                *component += T::lit(if place < 3 { entry } else { 2.0 * entry }) * change;
            }
        }
        Symmetric { components }
    }

    fn chained_energy<T: Real>(&self, deformation: &impl Deformation<T>, stress: &Symmetric<T>) -> T {
        let energy = T::lit(self.0.energy(&deformation.lifted(|_, _, x| x.primal(0))));
        if T::ORDER == 0 {
            return energy;
        }
        energy + stress.double_contraction(&change(deformation))
    }
}

/// E without its value, which is zero.
fn change<T: Real>(deformation: &impl Deformation<T>) -> Symmetric<T> {
    let twice = right_cauchy_green(deformation.gradient_rows());
    Symmetric { components: twice.components.map(|x| (x - x.frozen()) * T::lit(0.5)) }
}

/// P = F S.
fn first_piola<T: Real>(deformation: &impl Deformation<T>, stress: &Symmetric<T>) -> FirstPiola<T> {
    FirstPiola(from_rows(product(deformation.gradient_rows(), stress.rows())))
}

impl<L: Hyperelastic> Hyperelastic for ByTangent<L> {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        if Simple::<T>::IS && T::ORDER == 0 {
            T::lit(self.0.energy(&deformation.lifted(|_, _, x| x.primal(0))))
        } else if Simple::<T>::IS {
            self.chained_energy(deformation, &self.chained(deformation))
        } else {
            self.0.energy(deformation)
        }
    }

    fn reference_energy(&self) -> f64 {
        self.0.reference_energy()
    }

    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        if Simple::<T>::IS {
            self.0.check(&deformation.lifted(|_, _, x| x.primal(0)))
        } else {
            self.0.check(deformation)
        }
    }

    fn is_incompressible(&self) -> bool {
        self.0.is_incompressible()
    }

    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        if Simple::<T>::IS {
            first_piola(deformation, &self.chained(deformation))
        } else {
            self.0.first_piola(deformation)
        }
    }

    fn energy_and_first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> (T, FirstPiola<T>) {
        if Simple::<T>::IS {
            let stress = self.chained(deformation);
            (self.chained_energy(deformation, &stress), first_piola(deformation, &stress))
        } else {
            self.0.energy_and_first_piola(deformation)
        }
    }

    fn second_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        if Simple::<T>::IS { SecondPiola(self.chained(deformation)) } else { self.0.second_piola(deformation) }
    }

    fn kirchhoff<T: Real>(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        if Simple::<T>::IS {
            let f = deformation.gradient_rows();
            let stress = product_transposed(product(f, self.chained(deformation).rows()), f);
            KirchhoffStress(Symmetric::symmetric_part(stress))
        } else {
            self.0.kirchhoff(deformation)
        }
    }

    fn first_piola_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        self.0.first_piola_tangent(deformation)
    }

    fn first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        self.0.first_piola_and_tangent(deformation)
    }

    fn energy_first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
        self.0.energy_first_piola_and_tangent(deformation)
    }

    fn second_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (SecondPiola<T>, MaterialTangent<T>) {
        self.0.second_piola_and_tangent(deformation)
    }
}
