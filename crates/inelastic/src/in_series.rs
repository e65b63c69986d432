//! Two springs in series, the second damped or not.

use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, product, product_transposed};

use crate::error::check_bound;
use crate::{Evolution, InelasticError, flow};

/// A spring in series with another, beside which a dashpot may stand (Poynting and Thomson's solid).
///
/// ```text
/// F = Fₑ Fᵢ        W = W₁(Fₑ) + W₂(Fᵢ)        M₁ = τ₂(Fᵢ) + 2 η Dᵢ,   Ḟᵢ = Dᵢ Fᵢ,   P = P₁(Fₑ) Fᵢ⁻ᵀ
/// ```
/// M₁ = Cₑ Sₑ. Without a dashpot, η = 0, the two share the load at once: an elastic solid, independent of the rate. Both laws may be any
/// isotropic energy. The nine internal variables are Fᵢ by rows. A network in parallel is the sum of the energies of `piola-laws`, or
/// the law at rest of [`ReeseGovindjee`](crate::ReeseGovindjee).
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | η | `viscosity` | Pa s | 0 ≤ η |
///
/// # Accuracy
/// That of the [`StepControl`](crate::StepControl).
///
/// # Example
/// Two equal springs in series are half as stiff.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{InSeries, InelasticPoint, StepControl};
/// use piola_solids::{Hencky, Hyperelastic};
/// let law = InSeries::new(Hencky::new(2.0, 1.0)?, Hencky::new(2.0, 1.0)?, 0.0)?;
/// let bar = DeformationGradient::diagonal([1.5, 0.9, 0.8])?;
/// let stress = InelasticPoint::new(&law).advance(&bar, 1.0, &StepControl::one_step())?.first_piola.0[(0, 0)];
/// let half = Hencky::new(1.0, 0.5)?.first_piola(&bar).0[(0, 0)];
/// assert!((stress - half).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("series", "network", "Poynting-Thomson", "Zener"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct InSeries<A, B> {
    pub(crate) first: A,
    pub(crate) second: B,
    viscosity: f64,
    /// The largest component of ∂S/∂E of both at rest, Pa: what stresses are divided by.
    #[cfg_attr(feature = "serde", serde(skip))]
    modulus: f64,
}

const LAW: &str = "springs in series";

impl<A: Hyperelastic, B: Hyperelastic> InSeries<A, B> {
    /// Of the two springs and η, Pa s.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn new(first: A, second: B, viscosity: f64) -> Result<Self, InelasticError> {
        check_bound(LAW, "viscosity", viscosity, "0 ≤ η", 0.0 <= viscosity)?;
        let rest = DeformationGradient::<f64>::identity();
        let both = [first.material_tangent(&rest).0.components, second.material_tangent(&rest).0.components];
        let modulus = both.as_flattened().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        check_bound(LAW, "modulus", modulus, "0 < modulus", 0.0 < modulus)?;
        Ok(Self { first, second, viscosity, modulus })
    }

    /// τ₂ = P₂ Fᵢᵀ.
    fn kirchhoff<T: Real>(&self, inelastic: &Rows<T>) -> Symmetric<T> {
        let stress = self.second.first_piola(&DeformationGradient::trusted(*inelastic));
        Symmetric::symmetric_part(product_transposed(rows_of(&stress.0), *inelastic))
    }
}

impl<A: Hyperelastic, B: Hyperelastic> Evolution<9, 6> for InSeries<A, B> {
    fn initial(&self) -> [f64; 9] {
        flow::virgin()
    }

    fn residual<T: Real>(&self, from: &[T; 9], gradient: &Rows<T>, unknowns: &[T; 6], dt: f64) -> [T; 6] {
        let (before, increment) = (flow::inelastic(from), flow::increment(unknowns));
        let driving = flow::mandel(&self.first, &flow::elastic(gradient, &before, &increment));
        let resisting = self.kirchhoff(&product(flow::exponential(&increment), before));
        // With a dashpot the equation is one of the increment, over 2 η; its step may be short.
        let (stress, damping) =
            if 0.0 < self.viscosity { (dt / (2.0 * self.viscosity), 1.0) } else { (1.0 / self.modulus, 0.0) };
        (increment * T::lit(damping) - (driving - resisting) * T::lit(stress)).components
    }

    fn updated<T: Real>(&self, from: &[T; 9], _gradient: &Rows<T>, unknowns: &[T; 6], _dt: f64) -> [T; 9] {
        let after = product(flow::exponential(&flow::increment(unknowns)), flow::inelastic(from));
        flow::with_inelastic(*from, &after)
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 9]) -> Rows<T> {
        flow::first_piola(&self.first, gradient, &flow::inelastic(state))
    }

    fn coordinates<T: Real>(&self, about: &[T; 9], state: &[T; 9]) -> [T; 9] {
        flow::coordinates(about, state)
    }

    fn at_coordinates<T: Real>(&self, about: &[T; 9], coordinates: &[T; 9]) -> [T; 9] {
        flow::at_coordinates(about, coordinates, false)
    }

    /// (M₁ − τ₂) : Δ.
    fn dissipated(&self, from: &[f64; 9], gradient: &Rows<f64>, state: &[f64; 9]) -> f64 {
        let increment = Symmetric::symmetric_part(flow::inelastic(&flow::coordinates(from, state)));
        let driven = flow::dissipated(&self.first, from, gradient, state);
        driven - self.kirchhoff(&flow::inelastic(state)).double_contraction(&increment)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 9]) -> Result<(), SolidsError> {
        let inelastic = flow::inelastic(state);
        self.second.check(&DeformationGradient::trusted(inelastic))?;
        self.first.check(&DeformationGradient::trusted(flow::elastic(gradient, &inelastic, &Symmetric::zero())))
    }
}
