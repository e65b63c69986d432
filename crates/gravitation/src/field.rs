//! Gravitation as what integrators follow, over each kind of scalar.

use piola_integrators::{Field, SecondOrder, Separable};
use piola_numerics::{Dual, Element, Gradient, Lanes, Real};

use super::Gravitation;
use crate::GravitationError;

// One implementation for all scalars would keep `f64` from its sum in lanes.
macro_rules! follow_over {
    ($scalar:ty, $accelerations:ident, [$($generics:tt)*]) => {
        impl<$($generics)*> Separable<$scalar> for Gravitation {
            type Error = GravitationError;
            fn freedom(&self) -> usize {
                3 * self.bodies()
            }
            fn force(&mut self, _t: f64, position: &[$scalar], force: &mut [$scalar]) -> Result<(), GravitationError> {
                self.$accelerations(position, force)
            }
        }

        impl<$($generics)*> SecondOrder<$scalar> for Gravitation {
            type Error = GravitationError;
            const OWN_MAGNITUDES: bool = true;
            fn is_velocity_dependent(&self) -> bool {
                self.post_newtonian().is_some()
            }
            fn freedom(&self) -> usize {
                3 * self.bodies()
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn acceleration(
                &mut self,
                _t: $scalar,
                q: &[$scalar],
                v: &[$scalar],
                acceleration: &mut [$scalar],
            ) -> Result<(), GravitationError> {
                self.$accelerations(q, acceleration)?;
                self.add_post_newtonian(q, v, acceleration)
            }
            fn magnitudes(&self, state: &[$scalar], magnitudes: &mut [f64]) {
                self.magnitudes(state, magnitudes);
            }
        }

        impl<$($generics)*> Field<$scalar> for Gravitation {
            type Error = GravitationError;
            fn dimension(&self) -> usize {
                6 * self.bodies()
            }
            fn is_second_order(&self) -> bool {
                true
            }
            fn rate(&mut self, _t: f64, y: &[$scalar], rate: &mut [$scalar]) -> Result<(), GravitationError> {
                let (positions, velocities) = y.split_at(3 * self.bodies());
                let (rate, accelerations) = rate.split_at_mut(3 * self.bodies());
                rate.copy_from_slice(velocities);
                self.$accelerations(positions, accelerations)?;
                self.add_post_newtonian(positions, velocities, accelerations)
            }
            fn magnitudes(&self, y: &[$scalar], magnitudes: &mut [f64]) {
                self.magnitudes(y, magnitudes);
            }
        }
    };
}

follow_over!(f64, accelerations_into, []);
follow_over!(f32, accelerations_over, []);
follow_over!(Dual<T>, accelerations_over, [T: Real]);
follow_over!(Gradient<T, N>, accelerations_over, [T: Real, const N: usize]);
follow_over!(Lanes<E, N>, accelerations_over, [E: Element, const N: usize]);
