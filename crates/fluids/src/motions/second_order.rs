//! The second-order fluid in any motion.

use piola_continuum::Symmetric;
use piola_continuum::rates::{RivlinEricksen, VelocityGradient};
use piola_numerics::Real;

use super::viscous::ViscousFluid;
use crate::SecondOrder;

impl SecondOrder {
    /// T + p 1, Pa, from the Rivlin–Ericksen tensors A₁ and A₂ of any flow.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn extra_stress_of<T: Real>(&self, first: &RivlinEricksen<T>, second: &RivlinEricksen<T>) -> Symmetric<T> {
        first.0 * T::lit(self.viscosity_coefficient())
            + second.0 * T::lit(self.alpha1())
            + first.0.square() * T::lit(self.alpha2())
    }
}

impl ViscousFluid for SecondOrder {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extra_stress<T: Real>(&self, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let first = RivlinEricksen::first(velocity_gradient);
        let second = first.next(&Symmetric::zero(), velocity_gradient);
        self.extra_stress_of(&first, &second)
    }
}
