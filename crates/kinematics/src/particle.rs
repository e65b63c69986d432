//! Particles: motion in a moving frame, momentum, angular momentum, kinetic energy and their rates.
//!
//! ```text
//! x = o + xⁱ e_i
//! v = v° + ẋⁱ e_i + xⁱ ė_i                                  W(1.9)
//! a = a° + ẍⁱ e_i + 2 ẋⁱ ė_i + xⁱ ë_i
//! l = m v          h = r × m v          e = ½ m v·v          W(1.13)
//! dl/dt = m a      dh/dt = r × m a      de/dt = m v·a        W(1.14)
//! ```
//!
//! In a frame that turns with ω the last two terms of a are Coriolis' 2ω×ẋ and ω̇×x + ω×(ω×x), the
//! accelerations of Euler and towards the axis.
//!
//! # References
//! W(1.2–1.14).

use nalgebra::Vector3;
use piola_numerics::{Jet, Real};

use crate::vector::{cross, dot, scaled};

/// A position and its first two derivatives.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::particle::Motion;
/// use piola_numerics::{Jet, Real};
/// // Free fall z = −½ g t² at t = 2 s with g = 10 m/s².
/// let z = |t: Jet<f64, 0>| Jet::lit(-5.0) * t * t;
/// let fall = Motion::along(|t| Vector3::new(Jet::lit(0.0), Jet::lit(0.0), z(t)), 2.0);
/// assert_eq!((fall.position.z, fall.velocity.z, fall.acceleration.z), (-20.0, -20.0, -10.0));
/// ```
///
/// # Source
/// W(1.2–1.3).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
pub struct Motion<T: Real> {
    /// x (m).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub position: Vector3<T>,
    /// v = dx/dt (m/s).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub velocity: Vector3<T>,
    /// a = dv/dt (m/s²).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
    pub acceleration: Vector3<T>,
}

impl<T: Real> Motion<T> {
    /// No motion at the origin.
    #[must_use]
    pub fn at_rest() -> Self {
        Self { position: Vector3::zeros(), velocity: Vector3::zeros(), acceleration: Vector3::zeros() }
    }

    /// The motion along a path x(t) at the time `t`, by exact derivatives.
    pub fn along(path: impl Fn(Jet<T, 0>) -> Vector3<Jet<T, 0>>, t: T) -> Self {
        Self::from_jet(&path(Jet::time(t)))
    }

    /// Value, rate and second rate of a position that was computed over jets.
    #[must_use]
    pub fn from_jet<const N: usize>(position: &Vector3<Jet<T, N>>) -> Self {
        Self {
            position: position.map(|x| x.value),
            velocity: position.map(|x| x.rate),
            acceleration: position.map(|x| x.second_rate),
        }
    }
}

/// A moving frame: an origin and a basis, both with two derivatives, in space components.
///
/// The basis need not be orthonormal. For a rigid frame use [`MovingFrame::rigid`].
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::particle::{Motion, MovingFrame};
/// // At rest 2 m from the axis of a table that turns with 3 rad/s: a = −ω² x.
/// let basis = [Vector3::x(), Vector3::y(), Vector3::z()];
/// let table = MovingFrame::rigid(Motion::at_rest(), basis, &Vector3::new(0.0, 0.0, 3.0), &Vector3::zeros());
/// let mut in_frame = Motion::at_rest();
/// in_frame.position.x = 2.0;
/// assert_eq!(table.motion_in_space(&in_frame).acceleration, Vector3::new(-18.0, 0.0, 0.0));
/// ```
///
/// # Source
/// W(1.9).
#[doc(alias("rotating frame", "non-inertial frame"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingFrame<T: Real> {
    /// o, v°, a°.
    pub origin: Motion<T>,
    /// `e_i`.
    pub basis: [Vector3<T>; 3],
    /// `ė_i`.
    pub basis_rate: [Vector3<T>; 3],
    /// `ë_i`.
    pub basis_second_rate: [Vector3<T>; 3],
}

/// The terms of the acceleration in a moving frame, in space components (m/s²).
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::particle::{Motion, MovingFrame};
/// let basis = [Vector3::x(), Vector3::y(), Vector3::z()];
/// let table = MovingFrame::rigid(Motion::at_rest(), basis, &Vector3::new(0.0, 0.0, 3.0), &Vector3::zeros());
/// let mut walker = Motion::at_rest();
/// walker.velocity.x = 1.0;
/// assert_eq!(table.acceleration_terms(&walker).coriolis, Vector3::new(0.0, 6.0, 0.0)); // 2 ω×v
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccelerationTerms<T: Real> {
    /// a°, of the frame's origin.
    pub origin: Vector3<T>,
    /// ẍⁱ `e_i`, as seen in the frame.
    pub relative: Vector3<T>,
    /// 2 ẋⁱ `ė_i`.
    pub coriolis: Vector3<T>,
    /// xⁱ `ë_i`: for a rigid frame ω̇×x + ω×(ω×x).
    pub transport: Vector3<T>,
}

impl<T: Real> AccelerationTerms<T> {
    /// The acceleration in space: the sum of all terms.
    #[must_use]
    pub fn total(&self) -> Vector3<T> {
        self.origin + self.relative + self.coriolis + self.transport
    }
}

impl<T: Real> MovingFrame<T> {
    /// A frame that turns rigidly with angular velocity ω and angular acceleration ω̇, both in space
    /// components (rad/s, rad/s²).
    ///
    /// ```text
    /// ė_i = ω×e_i        ë_i = ω̇×e_i + ω×(ω×e_i)
    /// ```
    ///
    /// # Source
    /// W(1.9), W(2.13).
    #[must_use]
    pub fn rigid(
        origin: Motion<T>,
        basis: [Vector3<T>; 3],
        angular_velocity: &Vector3<T>,
        angular_acceleration: &Vector3<T>,
    ) -> Self {
        let basis_rate = basis.map(|e| cross(angular_velocity, &e));
        let towards_axis = basis_rate.map(|rate| cross(angular_velocity, &rate));
        let basis_second_rate = core::array::from_fn(|i| cross(angular_acceleration, &basis[i]) + towards_axis[i]);
        Self { origin, basis, basis_rate, basis_second_rate }
    }

    /// A frame from its origin and basis computed over jets of time.
    #[must_use]
    pub fn from_jets<const N: usize>(origin: &Vector3<Jet<T, N>>, basis: &[Vector3<Jet<T, N>>; 3]) -> Self {
        Self {
            origin: Motion::from_jet(origin),
            basis: basis.map(|e| e.map(|x| x.value)),
            basis_rate: basis.map(|e| e.map(|x| x.rate)),
            basis_second_rate: basis.map(|e| e.map(|x| x.second_rate)),
        }
    }

    /// The motion in space of a particle whose coordinates xⁱ(t) in this frame are given.
    ///
    /// # Source
    /// W(1.9).
    #[must_use]
    pub fn motion_in_space(&self, in_frame: &Motion<T>) -> Motion<T> {
        let (x, rate) = (&in_frame.position, &in_frame.velocity);
        Motion {
            position: self.origin.position + combine(&self.basis, x),
            velocity: self.origin.velocity + combine(&self.basis, rate) + combine(&self.basis_rate, x),
            acceleration: self.acceleration_terms(in_frame).total(),
        }
    }

    /// The acceleration in space, term by term.
    ///
    /// # Source
    /// W(1.9).
    #[must_use]
    pub fn acceleration_terms(&self, in_frame: &Motion<T>) -> AccelerationTerms<T> {
        AccelerationTerms {
            origin: self.origin.acceleration,
            relative: combine(&self.basis, &in_frame.acceleration),
            coriolis: scaled(&combine(&self.basis_rate, &in_frame.velocity), T::lit(2.0)),
            transport: combine(&self.basis_second_rate, &in_frame.position),
        }
    }
}

/// xⁱ `e_i`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn combine<T: Real>(basis: &[Vector3<T>; 3], x: &Vector3<T>) -> Vector3<T> {
    scaled(&basis[0], x.x) + scaled(&basis[1], x.y) + scaled(&basis[2], x.z)
}

/// Momentum l = m v (kg m/s).
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::particle;
/// let (mass, r, v, a) = (2.0, Vector3::<f64>::x(), Vector3::new(0.0, 3.0, 0.0), Vector3::new(0.0, 5.0, 0.0));
/// assert_eq!(particle::momentum(mass, &v).y, 6.0);
/// assert_eq!(particle::angular_momentum(mass, &r, &v).z, 6.0);
/// assert_eq!(particle::kinetic_energy(mass, &v), 9.0);
/// assert_eq!(particle::momentum_rate(mass, &a).y, 10.0);
/// assert_eq!(particle::angular_momentum_rate(mass, &r, &a).z, 10.0);
/// assert_eq!(particle::kinetic_energy_rate(mass, &v, &a), 30.0);
/// ```
///
/// # Source
/// W(1.13).
#[doc(alias = "linear momentum")]
#[inline]
#[must_use]
pub fn momentum<T: Real>(mass: f64, velocity: &Vector3<T>) -> Vector3<T> {
    scaled(velocity, T::lit(mass))
}

/// Angular momentum h = r × m v about the point from which r is drawn (kg m²/s).
///
/// # Source
/// W(1.13).
#[doc(alias = "moment of momentum")]
#[inline]
#[must_use]
pub fn angular_momentum<T: Real>(mass: f64, r: &Vector3<T>, velocity: &Vector3<T>) -> Vector3<T> {
    cross(r, &momentum(mass, velocity))
}

/// Kinetic energy e = ½ m v·v (J).
///
/// # Source
/// W(1.13).
#[inline]
#[must_use]
pub fn kinetic_energy<T: Real>(mass: f64, velocity: &Vector3<T>) -> T {
    T::lit(0.5 * mass) * dot(velocity, velocity)
}

/// Rate of momentum dl/dt = m a (N).
///
/// # Source
/// W(1.14).
#[inline]
#[must_use]
pub fn momentum_rate<T: Real>(mass: f64, acceleration: &Vector3<T>) -> Vector3<T> {
    scaled(acceleration, T::lit(mass))
}

/// Rate of angular momentum about a fixed point, dh/dt = r × m a (N m).
///
/// # Source
/// W(1.14).
#[doc(alias("torque", "moment of force"))]
#[inline]
#[must_use]
pub fn angular_momentum_rate<T: Real>(mass: f64, r: &Vector3<T>, acceleration: &Vector3<T>) -> Vector3<T> {
    cross(r, &momentum_rate(mass, acceleration))
}

/// Rate of kinetic energy de/dt = m v·a (W).
///
/// # Source
/// W(1.14).
#[doc(alias = "power")]
#[inline]
#[must_use]
pub fn kinetic_energy_rate<T: Real>(mass: f64, velocity: &Vector3<T>, acceleration: &Vector3<T>) -> T {
    T::lit(mass) * dot(velocity, acceleration)
}
