//! Placement maps: generalised coordinates and time ↦ particles and bodies.
//!
//! ```text
//! (q, t) ↦ (x^α;  ξ^β, attitude^β)        W(3.2), time-dependent W(3.24)
//! h_Δ = (∂x^α/∂q^Δ;  ∂ξ^β/∂q^Δ, ω^β_Δ)     W(3.5)
//! ```
//!
//! A system says where its parts are, once, for any scalar; everything else (velocities, inertia metric,
//! equations of motion) follows by exact differentiation.
//!
//! ```
//! use nalgebra::Vector3;
//! use piola_kinematics::{Holonomic, Placement, placement};
//! use piola_numerics::Real;
//!
//! /// A pendulum in the plane x–z; q = [angle from the vertical].
//! struct Pendulum { mass: f64, length: f64 }
//!
//! impl Holonomic for Pendulum {
//!     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
//!         let (s, c) = q[0].sin_cos();
//!         let length = T::lit(self.length);
//!         bodies.particle(self.mass, Vector3::new(length * s, T::zero(), -length * c));
//!     }
//! }
//! assert_eq!(placement::count(&Pendulum { mass: 1.0, length: 2.0 }, &[0.5], 0.0).particles, 1);
//! ```
//!
//! # Which one?
//! [`PlacementEvaluator`] for positions, velocities, accelerations and tangent vectors of all parts;
//! [`count`] to size the buffers; [`independence`] to see that no coordinate is superfluous.
//!
//! # References
//! W(3.2–3.13), W(3.24–3.31).

mod evaluator;
mod independence;

use nalgebra::Vector3;
use piola_numerics::Real;

use crate::attitude::Attitude;
use crate::rigid_body::RigidBody;

pub use evaluator::PlacementEvaluator;
pub use independence::{Independence, independence};

/// Receives the particles and bodies of a system, in the order in which the system places them.
///
/// Implementors collect what they need: positions, velocities, the inertia metric.
pub trait Placement<T: Real> {
    /// A particle of the given mass (kg) at a position (m, space components).
    fn particle(&mut self, mass: f64, position: Vector3<T>);
    /// A body with its centre of mass at `centre` (m, space components) in the given attitude.
    fn body(&mut self, body: &RigidBody, centre: Vector3<T>, attitude: Attitude<T>);
}

/// A holonomic system: its placement map.
///
/// The number and order of the parts must not depend on `q` or `t`.
///
/// # Example
/// See the [module](self).
///
/// # Source
/// W(3.2), W(3.24).
#[doc(alias("generalised coordinates", "generalized coordinates"))]
pub trait Holonomic {
    /// Whether the placement depends on time explicitly. A system that says no never pays for the row of
    /// time.
    const TIME_DEPENDENT: bool = false;

    /// Places all particles and bodies at the generalised coordinates `q` and the time `t` (s).
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>);
}

impl<S: Holonomic> Holonomic for &S {
    const TIME_DEPENDENT: bool = S::TIME_DEPENDENT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        (**self).place(q, t, bodies);
    }
}

/// How many parts a system has: the result of [`count`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct PartCount {
    /// Particles.
    pub particles: usize,
    /// Rigid bodies.
    pub bodies: usize,
}

impl<T: Real> Placement<T> for PartCount {
    fn particle(&mut self, _mass: f64, _position: Vector3<T>) {
        self.particles += 1;
    }
    fn body(&mut self, _body: &RigidBody, _centre: Vector3<T>, _attitude: Attitude<T>) {
        self.bodies += 1;
    }
}

/// How many particles and bodies a system places.
#[must_use]
pub fn count<T: Real>(system: &impl Holonomic, q: &[T], t: T) -> PartCount {
    let mut parts = PartCount::default();
    system.place(q, t, &mut parts);
    parts
}
