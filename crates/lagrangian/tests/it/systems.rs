//! The systems of the reference data, each as a placement map with what acts on it.
//!
//! Benches share this file: in them, as wherever speed matters, placements are inlined.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::{Holonomic, Placement, Potential};
use piola_numerics::Real;

fn point<T: Real>(x: T, y: T, z: T) -> Vector3<T> {
    Vector3::new(x, y, z)
}

/// Two pendulums in the plane x–y (y up), angles from the downward vertical.
pub(crate) struct DoublePendulum {
    pub(crate) mass: [f64; 2],
    pub(crate) length: [f64; 2],
}

impl Holonomic for DoublePendulum {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut end = point(T::zero(), T::zero(), T::zero());
        for ((angle, mass), length) in q.iter().zip(self.mass).zip(self.length) {
            let (s, c) = angle.sin_cos();
            let length = T::lit(length);
            end += point(length * s, -length * c, T::zero());
            bodies.particle(mass, end);
        }
    }
}

/// θ from the downward vertical (−z), azimuth φ.
pub(crate) struct SphericalPendulum {
    pub(crate) mass: f64,
    pub(crate) length: f64,
}

impl Holonomic for SphericalPendulum {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let ((s, c), (sp, cp)) = (q[0].sin_cos(), q[1].sin_cos());
        let l = T::lit(self.length);
        bodies.particle(self.mass, point(l * s * cp, l * s * sp, -l * c));
    }
}

pub(crate) struct CartPole {
    pub(crate) cart: f64,
    pub(crate) mass: f64,
    pub(crate) length: f64,
}

impl Holonomic for CartPole {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (s, c) = q[1].sin_cos();
        let l = T::lit(self.length);
        bodies.particle(self.cart, point(q[0], T::zero(), T::zero()));
        bodies.particle(self.mass, point(q[0] + l * s, l * c, T::zero()));
    }
}

/// A bead on a hoop that is turned about its vertical diameter by φ(t) = Ωt + ε sin νt.
pub(crate) struct BeadOnHoop {
    pub(crate) mass: f64,
    pub(crate) radius: f64,
    pub(crate) rate: f64,
    pub(crate) wobble: f64,
    pub(crate) frequency: f64,
}

impl Holonomic for BeadOnHoop {
    const TIME_DEPENDENT: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        let turn = T::lit(self.rate) * t + T::lit(self.wobble) * (T::lit(self.frequency) * t).sin();
        let ((s, c), (sp, cp)) = (q[0].sin_cos(), turn.sin_cos());
        let r = T::lit(self.radius);
        bodies.particle(self.mass, point(r * s * cp, r * s * sp, -r * c));
    }
}

/// A symmetric top with a fixed point, z–y–z angles.
pub(crate) struct HeavyTop {
    body: RigidBody,
    height: f64,
}

impl HeavyTop {
    /// `transverse` is the moment about the fixed point.
    pub(crate) fn new(mass: f64, height: f64, transverse: f64, axial: f64) -> Self {
        let central = transverse - mass * height * height;
        let inertia = Inertia::principal([central, central, axial]).expect("a possible inertia");
        Self { body: RigidBody::new(mass, inertia).expect("a possible body"), height }
    }
}

impl Holonomic for HeavyTop {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let attitude = Attitude::from_euler_zyz([q[0], q[1], q[2]]);
        let centre = attitude.to_space(&point(T::zero(), T::zero(), T::lit(self.height)));
        bodies.body(&self.body, centre, attitude);
    }
}

/// A particle in plane polar coordinates, θ from the downward vertical.
pub(crate) struct ElasticPendulum {
    pub(crate) mass: f64,
}

impl Holonomic for ElasticPendulum {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (s, c) = q[1].sin_cos();
        bodies.particle(self.mass, point(q[0] * s, T::zero(), -q[0] * c));
    }
}

/// V = k (r − l₀)²/2.
pub(crate) struct RadialSpring {
    pub(crate) stiffness: f64,
    pub(crate) rest: f64,
}

impl Potential for RadialSpring {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        let stretch = q[0] - T::lit(self.rest);
        T::lit(0.5 * self.stiffness) * stretch * stretch
    }
}

pub(crate) struct Torus {
    pub(crate) mass: f64,
    pub(crate) large: f64,
    pub(crate) small: f64,
}

impl Holonomic for Torus {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let ((su, cu), (sv, cv)) = (q[0].sin_cos(), q[1].sin_cos());
        let (large, small) = (T::lit(self.large), T::lit(self.small));
        let r = large + small * cv;
        bodies.particle(self.mass, point(r * cu, r * su, small * sv));
    }
}

/// A particle in cylindrical coordinates.
pub(crate) struct Cylindrical {
    pub(crate) mass: f64,
}

impl Holonomic for Cylindrical {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let (s, c) = q[1].sin_cos();
        bodies.particle(self.mass, point(q[0] * c, q[0] * s, q[2]));
    }
}

/// V = −e E·x − e A·v with A = ½ B × x, for the cylindrical particle.
pub(crate) struct Lorentz {
    pub(crate) charge: f64,
    pub(crate) electric: [f64; 3],
    pub(crate) magnetic: [f64; 3],
}

impl Potential for Lorentz {
    const VELOCITY_DEPENDENT: bool = true;
    const LINEAR_IN_VELOCITIES: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn potential<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        let (s, c) = q[1].sin_cos();
        let x = [q[0] * c, q[0] * s, q[2]];
        let velocity = [v[0] * c - q[0] * v[1] * s, v[0] * s + q[0] * v[1] * c, v[2]];
        let b = self.magnetic.map(T::lit);
        let half = T::lit(0.5);
        let a = [
            half * (b[1] * x[2] - b[2] * x[1]),
            half * (b[2] * x[0] - b[0] * x[2]),
            half * (b[0] * x[1] - b[1] * x[0]),
        ];
        let mut sum = T::zero();
        for k in 0..3 {
            sum += T::lit(self.electric[k]) * x[k] + a[k] * velocity[k];
        }
        -T::lit(self.charge) * sum
    }
}

/// A pendulum on the turning earth: x east, y north, z up; the frame turns with Ω(0, cos λ, sin λ).
#[derive(Clone, Copy)]
pub(crate) struct Foucault {
    pub(crate) mass: f64,
    pub(crate) length: f64,
    pub(crate) rate: f64,
    pub(crate) latitude: f64,
}

impl Foucault {
    fn height<T: Real>(&self, q: &[T]) -> T {
        -(T::lit(self.length * self.length) - q[0] * q[0] - q[1] * q[1]).sqrt()
    }
}

impl Holonomic for Foucault {
    const TIME_DEPENDENT: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        let (s, c) = self.latitude.sin_cos();
        let (sine, cosine) = (T::lit(0.5 * self.rate) * t).sin_cos();
        let turn = Attitude { w: cosine, x: T::zero(), y: T::lit(c) * sine, z: T::lit(s) * sine };
        bodies.particle(self.mass, turn.to_space(&point(q[0], q[1], self.height(q))));
    }
}

/// V = m g z in the turning frame.
pub(crate) struct Height<'a> {
    pub(crate) pendulum: &'a Foucault,
    pub(crate) gravity: f64,
}

impl Potential for Height<'_> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        T::lit(self.pendulum.mass * self.gravity) * self.pendulum.height(q)
    }
}

/// Two bodies in the plane joined by a hinge; q = [x, y, φ₁, φ₂].
pub(crate) struct HingedBodies {
    bodies: [RigidBody; 2],
    arms: [f64; 2],
}

impl HingedBodies {
    pub(crate) fn new(masses: [f64; 2], moments: [f64; 2], arms: [f64; 2]) -> Self {
        let body = |i: usize| {
            // Only the moment about z matters in the plane; the others are possible ones.
            let inertia = Inertia::principal([0.75 * moments[i], 0.75 * moments[i], moments[i]]).expect("possible");
            RigidBody::new(masses[i], inertia).expect("possible")
        };
        Self { bodies: [body(0), body(1)], arms }
    }
}

impl Holonomic for HingedBodies {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let first = point(q[0], q[1], T::zero());
        let arm = |i: usize| {
            let (s, c) = q[2 + i].sin_cos();
            let a = T::lit(self.arms[i]);
            point(a * c, a * s, T::zero())
        };
        bodies.body(&self.bodies[0], first, Attitude::about_z(q[2]));
        bodies.body(&self.bodies[1], first + arm(0) + arm(1), Attitude::about_z(q[3]));
    }
}

/// V = k (φ₂ − φ₁)²/2.
pub(crate) struct Torsion {
    pub(crate) stiffness: f64,
}

impl Potential for Torsion {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        let turn = q[3] - q[2];
        T::lit(0.5 * self.stiffness) * turn * turn
    }
}

/// A chain of `n` equal pendulums.
pub(crate) struct Chain {
    pub(crate) links: usize,
}

impl Holonomic for Chain {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut end = point(T::zero(), T::zero(), T::zero());
        for angle in q.iter().take(self.links) {
            let (s, c) = angle.sin_cos();
            end += point(s, T::zero(), -c);
            bodies.particle(1.0, end);
        }
    }
}

/// A body that moves freely: position and z–y–z angles.
pub(crate) struct FreeBody {
    pub(crate) body: RigidBody,
}

impl FreeBody {
    pub(crate) fn new(mass: f64, inertia: Matrix3<f64>) -> Self {
        let inertia = Inertia::new(inertia).expect("a possible inertia");
        Self { body: RigidBody::new(mass, inertia).expect("a possible body") }
    }
}

impl Holonomic for FreeBody {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.body(&self.body, point(q[0], q[1], q[2]), Attitude::from_euler_zyz([q[3], q[4], q[5]]));
    }
}

/// An inertia tensor without symmetry.
pub(crate) fn uneven_inertia() -> Matrix3<f64> {
    Matrix3::new(2.0, 0.25, -0.125, 0.25, 1.5, 0.0625, -0.125, 0.0625, 1.75)
}
