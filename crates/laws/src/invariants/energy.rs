//! The trait of energies of invariants.

use piola_numerics::Real;
use piola_solids::SolidsError;

use super::excesses::Excesses;

/// An energy of invariants of C = Fᵀ F, isotropic or with up to two families of fibres.
///
/// Write [`energy`](Self::energy); [`OfInvariants`](super::OfInvariants) makes a [`Hyperelastic`](piola_solids::Hyperelastic) law of it.
///
/// # Example
/// A law in ten lines: W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)².
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::{EnergyOfInvariants, Excesses, OfInvariants};
/// use piola_numerics::Real;
/// use piola_solids::Hyperelastic;
///
/// #[derive(Clone, Copy)]
/// struct Mine { mu: f64, lambda: f64 }
///
/// impl EnergyOfInvariants for Mine {
///     #[inline(always)]
///     fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
///         let volume = at.ln_jacobian();
///         T::lit(0.5 * self.mu) * at.first_excess() + T::lit(0.5 * self.lambda) * volume * volume
///     }
/// }
///
/// let law = OfInvariants(Mine { mu: 2.0, lambda: 3.0 });
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// assert_eq!(law.cauchy(&shear).0.components[3], 1.0); // μ k
/// assert_eq!(law.first_piola_tangent(&shear).entry(0, 1, 0, 1), 3.25); // μ + (μ + λ) k²
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub trait EnergyOfInvariants: Clone {
    /// The number of families of fibres, at most two.
    const FIBRES: usize = 0;
    /// False if W does not depend on I₂: its terms are then not computed. If it does all the same, stresses are NaN.
    const SECOND: bool = true;
    /// False if the only second derivative of W by I₁, I₂ and J that is not zero is ∂²W/∂J²: those of others are then not computed.
    const CURVED: bool = true;
    /// False if the energy has a loop of a length known at run time only, or is not copied at once.
    const STRAIGHT: bool = true;

    /// W of its arguments, J/m³; zero at the reference, where all arguments are.
    ///
    /// For lanes mark it `#[inline(always)]`.
    #[must_use]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T;

    /// The unit vector along a family of fibres in the reference configuration.
    #[must_use]
    fn fibre(&self, _family: usize) -> [f64; 3] {
        [1.0, 0.0, 0.0]
    }

    /// Refuses deformations at which the law has no answer.
    ///
    /// # Errors
    /// [`SolidsError::BeyondLimit`]; most laws have no limit.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, _at: &impl Excesses<T>) -> Result<(), SolidsError> {
        Ok(())
    }
}
