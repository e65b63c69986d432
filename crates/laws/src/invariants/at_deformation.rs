//! The arguments of an energy of invariants at a deformation, as numbers.

use piola_continuum::internal::strain as kernels;
use piola_continuum::strain::invariants;
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::Real;
use piola_numerics::internal::volume_excess;
use piola_solids::internal::Unimodular;
use piola_solids::invariant::{first_excess, second_excess};

use super::energy::EnergyOfInvariants;
use super::excesses::Excesses;

/// The arguments at a deformation, over its own scalar: for the energy.
pub(super) struct AtDeformation<'a, D, L> {
    pub(super) deformation: &'a D,
    pub(super) law: &'a L,
}

/// a · (C − 1) a, and a · (C² − 1) a = 2 a · (C − 1) a + |(C − 1) a|².
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn along<T: Real>(change: &Symmetric<T>, direction: [f64; 3]) -> [T; 2] {
    let [x, y, z] = [T::lit(direction[0]), T::lit(direction[1]), T::lit(direction[2])];
    let [u, v, w] = change.apply([x, y, z]);
    let fourth = x * u + y * v + z * w;
    [fourth, T::lit(2.0) * fourth + (u * u + v * v + w * w)]
}

impl<D, L: EnergyOfInvariants> AtDeformation<'_, D, L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn along<T: Real>(&self, family: usize) -> [T; 2]
    where
        D: Deformation<T>,
    {
        if L::FIBRES <= family {
            return [T::lit(f64::NAN); 2];
        }
        along(&kernels::right_cauchy_green_minus_one(self.deformation.displacement_rows()), self.law.fibre(family))
    }
}

impl<T: Real, D: Deformation<T>, L: EnergyOfInvariants> Excesses<T> for AtDeformation<'_, D, L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first(&self) -> T {
        invariants::first_minus_three(self.deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second(&self) -> T {
        invariants::second_minus_three(self.deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_excess(&self) -> T {
        first_excess(self.deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_excess(&self) -> T {
        second_excess(self.deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn isochoric_first(&self) -> T {
        invariants::isochoric_first_minus_three(self.deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn isochoric_second(&self) -> T {
        invariants::isochoric_second_minus_three(self.deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        self.deformation.volume_change()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        self.deformation.jacobian()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ln_jacobian(&self) -> T {
        self.deformation.ln_jacobian()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_excess(&self) -> T {
        volume_excess(self.deformation.volume_change(), self.deformation.jacobian())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fourth(&self, family: usize) -> T {
        self.along(family)[0]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fifth(&self, family: usize) -> T {
        self.along(family)[1]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn isochoric_fourth(&self, family: usize) -> T {
        let Unimodular { two_thirds, two_thirds_change, .. } =
            Unimodular::of(self.deformation.volume_change(), self.deformation.jacobian());
        two_thirds * self.fourth(family) + two_thirds_change
    }
}
