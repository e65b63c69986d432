//! Laws of principal stretches Σ w(ln λₐ) + U(J): one's own two functions of one variable.
//!
//! Slope, curvature and divided difference of w are exact derivatives of its formula; equal stretches are no special case, see
//! [`piola_solids::stretch`].

use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::{Dual, Hessian, Mask, Real, Secant};
use piola_solids::stretch::{self, StretchEnergy, Volume};
use piola_solids::{Hyperelastic, SolidsError};

use crate::methods::answers;

/// An energy Σ w(ln λₐ) + U(J) of the principal stretches (Valanis and Landel's form).
///
/// Write [`part`](Self::part) and, unless it is zero, [`volume_energy`](Self::volume_energy); [`OfStretches`] makes a
/// [`Hyperelastic`] law of them. At small strain the stress keeps its digits if the terms of w′ do: the derivative of eˣ − 1 − x
/// does not, that of [`excess_of_exponential`] does.
///
/// # Example
/// Hencky's law, W = μ Σ (ln λₐ)² + ½ λ (ln J)².
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::{EnergyOfStretches, OfStretches};
/// use piola_numerics::Real;
/// use piola_solids::Hyperelastic;
/// use piola_solids::stretch::Volume;
///
/// struct Mine { mu: f64, lambda: f64 }
///
/// impl EnergyOfStretches for Mine {
///     #[inline(always)]
///     fn part<T: Real>(&self, logarithm: T) -> T {
///         T::lit(self.mu) * logarithm * logarithm
///     }
///     #[inline(always)]
///     fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
///         T::lit(0.5 * self.lambda) * volume.logarithm * volume.logarithm
///     }
/// }
///
/// let law = OfStretches(Mine { mu: 2.0, lambda: 0.0 });
/// let bar = DeformationGradient::diagonal([1.0_f64.exp(), 1.0, 1.0])?;
/// assert!((law.kirchhoff(&bar).0.components[0] - 4.0).abs() < 1e-14); // 2 μ ln λ
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub trait EnergyOfStretches {
    /// True if w acts on the isochoric part J^(−1/3) F of the deformation.
    const ISOCHORIC: bool = false;

    /// w(x) of x = ln λ, J/m³: w(0) = w′(0) = 0.
    #[must_use]
    fn part<T: Real>(&self, logarithm: T) -> T;

    /// U(J), J/m³, zero at J = 1.
    #[must_use]
    fn volume_energy<T: Real>(&self, _volume: &Volume<T>) -> T {
        T::zero()
    }

    /// Refuses deformations at which the law has no answer.
    ///
    /// # Errors
    /// [`SolidsError::BeyondLimit`]; most laws have no limit.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        Ok(())
    }
}

/// eˣ − 1 − x, of second order in x, without cancellation in itself or in its derivatives.
///
/// # Example
/// ```
/// use piola_laws::stretches::excess_of_exponential;
/// use piola_numerics::Dual;
/// assert_eq!(excess_of_exponential(Dual::variable(1e-20)).tangent, 1e-20); // eˣ − 1
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn excess_of_exponential<T: Real>(x: T) -> T {
    piola_numerics::internal::excess_of_exponential(x)
}

/// The law of an [`EnergyOfStretches`].
///
/// # Accuracy
/// That of the formulas of w and its derivative, see [`piola_solids::stretch`].
///
/// # Example
/// See [`EnergyOfStretches`]: the wrapped type is public.
/// ```
/// use piola_laws::OfStretches;
/// assert_eq!(OfStretches(3.0).0, 3.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfStretches<L>(
    /// The energy.
    pub L,
);

impl<L: EnergyOfStretches> OfStretches<L> {
    /// U with its first two derivatives by ln J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn varied<T: Real>(&self, volume: &Volume<T>) -> Hessian<T, 1, 1> {
        let j = volume.jacobian;
        let growing = |value: T| Hessian::constant(value).with_partial(0, j).with_second_partial((0, 0), j);
        self.0.volume_energy(&Volume {
            logarithm: Hessian::variable(volume.logarithm, 0),
            change: growing(volume.change),
            jacobian: growing(j),
        })
    }
}

impl<L: EnergyOfStretches> StretchEnergy for OfStretches<L> {
    const ISOCHORIC: bool = L::ISOCHORIC;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        self.0.check(deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Real>(&self, x: T) -> T {
        self.0.part(x)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope<T: Real>(&self, x: T) -> T {
        self.0.part(Dual::variable(x)).tangent
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, x: T) -> T {
        self.0.part(Hessian::<T, 1, 1>::variable(x, 0)).second_partial(0, 0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn secant<T: Real>(&self, x: T, y: T) -> T {
        let change = y - x;
        let apart = change.less_than(T::zero()) | T::zero().less_than(change);
        let slope = self.0.part(Dual::variable(Secant::new(x, change))).tangent;
        let quotient = slope.change / T::select(apart, change, T::one());
        if apart.all() { quotient } else { T::select(apart, quotient, self.curvature(x)) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        self.0.volume_energy(volume)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        self.varied(volume).partials()[0]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T {
        self.varied(volume).second_partial(0, 0)
    }
}

/// Writes each method by the function of the same name.
macro_rules! by_functions {
    ($($method:ident -> $result:ty),+ $(,)?) => {
        answers! { |self, deformation| $($method -> $result { stretch::$method(self, deformation) })+ }
    };
}
pub(crate) use by_functions;

impl<L: EnergyOfStretches> Hyperelastic for OfStretches<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        self.0.check(deformation)
    }

    by_functions! {
        energy -> T,
        first_piola -> FirstPiola<T>,
        energy_and_first_piola -> (T, FirstPiola<T>),
        energy_first_piola_and_tangent -> (T, FirstPiola<T>, FirstPiolaTangent<T>),
        second_piola -> SecondPiola<T>,
        kirchhoff -> KirchhoffStress<T>,
        first_piola_tangent -> FirstPiolaTangent<T>,
        first_piola_and_tangent -> (FirstPiola<T>, FirstPiolaTangent<T>),
        material_tangent -> MaterialTangent<T>,
        truesdell_tangent -> TruesdellTangent<T>,
        second_piola_and_tangent -> (SecondPiola<T>, MaterialTangent<T>),
        cauchy_and_tangent -> (CauchyStress<T>, TruesdellTangent<T>),
    }
}
