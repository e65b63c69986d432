//! One test for each trap: what is refused is refused by name.

use nalgebra::Vector3;
use piola_integrators::Tolerance;
use piola_kinematics::{EulerAngles, Inertia, KinematicsError, RigidBody};
use piola_lagrangian::LagrangianError;
use piola_lagrangian::newton_euler::{NewtonEuler, particle_acceleration, principal_angular_acceleration};
use piola_lagrangian::{
    ChangeOfCoordinates, ConstraintVerdict, Forces, Holonomic, Lagrangian, PartForce, PartPower, Path, Placement,
    Potential, Reaction, SampledMotion, Workspace,
};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

use crate::systems::*;

fn refusal<T: core::fmt::Debug>(result: Result<T, LagrangianError>) -> LagrangianError {
    result.expect_err("refused")
}

#[test]
fn buffers_of_the_wrong_length_are_refused_by_name() {
    let system = driven();
    let (q, v) = ([0.0; 3], [0.0; 3]);
    let mut work = Workspace::default();
    let mut two = [Reaction::none(); 2];
    let wrong = |quantity, expected, found| LagrangianError::WrongLength { quantity, expected, found };
    let refused = refusal(system.reactions_into(&mut work, &q, &v, 0.0, &mut two));
    assert_eq!(refused, wrong("reactions", 3, 2));
    let refused = refusal(system.virtual_work(&[PartForce::force([0.0; 3]); 4], &q, 0.0));
    assert_eq!(refused, wrong("forces", 3, 4));
    let (mut parts, mut coordinates) = ([PartPower::default(); 1], [0.0; 3]);
    let refused = refusal(system.actuator_powers_into(&mut work, &q, &v, 0.0, &mut parts, &mut coordinates));
    assert_eq!(refused, wrong("powers of the parts", 3, 1));
    assert_eq!(refusal(system.driving_forces(&q, &v, &[0.0; 2], 0.0)), wrong("q̈", 3, 2));
    assert_eq!(refusal(system.raise(&q, &[1.0], 0.0)), wrong("covector", 3, 1));
    assert_eq!(refusal(system.force_along_time(&q, &v[..2], 0.0)), wrong("q̇", 3, 2));
}

#[test]
fn non_finite_input_is_refused_by_name() {
    let system = driven();
    let q = [0.0; 3];
    let found = refusal(system.reactions(&q, &[0.0, f64::NAN, 0.0], 0.0));
    assert!(matches!(found, LagrangianError::NotFinite { quantity: "q̇", index: 1, .. }), "{found}");
    let found = refusal(system.power_balance(&q, &q, f64::INFINITY));
    assert!(matches!(found, LagrangianError::NotFinite { quantity: "t", index: 0, .. }), "{found}");
    let mut out = [Reaction::none(); 3];
    let given = (&q[..], &q[..], &[0.0, 0.0, f64::NAN][..]);
    let found = refusal(system.reactions_at_acceleration_into(
        &mut Workspace::default(),
        given.0,
        given.1,
        given.2,
        0.0,
        &mut out,
    ));
    assert!(matches!(found, LagrangianError::NotFinite { quantity: "q̈", index: 2, .. }), "{found}");
    let found = refusal(system.covariant_acceleration(&q, &q, given.2, 0.0));
    assert!(matches!(found, LagrangianError::NotFinite { quantity: "q̈", index: 2, .. }), "{found}");
    let forces = [PartForce::force([0.0, f64::NAN, 0.0]); 3];
    let found = refusal(system.ideal_constraint_test(&forces, &q, 0.0));
    assert!(matches!(found, LagrangianError::NotFinite { .. }), "{found}");
}

#[test]
fn results_that_are_not_finite_are_refused_by_the_name_of_their_cause() {
    let system = driven();
    let named = |error: LagrangianError, name: &str, at: usize| {
        let LagrangianError::NotFinite { quantity, index, .. } = error else { panic!("{error}") };
        assert_eq!((quantity, index), (name, at));
    };
    let (good, bad) = ([0.25; 3], [0.25, f64::NAN, 0.25]);
    let mut work = Workspace::default();
    let (mut parts, mut powers) = ([PartPower::default(); 3], [0.0; 3]);
    for (q, v, t, name, at) in [
        (&bad, &good, 0.0, "q", 1),
        (&good, &[0.25, 0.25, f64::INFINITY], 0.0, "q̇", 2),
        (&good, &good, f64::NAN, "t", 0),
    ] {
        named(refusal(system.energies(q, v, t)), name, at);
        named(refusal(system.momenta(q, v, t)), name, at);
        named(refusal(system.jacobi_integral(q, v, t)), name, at);
        named(refusal(system.coordinate_gradient(q, v, t)), name, at);
        named(refusal(system.time_derivative(q, v, t)), name, at);
        named(refusal(system.generalised_forces(q, v, t)), name, at);
        named(refusal(system.system_momentum(q, v, t, &Vector3::zeros())), name, at);
        named(refusal(system.actuator_powers_into(&mut work, q, v, t, &mut parts, &mut powers)), name, at);
    }
    let force = |x: f64| [PartForce::force([0.0, 0.0, x]); 3];
    named(refusal(system.virtual_work(&force(1.0), &bad, 0.0)), "q", 1);
    named(refusal(system.virtual_work(&force(f64::NAN), &good, 0.0)), "force", 2);
    named(refusal(system.lower(&good, &bad, 0.0)), "vector", 1);
    named(refusal(system.lower(&bad, &good, 0.0)), "q", 1);
    named(refusal(system.system_momentum(&good, &good, 0.0, &Vector3::from(bad))), "about", 1);
    named(refusal(system.driving_forces(&good, &good, &bad, 0.0)), "q̈", 1);
    named(refusal(system.power_balance_at_acceleration(&mut work, &good, &good, &bad, 0.0)), "q̈", 1);
}

/// A weight that cannot move: a system without coordinates.
struct Fixed;
impl Holonomic for Fixed {
    fn place<T: Real>(&self, _q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(2.0, Vector3::from([T::zero(); 3]));
    }
}

#[test]
fn forces_on_a_system_without_coordinates_are_counted() {
    let fixed = Lagrangian::of(Fixed).with_gravity(10.0);
    let two = [PartForce::<f64>::force([1.0; 3]); 2];
    let wrong = LagrangianError::WrongLength { quantity: "forces", expected: 1, found: 2 };
    assert_eq!(refusal(fixed.virtual_work(&two, &[], 0.0)), wrong);
    assert_eq!(refusal(fixed.ideal_constraint_test(&two, &[], 0.0)), wrong);
    assert_eq!(fixed.virtual_work(&two[..1], &[], 0.0).unwrap().len(), 0);
    let held = fixed.reactions(&[], &[], 0.0).unwrap();
    assert_close("reaction", held[0].force().as_slice(), &[0.0, 0.0, 20.0], Tol::ulps(0.0));
}

#[test]
fn tolerance_that_is_no_number_tolerates_nothing() {
    let forces = [PartForce::force([1.0, 0.0, 0.0]); 3];
    let test = driven().ideal_constraint_test(&forces, &[0.25; 3], 0.0).unwrap();
    assert!(matches!(test.verdict(f64::NAN), ConstraintVerdict::Working { .. }));
}

#[test]
fn samples_beyond_the_last_are_none() {
    let refused = refusal(SampledMotion::new(usize::MAX, vec![0.0, 1.0], vec![], vec![]));
    let expected = usize::MAX;
    assert_eq!(refused, LagrangianError::WrongLength { quantity: "coordinates", expected, found: 0 });
    let samples = SampledMotion::new(1, vec![0.0, 1.0], vec![2.0, 3.0], vec![0.0; 2]).unwrap();
    assert_eq!(
        (samples.coordinates(1), samples.velocities(2), samples.coordinates(usize::MAX)),
        (&[3.0][..], &[][..], &[][..])
    );
}

#[test]
fn impossible_moments_of_inertia_are_refused() {
    let (zero, nan) = (Vector3::zeros(), Vector3::new(0.0, f64::NAN, 0.0));
    let found = refusal(principal_angular_acceleration([2.0, 0.0, 1.0], &zero, &zero));
    let expected = KinematicsError::InertiaNotPositiveDefinite { principal_moments: [0.0, 1.0, 2.0] };
    assert_eq!(found, LagrangianError::Kinematics(expected));
    for found in [
        refusal(principal_angular_acceleration([1.0; 3], &nan, &zero)),
        refusal(principal_angular_acceleration([1.0; 3], &zero, &nan)),
        refusal(particle_acceleration(1.0, &nan)),
    ] {
        assert!(matches!(found, LagrangianError::NotFinite { index: 1, .. }), "{found}");
    }
}

/// Forces that are not numbers on the second part.
struct Broken;
impl Forces for Broken {
    const ON_PARTS: bool = true;
    fn on_part<T: Real>(&self, part: usize, _x: [T; 3], _v: [T; 3], _t: T) -> [T; 3] {
        [T::lit(if part == 1 { f64::NAN } else { 0.0 }); 3]
    }
}

#[test]
fn part_with_an_infinite_force_is_named() {
    let system = Lagrangian::of(Arm::<false>::new()).with_forces(Broken);
    let zero: &[f64] = &[0.0; 3];
    let mut out = [Reaction::none(); 3];
    let found =
        refusal(system.reactions_at_acceleration_into(&mut Workspace::default(), zero, zero, zero, 0.0, &mut out));
    assert!(matches!(found, LagrangianError::NotFinite { quantity: "reactions", index: 1, .. }), "{found}");
}

#[test]
fn gimbal_point_of_eulerian_accelerations_is_refused() {
    let body = RigidBody::new(1.0, Inertia::principal([1.0, 2.0, 2.5]).unwrap()).unwrap();
    let laws = NewtonEuler::of(&body).unwrap();
    let at_pole = EulerAngles::zyz([0.5, 0.0, 0.25]);
    let found = refusal(laws.eulerian_accelerations(&at_pole, [1.0; 3], &Vector3::zeros()));
    assert!(matches!(found, LagrangianError::Kinematics(KinematicsError::GimbalPoint { .. })), "{found}");
}

#[test]
fn particles_without_mass_have_no_acceleration() {
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = refusal(particle_acceleration(mass, &Vector3::new(1.0, 0.0, 0.0)));
        assert!(matches!(found, LagrangianError::InvalidMass { part: 0, .. }), "{found}");
    }
}

#[test]
fn geodesic_without_direction_is_refused() {
    let tolerance = Tolerance::relative(1e-10).unwrap();
    let found = refusal(Lagrangian::of(Arm::<false>::new()).geodesic(&[0.0; 3], &[0.0; 3], 1.0, 0.0, tolerance));
    assert_eq!(found, LagrangianError::NoDirection { squared_length: 0.0 });
}

/// A path that jumps.
struct Jump;
impl Path for Jump {
    fn freedom(&self) -> usize {
        3
    }
    fn at<T: Real>(&self, t: T, q: &mut [T]) {
        q.fill(T::select(t.less_than(T::lit(std::f64::consts::FRAC_1_SQRT_2)), T::zero(), t));
    }
}

#[test]
fn action_of_a_path_that_jumps_is_given_with_its_error_or_refused() {
    let system = everything();
    match system.action(&Jump, 0.0..1.0, Tolerance::relative(1e-13).unwrap()) {
        // Ten times what was found.
        Ok(action) => assert!(action.error <= 2e-11, "{action:?}"),
        Err(found) => assert!(matches!(found, LagrangianError::QuadratureNotConverged { .. }), "{found}"),
    }
    let found = refusal(system.action(&Jump, 0.0..f64::NAN, Tolerance::relative(1e-10).unwrap()));
    assert!(matches!(found, LagrangianError::NotFinite { quantity: "times", index: 1, .. }), "{found}");
}

#[test]
fn samples_out_of_order_and_too_few_are_refused() {
    let found = refusal(SampledMotion::new(1, vec![0.0, 1.0, 1.0], vec![0.0; 3], vec![0.0; 3]));
    assert_eq!(found, LagrangianError::TimesNotIncreasing { index: 2, time: 1.0, before: 1.0 });
    let two = SampledMotion::new(3, vec![0.0, 1.0], vec![0.0; 6], vec![0.0; 6]).unwrap();
    let few = LagrangianError::TooFewSamples { found: 2, needed: 3 };
    assert_eq!(refusal(everything().stationarity_of_samples(&two)), few);
    assert_eq!(refusal(everything().action_of_samples(&two)), few);
}

/// Two new coordinates for one old one.
#[derive(Clone)]
struct Sum;
impl ChangeOfCoordinates<1> for Sum {
    fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 1] {
        [new.iter().fold(T::zero(), |sum, &x| sum + x)]
    }
}

struct Line;
impl Holonomic for Line {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(2.0, Vector3::new(q[0], T::zero(), T::zero()));
    }
}

#[test]
fn more_new_coordinates_than_old_ones_are_named_as_dependent() {
    let found = refusal(Lagrangian::of(Line).in_coordinates(Sum).acceleration(&[0.0; 2], &[1.0; 2], 0.0));
    let LagrangianError::SingularMetric { coordinate: 1, direction, .. } = found else { panic!("{found}") };
    assert_close("null direction", &direction, &[-1.0, 1.0], Tol::ulps(4.0));
}

/// A heavy bob hangs from a light one, 10¹² times lighter, both still and far from the origin.
struct Hanging {
    origin: f64,
}
impl Holonomic for Hanging {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut end = Vector3::new(T::lit(self.origin), T::zero(), T::zero());
        for (mass, angle) in [1e-9, 1e3].into_iter().zip(q) {
            let (s, c) = angle.sin_cos();
            end += Vector3::new(s, T::zero(), -c);
            bodies.particle(mass, end);
        }
    }
}

/// The rods together hold each bob by its weight and by what bends its path.
#[test]
fn mass_ratio_of_a_million_millions_and_a_far_origin_leave_reactions_their_digits() {
    for origin in [0.0, 1e12] {
        let chain = Lagrangian::of(Hanging { origin }).with_gravity(10.0);
        let [light, heavy] = chain.reactions(&[0.0; 2], &[1.0, 2.0], 0.0).unwrap()[..] else { panic!("two parts") };
        // Upwards accelerations: 1² of the light bob, 1² + 2² of the heavy one.
        let tol = Tol::ulps(4.0);
        assert_close("light", light.force().as_slice(), &[0.0, 0.0, 1e-9 * (10.0 + 1.0)], tol);
        assert_close("heavy", heavy.force().as_slice(), &[0.0, 0.0, 1e3 * (10.0 + 5.0)], tol);
    }
}

/// A force that is defined before q = 1 only.
struct Wall;

impl Potential for Wall {
    fn potential<T: Real>(&self, q: &[T], _v: &[T], _t: T) -> T {
        -(T::one() - q[0]).powf(T::lit(1.5))
    }
}

#[test]
fn run_that_fails_keeps_the_steps_before() {
    let system = Lagrangian::of(Line).with_potential(Wall);
    let tolerance = Tolerance::relative(1e-10).expect("tolerance");
    let error = system.integrate(&[0.0], &[2.0], 0.0..5.0, tolerance).unwrap_err();
    let LagrangianError::Unfinished { time, run, .. } = &error else { panic!("{error}") };
    assert!(0 < run.steps() && run.times().len() as u64 == run.steps() + 1, "{error}");
    let (q, _) = run.last();
    assert!(0.9 < q[0] && q[0] <= 1.0, "stopped at {q:?}");
    assert_close("time", &[*time], &[run.times()[run.times().len() - 1]], Tol::ulps(0.0));
    // Ten times the tolerance of the steps.
    assert!(run.error_estimate().is_infinite() && run.energy_drift() < 1e-9);
}
