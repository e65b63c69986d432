//! Energies of a change of shape, W̄(Ī₁, Ī₂): parts to combine with any energy of the change of volume.
//!
//! ```text
//! Ī₁ = J^(−2/3) I₁      Ī₂ = J^(−4/3) I₂      shear modulus of the reference μ = 2 (W̄₁ + W̄₂)
//! ```
//!
//! | type | W̄ | limit |
//! |---|---|---|
//! | [`NeoHookean`] | ½ μ (Ī₁ − 3) | |
//! | [`MooneyRivlin`] | C₁₀ (Ī₁ − 3) + C₀₁ (Ī₂ − 3) | |
//! | [`Yeoh`] | Σ Cᵢ (Ī₁ − 3)ⁱ, i = 1, 2, 3 | |
//! | [`Rivlin`] | Σ Cᵢⱼ (Ī₁ − 3)ⁱ (Ī₂ − 3)ʲ | |
//! | [`Gent`] | −½ μ Jₘ ln(1 − (Ī₁ − 3)/Jₘ) | Ī₁ − 3 < Jₘ |
//! | [`ArrudaBoyce`] | chains of N links, by the inverse Langevin function | Ī₁ < 3 N |
//! | [`ArrudaBoyceSeries`] | its first five terms | |
//!
//! [`Compressible`](super::Compressible) and [`IncompressibleSolid`](super::IncompressibleSolid) make solids of them. Where
//! which one is to be read from a file: [`AnyIsochoric`](super::AnyIsochoric).

use piola_numerics::Real;

use crate::SolidsError;

pub(crate) mod arruda_boyce;
pub(crate) mod gent;
mod langevin;
pub(crate) mod mooney_rivlin;
pub(crate) mod neo_hookean;
pub(crate) mod rivlin;
pub(crate) mod yeoh;

pub use arruda_boyce::{ArrudaBoyce, ArrudaBoyceSeries};
pub use gent::Gent;
pub use langevin::{inverse_langevin, langevin};
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::NeoHookean;
pub use rivlin::{Rivlin, RivlinTerm};
pub use yeoh::Yeoh;

/// An energy of Ī₁ − 3 and Ī₂ − 3, zero where both are.
///
/// The arguments are written x = Ī₁ − 3 and y = Ī₂ − 3. In an incompressible solid they are those of C itself.
///
/// # Example
/// One of your own, W̄ = ½ μ (exp x − 1), in a compressible solid.
/// ```
/// use piola_solids::isochoric::Isochoric;
/// use piola_solids::{Compressible, Hyperelastic, volumetric::Quadratic};
/// use piola_continuum::DeformationGradient;
/// use piola_numerics::Real;
/// #[derive(Clone)]
/// struct Mine(f64);
/// impl Isochoric for Mine {
///     const SECOND: bool = false;
///     fn energy<T: Real>(&self, first: T, _second: T) -> T {
///         T::lit(0.5 * self.0) * first.exp_m1()
///     }
///     fn slopes<T: Real>(&self, first: T, _second: T) -> [T; 2] {
///         [T::lit(0.5 * self.0) * first.exp(), T::zero()]
///     }
///     fn curvatures<T: Real>(&self, first: T, _second: T) -> [T; 3] {
///         [T::lit(0.5 * self.0) * first.exp(), T::zero(), T::zero()]
///     }
/// }
/// let solid = Compressible::new(Mine(2.0), Quadratic::new(10.0)?);
/// let shear = solid.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components[3];
/// assert!((shear - 2.0 * 1.0_f64.exp()).abs() < 1e-14); // μ k exp(k²)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Isochoric: Clone {
    /// True if W̄ depends on Ī₂.
    const SECOND: bool;
    /// True if energy, slopes and curvatures are NaN or ∞ wherever [`check`](Self::check) fails. Batches then call it
    /// only after a non-finite result.
    const REFUSED_IS_NOT_FINITE: bool = false;
    /// True if [`check`](Self::check) can fail at all; otherwise it is not called.
    const LIMITED: bool = true;
    /// See [`InvariantEnergy::STRAIGHT`](super::invariant::InvariantEnergy::STRAIGHT).
    const STRAIGHT: bool = false;

    /// W̄(x, y), J/m³.
    #[must_use]
    fn energy<T: Real>(&self, first: T, second: T) -> T;

    /// [∂W̄/∂x, ∂W̄/∂y], Pa.
    #[must_use]
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2];

    /// [∂²W̄/∂x², ∂²W̄/∂x∂y, ∂²W̄/∂y²], Pa.
    #[must_use]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3];

    /// The slopes and curvatures, with what they share computed once.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn slopes_and_curvatures<T: Real>(&self, first: T, second: T) -> ([T; 2], [T; 3]) {
        (self.slopes(first, second), self.curvatures(first, second))
    }

    /// Refuses changes of shape beyond what the law can answer.
    ///
    /// # Errors
    /// [`SolidsError::BeyondLimit`]; most laws have no limit.
    fn check(&self, _first: f64, _second: f64) -> Result<(), SolidsError> {
        Ok(())
    }

    /// The shear modulus of the reference, 2 (W̄₁ + W̄₂), Pa.
    #[must_use]
    fn shear_modulus(&self) -> f64 {
        let [first, second] = self.slopes(0.0, 0.0);
        2.0 * (first + second)
    }
}

impl<I: Isochoric> Isochoric for &I {
    const SECOND: bool = I::SECOND;
    const REFUSED_IS_NOT_FINITE: bool = I::REFUSED_IS_NOT_FINITE;
    const LIMITED: bool = I::LIMITED;
    const STRAIGHT: bool = I::STRAIGHT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        I::energy(self, first, second)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        I::slopes(self, first, second)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        I::curvatures(self, first, second)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_and_curvatures<T: Real>(&self, first: T, second: T) -> ([T; 2], [T; 3]) {
        I::slopes_and_curvatures(self, first, second)
    }
    fn check(&self, first: f64, second: f64) -> Result<(), SolidsError> {
        I::check(self, first, second)
    }
    fn shear_modulus(&self) -> f64 {
        I::shear_modulus(self)
    }
}

/// Checks each lane's x and y.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn check_lanes<T: Real>(law: &impl Isochoric, first: T, second: T) -> Result<(), SolidsError> {
    (0..T::LANES).try_for_each(|lane| law.check(first.primal(lane), second.primal(lane)))
}
