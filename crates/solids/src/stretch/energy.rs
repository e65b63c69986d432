//! An energy of principal stretches with its derivatives.

use piola_continuum::Deformation;
use piola_numerics::Real;

use crate::SolidsError;

/// The volume as its part U(J) of an energy wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume<T> {
    /// ln J.
    pub logarithm: T,
    /// J − 1.
    pub change: T,
    /// J.
    pub jacobian: T,
}

impl<T: Real> Volume<T> {
    /// That of F or ∇u.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self {
            logarithm: deformation.ln_jacobian(),
            change: deformation.volume_change(),
            jacobian: deformation.jacobian(),
        }
    }
}

/// An energy Σ w(ln λₐ) + U(J) with its derivatives in closed form.
pub trait StretchEnergy {
    /// True if w acts on the isochoric part J^(−1/3) F of the deformation.
    const ISOCHORIC: bool;

    /// Refuses deformations at which the law has no answer.
    ///
    /// # Errors
    /// [`SolidsError::BeyondLimit`]; most laws have no limit.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        Ok(())
    }

    /// True if the body keeps its volume.
    #[must_use]
    fn is_incompressible(&self) -> bool {
        false
    }

    /// w(x), J/m³, w(0) = w′(0) = 0, without cancellation near 0.
    #[must_use]
    fn part<T: Real>(&self, x: T) -> T;

    /// w′(x), Pa, without cancellation near 0.
    #[must_use]
    fn slope<T: Real>(&self, x: T) -> T;

    /// w″(x), Pa.
    #[must_use]
    fn curvature<T: Real>(&self, x: T) -> T;

    /// w″(0), Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn curvature_at_rest<T: Real>(&self) -> T {
        self.curvature(T::zero())
    }

    /// w′[x, y] = (w′(x) − w′(y))/(x − y), w″(x) for x = y.
    #[must_use]
    fn secant<T: Real>(&self, x: T, y: T) -> T;

    /// U(J), J/m³, without cancellation.
    #[must_use]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T;

    /// J U′, Pa, without cancellation.
    #[must_use]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T;

    /// J (J U′)′, Pa.
    #[must_use]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T;
}

/// J^(−1/3) for an isochoric law, whose stretches are λₐ times it; otherwise 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn isochoric_scale<T: Real, L: StretchEnergy>(volume: &Volume<T>) -> T {
    if L::ISOCHORIC { volume.jacobian.recip_cbrt() } else { T::one() }
}
