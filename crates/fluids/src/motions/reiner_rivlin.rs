//! The fluid of Reiner and Rivlin in any motion.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_numerics::Real;

use super::viscous::ViscousFluid;
use crate::{ReinerRivlin, ReinerRivlinCoefficients};

impl<C: ReinerRivlinCoefficients> ViscousFluid for ReinerRivlin<C> {
    #[inline(always)]
    fn extra_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let stretching = velocity_gradient.rate_of_deformation().0;
        let trace = stretching.trace();
        let second = T::lit(0.5) * (trace * trace - stretching.double_contraction(&stretching));
        let invariants = [trace, second, stretching.determinant()];
        stretching * self.0.first(invariants) + stretching.square() * self.0.second(invariants)
    }
}
