//! An energy of invariants with its derivatives.

use piola_continuum::Deformation;
use piola_continuum::strain::invariants;
use piola_numerics::Real;

use crate::SolidsError;

/// I₁ − 3, I₂ − 3, J − 1 and J of a deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants<T> {
    /// I₁ − 3 of C.
    pub first: T,
    /// I₂ − 3 of C; zero where the law does not use it.
    pub second: T,
    /// J − 1.
    pub change: T,
    /// J.
    pub jacobian: T,
    /// I₁, with the digits that I₁ − 3 has lost where a body is compressed to nearly nothing.
    pub first_whole: T,
    /// I₂; 3 where the law does not use it.
    pub second_whole: T,
}

/// First derivatives of W(I₁, I₂, J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes<T> {
    /// ∂W/∂I₁, Pa.
    pub first: T,
    /// ∂W/∂I₂, Pa.
    pub second: T,
    /// s = 2 ∂W/∂I₁ + 4 ∂W/∂I₂ + J ∂W/∂J, Pa, without cancellation: what a stress-free law has none of at the reference.
    pub residual: T,
    /// J ∂W/∂J, Pa, from I₁ and I₂ whole: of the digits that s − 2 ∂W/∂I₁ − 4 ∂W/∂I₂ loses far from the reference.
    pub volume: T,
}

/// Second derivatives of W(I₁, I₂, J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvatures<T> {
    /// ∂²W/∂I₁².
    pub first_first: T,
    /// ∂²W/∂I₁∂I₂.
    pub first_second: T,
    /// ∂²W/∂I₂².
    pub second_second: T,
    /// ∂²W/∂I₁∂J.
    pub first_volume: T,
    /// ∂²W/∂I₂∂J.
    pub second_volume: T,
    /// ∂²W/∂J².
    pub volume_volume: T,
}

impl<T: Real> Curvatures<T> {
    /// Those of a law whose only curvature is that of the volume.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of_volume(volume_volume: T) -> Self {
        let o = T::zero();
        Self { first_first: o, first_second: o, second_second: o, first_volume: o, second_volume: o, volume_volume }
    }
}

/// An isotropic energy W(I₁, I₂, J) with its derivatives in closed form.
pub trait InvariantEnergy: Clone {
    /// True if W depends on I₂; otherwise its terms are not compiled.
    const SECOND: bool;
    /// True if a second derivative other than ∂²W/∂J² is not zero.
    const CURVED: bool;
    /// See [`Hyperelastic::REFUSED_IS_NOT_FINITE`](crate::Hyperelastic::REFUSED_IS_NOT_FINITE).
    const REFUSED_IS_NOT_FINITE: bool = false;
    /// True if slopes and curvatures are straight code, without a loop of a length that is known at run time only: lanes
    /// are then computed by [`Real::lanewise`] while the strain is moderate, with a copy of the law. A law with such loops, or
    /// that is not copied at once, is slower by that.
    const STRAIGHT: bool = false;

    /// W less W of the reference, J/m³, without cancellation: see [`first_excess`](super::first_excess) and [`second_excess`](super::second_excess).
    #[must_use]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T;

    /// W of the reference as the formula is printed, J/m³.
    #[must_use]
    fn reference_energy(&self) -> f64 {
        0.0
    }

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

    /// Its first derivatives.
    #[must_use]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T>;

    /// Its second derivatives.
    #[must_use]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T>;

    /// Both, with what they share computed once.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn slopes_and_curvatures<T: Real>(&self, invariants: &Invariants<T>) -> (Slopes<T>, Curvatures<T>) {
        (self.slopes(invariants), self.curvatures(invariants))
    }
}

/// The invariants that a law uses.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn invariants_of<T: Real, L: InvariantEnergy>(_law: &L, deformation: &impl Deformation<T>) -> Invariants<T> {
    let first = invariants::first_minus_three(deformation);
    let second = if L::SECOND { invariants::second_minus_three(deformation) } else { T::zero() };
    let three = T::lit(3.0);
    Invariants {
        first,
        second,
        change: deformation.volume_change(),
        jacobian: deformation.jacobian(),
        first_whole: first + three,
        second_whole: second + three,
    }
}
