//! The Hamiltonian of any regular Lagrangian.
//!
//! ```text
//! p = ∂L/∂q̇ (q, q̇, t)        H(q, p, t) = p·q̇ − L                                     W(9.3), W(9.7), W(10.9)
//! ∂H/∂p = q̇        ∂H/∂q = −∂L/∂q        ∂H/∂t = −∂L/∂t                                W(9.11)
//! ```

use piola_numerics::Real;

use super::PhaseFunction;
use super::differential::undefined;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Potential};

/// The Hamiltonian of a Lagrangian as a function on phase space, for brackets, maps and integrals.
///
/// Where the Legendre map cannot be inverted its value is not a number, which every function of this module refuses by
/// name; [`Lagrangian::hamiltonian`] says why. Each evaluation makes the room it needs: for long motions take
/// [`Lagrangian::canonical_motion`], which does not.
///
/// # Example
/// The angular momentum of a planar oscillator is kept:
/// ```
/// use nalgebra::Vector3;
/// use piola_hamiltonian::{LegendreTransform, PhaseFunction, poisson_bracket};
/// use piola_lagrangian::{Holonomic, Lagrangian, Placement, Potential};
/// use piola_numerics::Real;
/// struct Particle; // 2 kg in a plane
/// impl Holonomic for Particle {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         bodies.particle(2.0, Vector3::new(q[0], q[1], T::zero()));
///     }
/// }
/// struct Spring;
/// impl Potential for Spring {
///     fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
///         T::lit(0.5) * (q[0] * q[0] + q[1] * q[1])
///     }
/// }
/// struct Moment;
/// impl PhaseFunction for Moment {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         q[0] * p[1] - q[1] * p[0]
///     }
/// }
/// let oscillator = Lagrangian::of(Particle).with_potential(Spring);
/// let hamiltonian = LegendreTransform(&oscillator);
/// assert_eq!(hamiltonian.value(&[1.0, 2.0], &[4.0, 2.0], 0.0), 5.0 + 2.5);
/// assert_eq!(poisson_bracket(&Moment, &hamiltonian, &[1.0, 2.0], &[4.0, 2.0], 0.0)?, 0.0);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.7), W(10.9).
#[derive(Clone, Copy, Debug)]
pub struct LegendreTransform<L>(pub L);

impl<S: Holonomic, P: Potential, F: Forces> PhaseFunction for LegendreTransform<&Lagrangian<S, P, F>> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        self.0.hamiltonian(q, p, t).unwrap_or_else(|_| undefined())
    }
}
