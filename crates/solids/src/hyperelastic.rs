//! The trait of hyperelastic laws.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{
    CauchyStress, Deformation, DeformationGradient, FirstPiola, KirchhoffStress, SecondPiola, Symmetric,
};
use piola_numerics::{Dual, Real};

use crate::{SolidsError, packed};

/// A solid whose stress has a potential: the stored energy W per reference volume.
///
/// Only [`energy`](Self::energy) must be given, as one function over any scalar. What is not overridden is its exact
/// derivative; a law with closed forms overrides [`first_piola`](Self::first_piola) and
/// [`first_piola_tangent`](Self::first_piola_tangent), from which all others follow.
///
/// | method | what | unit |
/// |---|---|---|
/// | `energy` | W | J/m³ |
/// | `first_piola`, `second_piola`, `kirchhoff`, `cauchy` | P, S, τ, T | Pa |
/// | `first_piola_tangent`, `material_tangent`, `truesdell_tangent` | ∂P/∂F, ∂S/∂E, c/J | Pa |
/// | `first_piola_and_tangent`, `second_piola_and_tangent`, `cauchy_and_tangent` | stress and its tangent, with what they share computed once | Pa |
/// | `first_piola_derivative` | (∂P/∂F) : δF, without the tangent | Pa |
///
/// # Accuracy
/// A derived stress is as accurate as the terms of the energy's derivative: near the reference, where these cancel, a few
/// ulp of the moduli. Closed forms keep a relative 1e-13 down to ∇u = 1e-16 and say so. W itself is of second order there,
/// and known to a few ulp of the moduli where F is given after a rotation.
///
/// # Example
/// A law in ten lines, W = ½ λ (tr E)² + μ E : E.
/// ```
/// use piola_solids::Hyperelastic;
/// use piola_continuum::strain::GreenStrain;
/// use piola_continuum::{Deformation, DeformationGradient};
/// use piola_numerics::Real;
///
/// struct Mine { lambda: f64, mu: f64 }
///
/// impl Hyperelastic for Mine {
///     fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
///         let strain = GreenStrain::of(deformation).0;
///         let trace = strain.trace();
///         T::lit(0.5 * self.lambda) * trace * trace + T::lit(self.mu) * strain.double_contraction(&strain)
///     }
/// }
///
/// let law = Mine { lambda: 1.0, mu: 2.0 };
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// assert_eq!(law.second_piola(&bar).0.components[0], 7.5); // (λ + 2μ) E₁₁
/// assert_eq!(law.first_piola_tangent(&bar).entry(0, 0, 0, 0), 27.5); // S₁₁ + F₁₁² (λ + 2μ)
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(20.8–20.13), B(4.60).
pub trait Hyperelastic {
    /// True if every result is NaN or ∞ wherever [`check`](Self::check) fails. Batches then call `check` only after a
    /// non-finite result.
    const REFUSED_IS_NOT_FINITE: bool = false;
    /// True if the first components of P and ∂P/∂F are NaN or ∞ wherever 0 < det F fails. Batches then do not compute
    /// det F to find out.
    const KNOWS_DEFORMATIONS: bool = false;

    /// W(F) − W(1), J per m³ of the reference configuration.
    #[must_use]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T;

    /// W(1) as the formula is printed, J/m³: what to add to [`energy`](Self::energy) for the printed value.
    #[must_use]
    fn reference_energy(&self) -> f64 {
        0.0
    }

    /// Refuses deformations at which the law has no answer, such as those beyond a limiting stretch.
    ///
    /// # Errors
    /// [`SolidsError::BeyondLimit`]; most laws have no limit.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        Ok(())
    }

    /// True if the body keeps its volume: [`check`](Self::check) then refuses changes of volume, and stresses contain a
    /// given pressure, which equilibrium or a free face completes.
    #[must_use]
    fn is_incompressible(&self) -> bool {
        false
    }

    /// P = ∂W/∂F, W(20.13).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        derived::first_piola(self, deformation)
    }

    /// (W(F) − W(1), P), with what they share computed once. A law that gives P gives this, too.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn energy_and_first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> (T, FirstPiola<T>) {
        derived::energy_and_first_piola(self, deformation)
    }

    /// S = ∂W/∂E = F⁻¹ P, B(4.60).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn second_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.first_piola(deformation).second_piola(deformation)
    }

    /// τ = P Fᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn kirchhoff<T: Real>(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        self.first_piola(deformation).kirchhoff(deformation)
    }

    /// T = τ/J, W(20.12).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn cauchy<T: Real>(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.kirchhoff(deformation).cauchy(deformation)
    }

    /// A = ∂P/∂F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn first_piola_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        derived::first_piola_tangent(self, deformation)
    }

    /// (P, ∂P/∂F), with what they share computed once. A law that gives ∂P/∂F gives this, too.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        derived::first_piola_and_tangent(self, deformation)
    }

    /// (W(F) − W(1), P, ∂P/∂F), with what they share computed once. A law that gives ∂P/∂F gives this, too.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn energy_first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
        derived::energy_first_piola_and_tangent(self, deformation)
    }

    /// P by rows, then the 45 entries of ∂P/∂F on and above the diagonal of its 9×9 array, by rows: what batches write. A law
    /// that has these numbers before it has made tensors of them gives them here.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn first_piola_and_upper_triangle<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        packed::of_pair(self.first_piola_and_tangent(deformation))
    }

    /// (∂P/∂F) : δF, by the stress over dual numbers: the product with a direction without the tangent's 81 entries.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn first_piola_derivative<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
        direction: &Matrix3<T>,
    ) -> FirstPiola<T> {
        let varied = deformation.lifted(|i, j, x| Dual::new(x, direction[(i, j)]));
        FirstPiola(self.first_piola(&varied).0.map(|x| x.tangent))
    }

    /// ∂S/∂E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn material_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> MaterialTangent<T> {
        self.second_piola_and_tangent(deformation).1
    }

    /// (S, ∂S/∂E), with what they share computed once.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn second_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (SecondPiola<T>, MaterialTangent<T>) {
        let (first_piola, tangent) = self.first_piola_and_tangent(deformation);
        let stress = first_piola.second_piola(deformation);
        (stress, MaterialTangent(tangent.material(&stress, deformation).0.major_part()))
    }

    /// c/J: D ↦ the Truesdell rate of T.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn truesdell_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> TruesdellTangent<T> {
        self.material_tangent(deformation).truesdell(deformation)
    }

    /// (T, c/J), what an updated configuration needs, with what they share computed once.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn cauchy_and_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> (CauchyStress<T>, TruesdellTangent<T>) {
        let (stress, tangent) = self.second_piola_and_tangent(deformation);
        (stress.kirchhoff(deformation).cauchy(deformation), tangent.truesdell(deformation))
    }

    /// The stress of the reference configuration, S at F = 1: zero for a law that is stress-free there.
    #[must_use]
    fn reference_stress(&self) -> Symmetric {
        self.second_piola(&DeformationGradient::<f64>::identity()).0
    }
}

/// Stresses and tangents as exact derivatives of an energy.
pub mod derived {
    use nalgebra::Matrix3;
    use piola_continuum::stress::tangents::FirstPiolaTangent;
    use piola_continuum::{Deformation, FirstPiola};
    use piola_numerics::{Dual, Gradient, Real};
    use piola_tensor::FourthOrder;

    use super::Hyperelastic;

    /// P = ∂W/∂F by one evaluation with nine directions.
    #[inline]
    #[must_use]
    pub fn first_piola<T: Real, L: Hyperelastic + ?Sized>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        energy_and_first_piola(law, deformation).1
    }

    /// (W, P): the evaluation for P has W beside it.
    #[inline]
    #[must_use]
    pub fn energy_and_first_piola<T: Real, L: Hyperelastic + ?Sized>(
        law: &L,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>) {
        let varied = deformation.lifted(|i, j, x| Gradient::<T, 9>::variable(x, 3 * i + j));
        let Gradient { value, partials } = law.energy(&varied);
        (value, FirstPiola(Matrix3::from_fn(|i, j| partials[3 * i + j])))
    }

    /// ∂P/∂F = ∂²W/∂F∂F, a column at a time.
    #[inline]
    #[must_use]
    pub fn first_piola_tangent<T: Real, L: Hyperelastic + ?Sized>(
        law: &L,
        deformation: &impl Deformation<T>,
    ) -> FirstPiolaTangent<T> {
        first_piola_and_tangent(law, deformation).1
    }

    /// (P, ∂P/∂F): the evaluations for ∂P/∂F have P beside it.
    #[inline]
    #[must_use]
    pub fn first_piola_and_tangent<T: Real, L: Hyperelastic + ?Sized>(
        law: &L,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        let (_, stress, tangent) = energy_first_piola_and_tangent(law, deformation);
        (stress, tangent)
    }

    /// (W, P, ∂P/∂F): the evaluations for ∂P/∂F have W and P beside it.
    #[inline]
    #[must_use]
    pub fn energy_first_piola_and_tangent<T: Real, L: Hyperelastic + ?Sized>(
        law: &L,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
        let columns: [Gradient<Dual<T>, 9>; 9] =
            core::array::from_fn(|column| second_derivatives(law, deformation, column));
        let components =
            core::array::from_fn(|row| core::array::from_fn(|column| columns[column].partials[row].tangent));
        let first = &columns[0];
        let stress = Matrix3::from_fn(|i, j| first.partials[3 * i + j].value);
        (first.value.value, FirstPiola(stress), FirstPiolaTangent(FourthOrder { components }))
    }

    /// W, P and ∂P/∂F of one entry of F: compiled once for each law and scalar.
    #[inline(never)]
    fn second_derivatives<T: Real, L: Hyperelastic + ?Sized>(
        law: &L,
        deformation: &impl Deformation<T>,
        column: usize,
    ) -> Gradient<Dual<T>, 9> {
        let varied = deformation.lifted(|i, j, x| {
            let place = 3 * i + j;
            let inner = if place == column { Dual::variable(x) } else { Dual::constant(x) };
            Gradient::<Dual<T>, 9>::variable(inner, place)
        });
        law.energy(&varied)
    }
}
