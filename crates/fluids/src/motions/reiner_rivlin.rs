//! The fluid of Reiner and Rivlin in any motion.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_numerics::Real;

use super::stokesian::invariants;
use super::viscous::ViscousFluid;
use crate::{ReinerRivlin, ReinerRivlinCoefficients};

impl<C: ReinerRivlinCoefficients> ViscousFluid for ReinerRivlin<C> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extra_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let d = velocity_gradient.rate_of_deformation().0;
        let invariants = invariants(&d);
        d * self.0.first(invariants) + d.square() * self.0.second(invariants)
    }
}
