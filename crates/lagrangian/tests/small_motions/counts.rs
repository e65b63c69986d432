//! What a system does not have is not asked for.

use core::cell::Cell;

use nalgebra::Vector3;
use piola_kinematics::Attitude;
use piola_lagrangian::LagrangianError;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement, Potential, Workspace};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

/// A particle in the plane.
struct Plane;

impl Holonomic for Plane {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(2.0, Vector3::new(q[0], q[1], T::zero()));
    }
}

/// The potential −e A·v of a uniform magnetic field across the plane, that counts its calls.
struct Magnetic<const LINEAR: bool> {
    strength: f64,
    quadratic: f64,
    calls: Cell<usize>,
}

impl<const LINEAR: bool> Magnetic<LINEAR> {
    fn new(strength: f64, quadratic: f64) -> Self {
        Self { strength, quadratic, calls: Cell::new(0) }
    }
}

impl<const LINEAR: bool> Potential for Magnetic<LINEAR> {
    const VELOCITY_DEPENDENT: bool = true;
    const LINEAR_IN_VELOCITIES: bool = LINEAR;
    fn potential<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        self.calls.set(self.calls.get() + 1);
        let magnetic = T::lit(0.5 * self.strength) * (q[0] * v[1] - q[1] * v[0]);
        magnetic + T::lit(self.quadratic) * v[0] * v[0]
    }
}

/// Forces that nobody may ask for.
struct Forbidden;

impl Forces for Forbidden {
    fn generalised<T: Real>(&self, _q: &[T], _v: &[T], _t: T, _q_out: &mut [T]) {
        unreachable!("absent generalised forces were asked for")
    }
    fn on_part<T: Real>(&self, _part: usize, _x: [T; 3], _v: [T; 3], _t: T) -> [T; 3] {
        unreachable!("absent forces on parts were asked for")
    }
    fn moment_on_body<T: Real>(&self, _part: usize, _a: Attitude<T>, _w: [T; 3], _t: T) -> [T; 3] {
        unreachable!("absent moments were asked for")
    }
}

/// Moments that nobody may ask for where there are no bodies.
struct Moments;

impl Forces for Moments {
    const MOMENTS: bool = true;
    fn moment_on_body<T: Real>(&self, _part: usize, _a: Attitude<T>, _w: [T; 3], _t: T) -> [T; 3] {
        unreachable!("there is no body")
    }
}

const STATE: ([f64; 2], [f64; 2]) = ([0.5, -1.0], [3.0, 2.0]);

#[test]
fn absent_forces_and_moments_are_never_asked_for() {
    let (q, v) = STATE;
    let without = Lagrangian::of(Plane).with_forces(Forbidden);
    without.acceleration(&q, &v, 0.0).unwrap();
    without.generalised_forces(&q, &v, 0.0).unwrap();
    without.linearise(&q, &v, 0.0).unwrap();
    Lagrangian::of(Plane).with_forces(Moments).acceleration(&q, &v, 0.0).unwrap();
}

#[test]
fn potential_declared_linear_in_velocities_is_evaluated_once() {
    let (q, v) = STATE;
    // m ẍ = e ẏ B and back: the gradient and the rate of the momentum in one pass, no second derivatives.
    let linear = Lagrangian::of(Plane).with_potential(Magnetic::<true>::new(4.0, 0.0));
    let found = linear.acceleration(&q, &v, 0.0).unwrap();
    assert_eq!(linear.potential().calls.get(), 1);
    let undeclared = Lagrangian::of(Plane).with_potential(Magnetic::<false>::new(4.0, 0.0));
    assert_eq!(undeclared.acceleration(&q, &v, 0.0).unwrap(), found);
    assert_eq!(undeclared.potential().calls.get(), 2);
    assert_close("q̈", found.as_slice(), &[-4.0, 6.0], Tol::ulps(4.0));
}

#[test]
fn linear_potential_returns_velocities_from_momenta_without_iteration() {
    let (q, v) = STATE;
    let linear = Lagrangian::of(Plane).with_potential(Magnetic::<true>::new(4.0, 0.0));
    let p = linear.momenta(&q, &v, 0.0).unwrap();
    let calls = linear.potential().calls.get();
    let mut found = [0.0; 2];
    linear.velocities_into(&mut Workspace::default(), &q, p.as_slice(), 0.0, &mut found).unwrap();
    assert_close("q̇", &found, &v, Tol::ulps(8.0));
    assert_eq!(linear.potential().calls.get() - calls, 1);
}

#[test]
fn potential_that_is_not_linear_as_declared_is_found_out() {
    let (q, v) = STATE;
    let wrong = Lagrangian::of(Plane).with_potential(Magnetic::<true>::new(4.0, 0.25));
    assert_eq!(wrong.check(&q, &v, 0.0), Err(LagrangianError::NonlinearPotential));
    assert_eq!(Lagrangian::of(Plane).with_potential(Magnetic::<true>::new(4.0, 0.0)).check(&q, &v, 0.0), Ok(()));
    assert_eq!(Lagrangian::of(Plane).with_potential(Magnetic::<false>::new(4.0, 0.25)).check(&q, &v, 0.0), Ok(()));
}
