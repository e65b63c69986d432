//! The arguments of an energy of invariants as functions of the variables a, b, θ, I₄, …

use piola_numerics::internal::volume_excess;
use piola_numerics::{Hessian, Mask, Real};
use piola_solids::internal::Unimodular;
use piola_solids::invariant::Invariants;

use super::excesses::{Excesses, MOST_FAMILIES};

/// The number of the variable a.
pub(super) const FIRST: usize = 0;
/// The number of the variable b.
pub(super) const SECOND: usize = 1;
/// The number of the variable θ.
pub(super) const LOGARITHM: usize = 2;
/// The number of the variable I₄ of the first family; those of the next follow.
pub(super) const FOURTH: usize = 3;
/// The number of the variable I₅ of the first family; those of the next follow.
pub(super) const FIFTH: usize = FOURTH + MOST_FAMILIES;

/// The arguments at a point as functions of the variables: for the derivatives of the energy.
pub(super) struct Variables<'a, T> {
    pub(super) isotropic: &'a Invariants<T>,
    /// I₄ − 1 and I₅ − 1 of each family.
    pub(super) fibres: [[T; 2]; MOST_FAMILIES],
    /// How many families there are.
    pub(super) families: usize,
    /// Whether I₂ is known.
    pub(super) second: bool,
}

impl<T: Real> Variables<'_, T> {
    /// An argument that the energy does not have: NaN, and so is every stress of it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn missing<const N: usize, const PAIRS: usize>() -> Hessian<T, N, PAIRS> {
        let nan = T::lit(f64::NAN);
        Self::of_volume(nan, nan, nan)
    }

    /// J^(−2/3) and its difference from 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scale(&self) -> (T, T) {
        let Unimodular { two_thirds, two_thirds_change, .. } =
            Unimodular::of(self.isotropic.change, self.isotropic.jacobian);
        (two_thirds, two_thirds_change)
    }

    /// Where the volume is so near that of the reference that differences from it keep their digits.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_beside(&self) -> T::Mask {
        self.isotropic.change.abs().at_most(T::lit(0.875))
    }

    /// J − 1 − ln J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn excess(&self) -> T {
        volume_excess(self.isotropic.change, self.isotropic.jacobian)
    }

    /// What grows with the volume alone, with its first and second derivative by ln J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_volume<const N: usize, const PAIRS: usize>(value: T, slope: T, curvature: T) -> Hessian<T, N, PAIRS> {
        Hessian::constant(value).with_partial(LOGARITHM, slope).with_second_partial((LOGARITHM, LOGARITHM), curvature)
    }

    /// g (I + c) less a constant, g = J^(−c/3): its rate by ln J is −(c/3) g I, of which I is the excess, and
    /// at a reference without stress nothing cancels.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scaled<const N: usize, const PAIRS: usize>(
        value: T,
        scale: T,
        excess: T,
        (direction, order): (usize, f64),
    ) -> Hessian<T, N, PAIRS> {
        let rate = T::lit(-order / 3.0);
        let falling = rate * scale;
        Hessian::constant(value)
            .with_partial(direction, scale)
            .with_partial(LOGARITHM, falling * excess)
            .with_second_partial((direction, LOGARITHM), falling)
            .with_second_partial((LOGARITHM, LOGARITHM), falling * (rate * excess + T::lit(order)))
    }
}

impl<T: Real, const N: usize, const PAIRS: usize> Excesses<Hessian<T, N, PAIRS>> for Variables<'_, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first(&self) -> Hessian<T, N, PAIRS> {
        Hessian::variable(self.isotropic.first, FIRST).with_partial(LOGARITHM, T::lit(2.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second(&self) -> Hessian<T, N, PAIRS> {
        if !self.second {
            return Self::missing();
        }
        Hessian::variable(self.isotropic.second, SECOND).with_partial(LOGARITHM, T::lit(4.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_excess(&self) -> Hessian<T, N, PAIRS> {
        let two = T::lit(2.0);
        let beyond = self.isotropic.first - two * self.isotropic.change;
        Hessian::variable(beyond + two * self.excess(), FIRST)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_excess(&self) -> Hessian<T, N, PAIRS> {
        if !self.second {
            return Self::missing();
        }
        let four = T::lit(4.0);
        let beyond = self.isotropic.second - four * self.isotropic.change;
        Hessian::variable(beyond + four * self.excess(), SECOND)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn isochoric_first(&self) -> Hessian<T, N, PAIRS> {
        let ((scale, scale_change), three) = (self.scale(), T::lit(3.0));
        let mut value = scale * self.isotropic.first + three * scale_change;
        let beside = self.is_beside();
        if !beside.all() {
            value = T::select(beside, value, scale * self.isotropic.first_whole - three);
        }
        Self::scaled(value, scale, self.isotropic.first, (FIRST, 2.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn isochoric_second(&self) -> Hessian<T, N, PAIRS> {
        if !self.second {
            return Self::missing();
        }
        let ((scale, scale_change), three) = (self.scale(), T::lit(3.0));
        let square = scale * scale;
        let mut value = square * self.isotropic.second + three * scale_change * (scale + T::one());
        let beside = self.is_beside();
        if !beside.all() {
            value = T::select(beside, value, square * self.isotropic.second_whole - three);
        }
        Self::scaled(value, square, self.isotropic.second, (SECOND, 4.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> Hessian<T, N, PAIRS> {
        Self::of_volume(self.isotropic.change, self.isotropic.jacobian, self.isotropic.jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> Hessian<T, N, PAIRS> {
        Self::of_volume(self.isotropic.jacobian, self.isotropic.jacobian, self.isotropic.jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ln_jacobian(&self) -> Hessian<T, N, PAIRS> {
        Hessian::variable(self.isotropic.change.ln_1p_given(self.isotropic.jacobian), LOGARITHM)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_excess(&self) -> Hessian<T, N, PAIRS> {
        Self::of_volume(self.excess(), self.isotropic.change, self.isotropic.jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fourth(&self, family: usize) -> Hessian<T, N, PAIRS> {
        if self.families <= family {
            return Self::missing();
        }
        Hessian::variable(self.fibres[family][0], FOURTH + family)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fifth(&self, family: usize) -> Hessian<T, N, PAIRS> {
        if self.families <= family {
            return Self::missing();
        }
        Hessian::variable(self.fibres[family][1], FIFTH + family)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn isochoric_fourth(&self, family: usize) -> Hessian<T, N, PAIRS> {
        if self.families <= family {
            return Self::missing();
        }
        let (scale, scale_change) = self.scale();
        let fourth = self.fibres[family][0];
        let falling = T::lit(-2.0 / 3.0) * scale;
        let whole = fourth + T::one();
        Hessian::constant(scale * fourth + scale_change)
            .with_partial(FOURTH + family, scale)
            .with_partial(LOGARITHM, falling * whole)
            .with_second_partial((FOURTH + family, LOGARITHM), falling)
            .with_second_partial((LOGARITHM, LOGARITHM), T::lit(-2.0 / 3.0) * (falling * whole))
    }
}
