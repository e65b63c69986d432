//! What goes wrong silently elsewhere: each case is answered by name.

use nalgebra::Vector3;
use piola_integrators::Tolerance;
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::{Forces, Holonomic, Lagrangian, LagrangianError, LagrangianFunction, Placement, Workspace};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

use crate::systems::*;

fn refusal<T: core::fmt::Debug>(result: Result<T, LagrangianError>) -> LagrangianError {
    result.expect_err("this must be refused")
}

#[test]
fn pole_of_eulerian_angles_is_named_with_its_null_direction() {
    let top = Lagrangian::of(HeavyTop::new(1.0, 0.5, 1.0, 0.25)).with_gravity(9.8);
    for angle in [0.0, core::f64::consts::PI] {
        let error = refusal(top.acceleration(&[0.3, angle, 0.2], &[1.0, 0.5, 2.0], 0.0));
        let LagrangianError::SingularMetric { coordinate, direction, .. } = error else { panic!("{error}") };
        assert_eq!(coordinate, 2);
        // θ¹ and θ³ turn about one axis: precession and spin undo each other.
        assert_close("θ̇", &direction, &[-angle.cos(), 0.0, 1.0], Tol::ulps(4.0));
    }
}

/// A particle on a line with two coordinates for one place.
struct Dependent(usize);
impl Holonomic for Dependent {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        for &x in &q[..self.0] {
            bodies.particle(1.0, Vector3::new(x, T::zero(), T::zero()));
        }
        let last = q[self.0] - T::lit(0.5) * q[self.0 + 1];
        bodies.particle(2.0, Vector3::new(last, T::zero(), T::zero()));
    }
}

#[test]
fn dependent_coordinates_are_named() {
    for n in [0, 1, 6, 7, 20] {
        let lagrangian = Lagrangian::of(Dependent(n));
        let error = refusal(lagrangian.acceleration(&vec![0.1; n + 2], &vec![0.0; n + 2], 0.0));
        let LagrangianError::SingularMetric { coordinate, direction, .. } = error else { panic!("{error}") };
        assert_eq!(coordinate, n + 1);
        let mut expected = vec![0.0; n + 2];
        (expected[n], expected[n + 1]) = (0.5, 1.0);
        assert_close("q̇", &direction, &expected, Tol::ulps(4.0));
        let mut velocity = vec![0.0; n + 2];
        let inverted = lagrangian.velocities_into(
            &mut Workspace::default(),
            &vec![0.1; n + 2],
            &vec![0.0; n + 2],
            0.0,
            &mut velocity,
        );
        assert!(matches!(refusal(inverted), LagrangianError::SingularMetric { .. }));
    }
}

#[test]
fn coordinate_that_moves_nothing_is_named() {
    let forgotten = Lagrangian::of(Chain { links: 2 }); // of three coordinates
    let error = refusal(forgotten.acceleration(&[0.1; 3], &[0.0; 3], 0.0));
    assert!(matches!(error, LagrangianError::SingularMetric { coordinate: 2, .. }), "{error}");
}

#[test]
fn singular_hessian_of_a_lagrangian_is_named() {
    struct Linear; // L = q₁ q̇₂ + ½ q̇₁²
    impl LagrangianFunction for Linear {
        fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
            q[0] * v[1] + T::lit(0.5) * v[0] * v[0]
        }
    }
    let error = refusal(Lagrangian::from_function(Linear).acceleration(&[1.0, 0.0], &[0.0, 1.0], 0.0));
    let LagrangianError::SingularMetric { coordinate: 1, direction, .. } = error else { panic!("{error}") };
    assert_close("q̇", &direction, &[0.0, 1.0], Tol::ulps(0.0));
}

struct Bad;
impl Forces for Bad {
    const GENERALISED: bool = true;
    fn generalised<T: Real>(&self, _q: &[T], _v: &[T], _t: T, q_out: &mut [T]) {
        q_out[0] += T::lit(f64::NAN);
    }
}

#[test]
fn non_finite_input_is_refused_by_name() {
    let pendulum = Lagrangian::of(DoublePendulum { mass: [1.0; 2], length: [1.0; 2] }).with_gravity(9.8);
    let named = |error: LagrangianError| {
        let LagrangianError::NotFinite { quantity, index, .. } = error else { panic!("{error}") };
        (quantity, index)
    };
    let nan = f64::NAN;
    assert_eq!(named(refusal(pendulum.acceleration(&[0.0, nan], &[0.0; 2], 0.0))), ("q", 1));
    assert_eq!(named(refusal(pendulum.acceleration(&[0.0; 2], &[f64::INFINITY, 0.0], 0.0))), ("q̇", 0));
    let weightless = pendulum.clone_with_gravity(nan);
    assert_eq!(named(refusal(weightless.acceleration(&[0.0; 2], &[0.0; 2], 0.0))), ("gravity", 1));
    let bead = BeadOnHoop { mass: 1.0, radius: 1.0, rate: 1.0, wobble: 0.0, frequency: 1.0 };
    assert_eq!(named(refusal(Lagrangian::of(bead).acceleration(&[0.5], &[0.0], nan))), ("t", 0));
    let mut velocity = [0.0; 2];
    let inverted = pendulum.velocities_into(&mut Workspace::default(), &[0.0; 2], &[nan, 0.0], 0.0, &mut velocity);
    assert_eq!(named(refusal(inverted)), ("p", 0));
    let long = Lagrangian::of(Chain { links: 12 });
    assert_eq!(named(refusal(long.acceleration(&[0.1; 12], &[nan; 12], 0.0))), ("q̇", 0));

    let pushed = pendulum.with_forces(Bad);
    assert_eq!(named(refusal(pushed.acceleration(&[0.0; 2], &[0.0; 2], 0.0))), ("q̈", 0));
}

trait WithGravity {
    fn clone_with_gravity(&self, strength: f64) -> Self;
}
impl WithGravity for Lagrangian<DoublePendulum> {
    fn clone_with_gravity(&self, strength: f64) -> Self {
        let system = DoublePendulum { mass: self.system().mass, length: self.system().length };
        Self::of(system).with_uniform_gravity([0.0, strength, 0.0])
    }
}

#[test]
fn lengths_that_differ_are_refused_by_name() {
    let pendulum = Lagrangian::of(DoublePendulum { mass: [1.0; 2], length: [1.0; 2] });
    let named = |error: LagrangianError| {
        let LagrangianError::WrongLength { quantity, expected, found } = error else { panic!("{error}") };
        (quantity, expected, found)
    };
    assert_eq!(named(refusal(pendulum.acceleration(&[0.0; 2], &[0.0; 3], 0.0))), ("q̇", 2, 3));
    let mut out = [0.0; 1];
    let mut work = Workspace::default();
    assert_eq!(named(refusal(pendulum.acceleration_into(&mut work, &[0.0; 2], &[0.0; 2], 0.0, &mut out))), ("q̈", 2, 1));
}

struct Stretched(RigidBody);
impl Holonomic for Stretched {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let turned = Attitude::about_z(q[0]);
        let attitude = Attitude { w: turned.w + turned.w, ..turned };
        bodies.body(&self.0, Vector3::new(T::zero(), T::zero(), T::zero()), attitude);
    }
}

#[test]
fn masses_and_places_are_checked_before_a_run() {
    let check = |mass: [f64; 2], length: f64| {
        Lagrangian::of(DoublePendulum { mass, length: [1.0, length] }).check(&[0.1; 2], &[0.0; 2], 0.0)
    };
    assert_eq!(refusal(check([1.0, -2.0], 1.0)), LagrangianError::InvalidMass { part: 1, mass: -2.0 });
    assert!(matches!(refusal(check([f64::NAN, 2.0], 1.0)), LagrangianError::InvalidMass { part: 0, .. }));
    assert_eq!(refusal(check([1.0, 2.0], f64::NAN)), LagrangianError::PartNowhere { part: 1 });
    // An evaluation that fails says the same.
    let sick = Lagrangian::of(DoublePendulum { mass: [1.0, -2.0], length: [1.0; 2] });
    let error = refusal(sick.acceleration(&[0.1, 1.5], &[0.0; 2], 0.0));
    assert_eq!(error, LagrangianError::InvalidMass { part: 1, mass: -2.0 });

    let body = RigidBody::new(1.0, Inertia::principal([1.0, 1.0, 1.0]).unwrap()).unwrap();
    let error = refusal(Lagrangian::of(Stretched(body)).check(&[0.0], &[0.0], 0.0));
    assert_eq!(error, LagrangianError::AttitudeNotUnit { part: 0, squared_length: 4.0 });
}

#[test]
fn momenta_without_velocities_are_refused() {
    struct Saturating; // p = v/√(1 + v²) stays below one
    impl LagrangianFunction for Saturating {
        fn lagrangian<T: Real>(&self, _q: &[T], v: &[T], _t: T) -> T {
            let speed = (T::one() + v[0] * v[0]).sqrt();
            speed - T::one()
        }
    }
    let lagrangian = Lagrangian::from_function(Saturating);
    let mut velocity = [0.0];
    let invert = |p: f64, velocity: &mut [f64]| {
        lagrangian.velocities_into(&mut Workspace::default(), &[0.0], &[p], 0.0, velocity)
    };
    invert(0.6, &mut velocity).unwrap();
    assert_close("v", &velocity, &[0.75], Tol::ulps(8.0)); // v/√(1 + v²) = 0.6
    let error = refusal(invert(1.5, &mut velocity));
    assert!(
        matches!(error, LagrangianError::LegendreNotConverged { .. } | LagrangianError::SingularMetric { .. }),
        "{error}"
    );
}

#[test]
fn mass_ratio_of_a_million_millions_keeps_its_digits() {
    // A heavy pendulum with a speck below it.
    let (m, l, g) = ([1.0, 1e-12], [1.0, 0.5], 9.8125);
    let pendulum = Lagrangian::of(DoublePendulum { mass: m, length: l }).with_uniform_gravity([0.0, -g, 0.0]);
    let (q, v) = ([0.5, -0.75], [1.0, 2.0]);
    let a = pendulum.acceleration(&q, &v, 0.0).unwrap();
    // The textbook's explicit form.
    let (s, c) = (q[0] - q[1]).sin_cos();
    let denominator = m[0] + m[1] * s * s;
    let total = m[0] + m[1];
    let first = (-m[1] * c * (l[0] * v[0] * v[0] * s - g * q[1].sin())
        - m[1] * l[1] * v[1] * v[1] * s
        - total * g * q[0].sin())
        / (denominator * l[0]);
    let second = (l[0] * v[0] * v[0] * s - g * q[1].sin() - l[0] * first * c) / l[1];
    assert_close("q̈", a.as_slice(), &[first, second], Tol::ulps(32.0));
}

#[test]
fn runs_start_from_rest_and_from_equilibrium() {
    let pendulum =
        Lagrangian::of(DoublePendulum { mass: [1.0; 2], length: [1.0; 2] }).with_uniform_gravity([0.0, -9.8, 0.0]);
    let run = pendulum.integrate(&[0.0; 2], &[0.0; 2], 0.0..10.0, Tolerance::relative(1e-10).unwrap()).unwrap();
    assert_eq!(run.last(), (&[0.0; 2][..], &[0.0; 2][..]));
    assert!(run.energy_drift() <= 0.0);
    let run = pendulum.integrate(&[1.0, 0.0], &[0.0; 2], 0.0..1.0, Tolerance::relative(1e-10).unwrap()).unwrap();
    // Ten times the tolerance of the steps.
    assert!(run.energy_drift() < 1e-9, "{:e}", run.energy_drift());
}
