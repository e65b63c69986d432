//! One test for each trap of the theory, and for each refusal.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::curve::{Curve, Frenet};
use piola_kinematics::euler_angles::AnglesOfAttitude;
use piola_kinematics::placement::{PlacementEvaluator, count, independence};
use piola_kinematics::solids::{Solid, body_of_particles};
use piola_kinematics::system::largest_distance_change;
use piola_kinematics::{
    Attitude, BodyVelocity, EulerAngles, EulerSequence, Holonomic, Inertia, KinematicsError, ParticleSystem, Placement,
    RigidBody,
};
use piola_numerics::{Dual, Jet, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::systems::{DoublePendulum, TopOnTable};

/// t ↦ d (t − 1)³ along a skew direction: no curvature anywhere, no velocity at t = 1.
struct Straight;

impl Curve for Straight {
    fn position<T: Real>(&self, t: T) -> Vector3<T> {
        let s = (t - T::one()).powi(3);
        Vector3::new(T::lit(0.3) * s, T::lit(-0.7) * s, T::lit(1.1) * s)
    }
}

/// A cubic parabola: curved but at its inflection t = 0.
struct Inflection;

impl Curve for Inflection {
    fn position<T: Real>(&self, t: T) -> Vector3<T> {
        Vector3::new(t, t * t * t, T::zero())
    }
}

#[test]
fn path_without_curvature_reports_no_normal() {
    for t in [-3.0, 0.1, 7.3] {
        let frenet = Frenet::of_curve(&Straight, t).expect("finite");
        assert!(matches!(frenet, Frenet::Straight { .. }), "{t}: {frenet:?}");
    }
    assert!(matches!(Frenet::of_curve(&Inflection, 0.0).expect("finite"), Frenet::Straight { .. }));
    assert!(matches!(Frenet::of_curve(&Inflection, 1.0e-9).expect("finite"), Frenet::Curved(_)));
}

#[test]
fn path_at_rest_reports_no_tangent() {
    assert!(matches!(Frenet::of_curve(&Straight, 1.0).expect("finite"), Frenet::Rest { .. }));
    let zero = Vector3::zeros();
    let frenet = Frenet::from_derivatives(&zero, &Vector3::x(), &Vector3::y()).expect("finite");
    assert!(matches!(frenet, Frenet::Rest { speed } if speed <= 0.0));
}

/// The path of a point of the rim of a wheel, at rest where it touches the ground.
struct Cycloid;

impl Curve for Cycloid {
    fn position<T: Real>(&self, t: T) -> Vector3<T> {
        let (s, c) = t.sin_cos();
        Vector3::new(t - s, T::one() - c, T::zero())
    }
}

#[test]
fn cusps_are_found_after_any_number_of_turns() {
    for turns in [0.0, 1.0, 2.0, 100.0] {
        // 2π rounded: the speed there is the rounding of the time times the acceleration.
        let t = turns * core::f64::consts::TAU;
        let frenet = Frenet::of_curve(&Cycloid, t).expect("finite");
        assert!(matches!(frenet, Frenet::Rest { .. }), "{turns}: {frenet:?}");
        assert!(matches!(Frenet::of_curve(&Cycloid, t + 1e-3).expect("finite"), Frenet::Curved(_)), "{turns}");
    }
}

#[test]
fn change_of_distance_is_relative_to_the_largest_distance() {
    // 2 m, 4 m and 6 m apart on a line; the last is moved by 3 m: 9 m instead of 6 m.
    let before = [0.0, 2.0, 6.0].map(|x| Vector3::new(x, 0.0, 0.0));
    let after = [0.0, 2.0, 9.0].map(|x| Vector3::new(0.0, x, 0.0));
    let change = largest_distance_change(&before, &after).expect("finite").expect("three particles");
    assert_eq!(change.pair, (0, 2));
    assert_close("relative", &[change.relative_change], &[0.5], Tol::ulps(1.0));
    assert_eq!(largest_distance_change(&before[..1], &after[..1]), Ok(None));
    let together = [Vector3::zeros(); 2];
    let same = largest_distance_change(&together, &together).expect("finite").expect("two particles");
    assert_close("nothing moves", &[same.relative_change], &[0.0], Tol::ulps(0.0));
    let apart = largest_distance_change(&together, &before[..2]).expect("finite").expect("two particles");
    assert!(apart.relative_change.is_infinite());
}

#[test]
fn frenet_data_of_tiny_and_huge_curves_equal_scaled_data() {
    let (v, a, j) = (Vector3::new(0.0, 4.0, 0.0), Vector3::new(-8.0, 1.0, 0.0), Vector3::new(0.0, -16.0, 8.0));
    for scale in [1.0e-200, 1.0, 1.0e150] {
        let frenet = Frenet::from_derivatives(&(v * scale), &(a * scale), &(j * scale)).expect("finite");
        let Frenet::Curved(path) = frenet else { panic!("{scale}: {frenet:?}") };
        assert_close("κ · scale", &[path.curvature * scale], &[0.5], Tol::ulps(8.0));
        assert_close("τ · scale", &[path.torsion * scale], &[0.25], Tol::ulps(8.0));
    }
}

#[test]
fn relative_parts_far_from_the_origin_equal_those_near_it() {
    // Distances of metres at the distance of the Sun: positions are multiples of 2⁻⁵ m there and exact.
    let far = Vector3::new(1.5e11, -0.75e11, 0.3e11);
    let speed = Vector3::new(3.0e4, 1.0e4, -2.0e4);
    let masses: Vec<f64> = (0..100_i32).map(|i| 1.0 + f64::from(i % 7)).collect();
    let near: Vec<_> =
        (0..100_i32).map(|i| Vector3::new(f64::from(i % 5), f64::from(i % 11), f64::from(i % 3)) * 0.25).collect();
    let slow: Vec<_> = near.iter().map(|x| Vector3::new(-x.y, x.x, x.z) * 0.125).collect();
    let away: Vec<_> = near.iter().map(|x| x + far).collect();
    let fast: Vec<_> = slow.iter().map(|v| v + speed).collect();
    let here = ParticleSystem::new(&masses, &near, &slow).expect("a system");
    let there = ParticleSystem::new(&masses, &away, &fast).expect("a system");
    let tol = Tol::ulps(64.0);
    assert_close("E", &[there.kinetic_energy().relative], &[here.kinetic_energy().relative], tol);
    let (moment, expected) = (there.angular_momentum(&far).relative, here.angular_momentum(&Vector3::zeros()).relative);
    assert_close("H", moment.as_slice(), expected.as_slice(), tol);
    let (inertia, expected) = (there.inertia_about_centre_of_mass(), here.inertia_about_centre_of_mass());
    assert_close("I", inertia.as_slice(), expected.as_slice(), tol);
}

#[test]
fn rate_matrix_near_gimbal_is_right_and_its_condition_number_reported() {
    let euler = EulerAngles::zyz([1.3, 1.0e-8, -2.0]);
    let found = euler.rates(&Vector3::new(0.5, -1.0, 2.0)).expect("still regular");
    assert_close("cond W", &[found.condition_number], &[2.0e8], Tol::ulps(4.0));
    let back = euler.rate_matrix() * Vector3::from(found.rates);
    let tol = Tol::ulps(8.0).times(found.condition_number);
    assert_close("W W⁻¹ ω", back.as_slice(), &[0.5, -1.0, 2.0], tol);
}

#[test]
fn gimbal_points_are_reported() {
    for theta2 in [0.0, core::f64::consts::PI] {
        let euler = EulerAngles::zyz([0.4, theta2, 0.3]);
        let refused = euler.rates(&Vector3::x());
        assert!(matches!(refused, Err(KinematicsError::GimbalPoint { .. })), "{refused:?}");
    }
    let tol = Tol::ulps(4.0);
    let AnglesOfAttitude::Gimbal { sum, .. } =
        EulerAngles::of_attitude(EulerSequence::Zyz, Attitude::from_euler_zyz([0.4, 0.0, 0.3]))
    else {
        panic!("θ² = 0 is a gimbal point");
    };
    assert_close("θ¹ + θ³", &[sum], &[0.7], tol);
    let reversed = Attitude::from_euler_zyz([0.4, core::f64::consts::PI, 0.3]);
    let AnglesOfAttitude::ReversedGimbal { difference, angles } =
        EulerAngles::of_attitude(EulerSequence::Zyz, reversed)
    else {
        panic!("θ² = π is a gimbal point");
    };
    assert_close("θ¹ − θ³", &[difference], &[0.1], Tol::ulps(16.0));
    let (chosen, given) = (angles.matrix(), reversed.to_matrix());
    assert_close("Q", chosen.as_slice(), given.as_slice(), Tol::ulps(16.0));
    // Near π, but not there, θ² keeps its digits: π − θ² is right although cos θ² no longer feels it.
    let near = EulerAngles::of_attitude(
        EulerSequence::Zyz,
        Attitude::from_euler_zyz([0.4, core::f64::consts::PI - 1.0e-8, 0.3]),
    );
    let gap = core::f64::consts::PI - near.angles().theta[1];
    assert_close_at_scale("π − θ²", &[gap], &[1.0e-8], core::f64::consts::PI, Tol::ulps(2.0));
}

#[test]
fn quaternion_has_no_gimbal() {
    // Straight through the pole: the quaternion's rate gives back ω where W has no inverse.
    let attitude = Attitude::from_euler_zyz([0.4, 0.0, 0.3]);
    let omega = Vector3::new(1.0, 2.0, 3.0);
    let found = attitude.angular_velocity_in_body(attitude.rate(&omega));
    assert_close("ω", found.as_slice(), omega.as_slice(), Tol::ulps(4.0));
}

#[test]
fn derivatives_at_zero_rotation_are_finite() {
    // Third derivatives through zero: q(s) = exp(s n) has q‴ = −⅛ n at s = 0 in its vector part.
    let s = Dual::new(Jet::<f64, 0>::time(0.0), Jet::constant(1.0));
    let zero = Dual::constant(Jet::constant(0.0));
    let q = Attitude::from_rotation_vector(&Vector3::new(zero, s, zero));
    assert_close("q‴", &[q.y.tangent.second_rate, q.w.tangent.second_rate], &[-0.125, 0.0], Tol::ulps(2.0));
    let back = q.rotation_vector();
    let derivatives = [back.y.value.value, back.y.value.rate, back.y.tangent.rate, back.y.tangent.second_rate];
    assert_close("log exp", &derivatives, &[0.0, 1.0, 0.0, 0.0], Tol::ulps(2.0));
}

#[test]
fn impossible_inertia_is_refused_by_name() {
    let refused = Inertia::principal([1.0, 2.0, 3.5]);
    assert_eq!(refused, Err(KinematicsError::InertiaTriangleInequality { principal_moments: [1.0, 2.0, 3.5] }));
    let refused = Inertia::principal([1.0, -2.0, 3.0]);
    assert!(matches!(refused, Err(KinematicsError::InertiaNotPositiveDefinite { .. })));
    let refused = Inertia::new(Matrix3::new(2.0, 0.1, 0.0, 0.2, 2.0, 0.0, 0.0, 0.0, 2.0));
    assert!(matches!(refused, Err(KinematicsError::InertiaNotSymmetric { row: 0, column: 1, .. })));
    let refused = Inertia::principal([1.0, f64::NAN, 1.0]);
    assert!(matches!(refused, Err(KinematicsError::NotFinite { index: 4, .. })));
    let refused = Inertia::new(Matrix3::zeros());
    assert!(matches!(refused, Err(KinematicsError::InertiaNotPositiveDefinite { .. })));
    // The limit is allowed: a flat body has I₃ = I₁ + I₂, also after rounding.
    assert!(Inertia::principal([0.1, 0.2, 0.1 + 0.2]).is_ok());
    assert!(Inertia::principal([0.1, 0.2, 0.3]).is_ok());
}

#[test]
fn body_without_thickness_about_an_axis_is_refused_with_advice() {
    let points = [Vector3::new(1.0, 2.0, 3.0), Vector3::new(2.0, 4.0, 6.0), Vector3::new(-1.0, -2.0, -3.0)];
    let refused = body_of_particles(&[1.0, 2.0, 3.0], &points).expect_err("a line");
    assert!(matches!(refused, KinematicsError::InertiaNotPositiveDefinite { .. }));
    assert!(refused.to_string().contains("as particles"), "{refused}");
}

#[test]
fn bad_masses_and_sizes_are_refused_by_name() {
    let inertia = Inertia::principal([1.0, 1.0, 1.0]).expect("a body");
    assert_eq!(RigidBody::new(-2.0, inertia), Err(KinematicsError::NonPositiveMass { mass: -2.0 }));
    assert!(matches!(RigidBody::new(f64::INFINITY, inertia), Err(KinematicsError::NotFinite { .. })));
    let refused = Solid::Cylinder { radius: 1.0, height: 0.0 }.inertia(1.0);
    assert!(matches!(refused, Err(KinematicsError::NonPositiveSize { quantity: "height", .. })));
    let flat = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    assert!(matches!(Solid::Tetrahedron { vertices: flat }.volume(), Err(KinematicsError::NoVolume { .. })));
    let zero = [Vector3::<f64>::zeros(); 2];
    assert!(matches!(ParticleSystem::new(&[1.0, 0.0], &zero, &zero), Err(KinematicsError::NonPositiveMass { .. })));
    assert!(matches!(ParticleSystem::<f64>::new(&[], &[], &[]), Err(KinematicsError::NoParticles)));
    assert!(matches!(ParticleSystem::new(&[1.0], &zero, &zero), Err(KinematicsError::WrongLength { .. })));
}

#[test]
fn bad_attitudes_are_refused_by_name() {
    assert!(matches!(Attitude::from_quaternion([0.0; 4]), Err(KinematicsError::NoDirection { .. })));
    assert!(matches!(Attitude::from_quaternion([f64::NAN; 4]), Err(KinematicsError::NotFinite { .. })));
    assert!(matches!(Attitude::try_from([1.0, 1.0, 0.0, 0.0]), Err(KinematicsError::NotUnitQuaternion { .. })));
    assert!(matches!(Attitude::try_from([f64::NAN; 4]), Err(KinematicsError::NotUnitQuaternion { .. })));
    assert!(matches!(Attitude::from_axis_angle(&Vector3::zeros(), 1.0), Err(KinematicsError::NoDirection { .. })));
    assert!(matches!(Attitude::from_matrix(&(Matrix3::identity() * 1.1)), Err(KinematicsError::NotRotation { .. })));
    assert!(matches!(Attitude::from_matrix(&-Matrix3::identity()), Err(KinematicsError::NotRotation { .. })));
    // Lengths whose squares leave the range of doubles are no obstacle.
    let tiny = Attitude::from_quaternion([0.0, 3.0e-300, 0.0, 4.0e-300]).expect("a direction");
    assert_close("tiny", &[tiny.x, tiny.z], &[0.6, 0.8], Tol::ulps(2.0));
}

/// Spherical coordinates, whose azimuth moves nothing on the axis.
struct Spherical;

impl Holonomic for Spherical {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let ((s0, c0), (s1, c1)) = (q[0].sin_cos(), q[1].sin_cos());
        bodies.particle(2.0, Vector3::new(s0 * c1, s0 * s1, c0));
    }
}

/// Coordinates of very different units, one of which only repeats two others.
struct Repeating;

impl Holonomic for Repeating {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let x = q[0] * T::lit(1.0e-9) + q[2] * T::lit(1.0e3);
        bodies.particle(1.0, Vector3::new(x, q[1], T::zero()));
        bodies.particle(3.0, Vector3::new(x, T::zero(), q[3]));
    }
}

#[test]
fn dependent_coordinates_are_named() {
    let found = independence(&Repeating, &[0.1, 0.2, 0.3, 0.4], 0.0);
    assert_eq!(found, Err(KinematicsError::DependentCoordinates { coordinates: vec![0, 2], rank: 3 }));
    let found = independence(&Spherical, &[0.0, 0.3], 0.0);
    assert_eq!(found, Err(KinematicsError::DependentCoordinates { coordinates: vec![1], rank: 1 }));
    let regular = independence(&Spherical, &[0.5, 0.3], 0.0).expect("independent");
    assert_close("orthogonal tangents", &[regular.condition_number], &[1.0], Tol::ulps(8.0));
    // Eulerian angles at the gimbal: the outer two turn about one axis.
    let found = independence(&TopOnTable::new(), &[0.3, 0.0, 0.2, 1.0], 0.0);
    assert_eq!(found, Err(KinematicsError::DependentCoordinates { coordinates: vec![0, 2], rank: 3 }));
    assert!(independence(&TopOnTable::new(), &[0.3, 1.0, 0.2, 1.0], 0.0).is_ok());
    assert!(independence(&DoublePendulum { length: [1.0, 0.5] }, &[0.3, 0.3], 0.0).is_ok());
}

/// A cart on a rail, its place in millimetres; a pendulum on it, its angle; a satellite far along the rail, in
/// kilometres from the cart. The masses are 10¹² apart.
struct Scaled {
    /// Whether the last coordinate is once more the place of the cart and all on it, in kilometres.
    repeated: bool,
}

impl Holonomic for Scaled {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let shift = if self.repeated { q[3] * T::lit(1.0e3) } else { T::zero() };
        let cart = q[0] * T::lit(1.0e-3) + shift;
        let (s, c) = q[1].sin_cos();
        bodies.particle(1.0e6, Vector3::new(cart, T::zero(), T::zero()));
        bodies.particle(1.0e-6, Vector3::new(cart + s, T::zero(), -c));
        bodies.particle(1.0, Vector3::new(cart + q[2] * T::lit(1.0e3), T::zero(), T::zero()));
    }
}

#[test]
fn dependence_does_not_depend_on_units_and_masses() {
    // Unequal masses make tangents nearly parallel in the metric; they stay independent.
    let found = independence(&Scaled { repeated: false }, &[250.0, 0.7, 384.0e3], 0.0).expect("independent");
    // Columns of length one: the cart's has the cosine √(m/Σ) cos φ with the pendulum's and √(s/Σ) with the satellite's,
    // where m = 1e-6, s = 1, Σ = 1e6 + m + s; the other two are orthogonal. Singular values are 1 and √(1 ± ρ).
    let rho = ((1e-6 * 0.7_f64.cos().powi(2) + 1.0) / (1e6 + 1.0 + 1e-6)).sqrt();
    let expected = ((1.0 + rho) / (1.0 - rho)).sqrt();
    assert_close("condition number", &[found.condition_number], &[expected], Tol::ulps(16.0));
    let found = independence(&Scaled { repeated: true }, &[250.0, 0.7, 384.0e3, 2.0], 0.0);
    assert_eq!(found, Err(KinematicsError::DependentCoordinates { coordinates: vec![0, 3], rank: 3 }));
}

/// Says that it does not depend on time, yet uses it.
struct Undeclared;

impl Holonomic for Undeclared {
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(1.0, Vector3::new(q[0] + t, T::zero(), T::zero()));
    }
}

#[test]
fn time_independent_system_has_no_row_of_time() {
    let mut velocity = [Vector3::zeros()];
    let mut evaluator = PlacementEvaluator::new(1);
    evaluator.velocities_into(&Undeclared, &[0.0], &[2.0], 5.0, &mut velocity, &mut []).expect("a velocity");
    assert_close("v without ∂x/∂t", &[velocity[0].x], &[2.0], Tol::ulps(0.0));
    let refused = evaluator.tangent_into(&Undeclared, &[0.0], 5.0, 1, &mut velocity, &mut []);
    assert_eq!(refused, Err(KinematicsError::NoSuchDirection { direction: 1, directions: 1 }));
}

#[test]
fn wrong_buffers_and_states_are_refused_by_name() {
    let system = TopOnTable::new();
    let parts = count(&system, &[0.0; 4], 0.0);
    assert_eq!((parts.particles, parts.bodies), (1, 1));
    let mut evaluator = PlacementEvaluator::new(4);
    let (mut v, mut body) = ([Vector3::zeros(); 2], [BodyVelocity::at_rest()]);
    let refused = evaluator.velocities_into(&system, &[0.1; 4], &[0.0; 4], 0.0, &mut v, &mut body);
    assert_eq!(refused, Err(KinematicsError::WrongLength { quantity: "particle buffer", expected: 1, found: 2 }));
    let refused = evaluator.velocities_into(&system, &[0.1; 3], &[0.0; 4], 0.0, &mut v[..1], &mut body);
    assert_eq!(refused, Err(KinematicsError::WrongLength { quantity: "coordinates", expected: 4, found: 3 }));
    let refused =
        evaluator.velocities_into(&system, &[0.1, 0.2, f64::NAN, 0.0], &[0.0; 4], 0.0, &mut v[..1], &mut body);
    assert!(matches!(refused, Err(KinematicsError::NotFinite { quantity: "coordinates", index: 2, .. })));
    let refused = evaluator.velocities_into(&system, &[0.1; 4], &[0.0; 4], f64::INFINITY, &mut v[..1], &mut body);
    assert!(matches!(refused, Err(KinematicsError::NotFinite { quantity: "t", .. })));
}

#[cfg(feature = "serde")]
#[test]
fn what_is_read_is_validated() {
    use piola_kinematics::RotationVector;
    use serde::de::IntoDeserializer;
    use serde::de::value::{MapDeserializer, SeqDeserializer};

    let inertia = Inertia::principal([1.0, 2.0, 2.5]).expect("a body");
    let body = RigidBody::new(2.0, inertia).expect("a body");
    let text = serde_json::to_string(&body).expect("text");
    assert_eq!(serde_json::from_str::<RigidBody>(&text).expect("a body"), body);
    let negative = r#"{"mass": -1.0, "inertia": [[1,0,0],[0,1,0],[0,0,1]]}"#;
    assert!(serde_json::from_str::<RigidBody>(negative).is_err());
    assert!(serde_json::from_str::<Inertia>("[[1,0,0],[0,1,0],[0,0,9]]").is_err());
    assert!(serde_json::from_str::<Attitude<f64>>("[1.0, 1.0, 0.0, 0.0]").is_err());
    let angles = |third: f64| {
        let theta: SeqDeserializer<_, serde::de::value::Error> = vec![0.0, 1.0, third].into_deserializer();
        let fields = MapDeserializer::new([("theta", theta)].into_iter());
        <EulerAngles<f64> as serde::Deserialize>::deserialize(fields)
    };
    assert!(angles(2.0).is_ok() && angles(f64::NAN).is_err());
    let angles: EulerAngles<f64> = serde_json::from_str(r#"{"theta": [0.1, 0.2, 0.3]}"#).expect("angles");
    assert_eq!(angles, EulerAngles::zyz([0.1, 0.2, 0.3]));
    let angles: EulerAngles<f64> =
        serde_json::from_str(r#"{"sequence": "zyx", "theta": [0.1, 0.2, 0.3]}"#).expect("angles");
    assert_eq!(angles.sequence, EulerSequence::Zyx);
    assert!(serde_json::from_str::<EulerAngles<f64>>(r#"{"sequence": "zzx", "theta": [0.1, 0.2, 0.3]}"#).is_err());
    let phi: RotationVector<f64> = serde_json::from_str("[0.1, 0.2, 0.3]").expect("a vector");
    assert_eq!(phi, RotationVector(Vector3::new(0.1, 0.2, 0.3)));
    let attitude = Attitude::about_x(0.3);
    let text = serde_json::to_string(&attitude).expect("text");
    assert_eq!(serde_json::from_str::<Attitude<f64>>(&text).expect("an attitude"), attitude);
    let cone: Solid = serde_json::from_str(r#"{"shape": "cone", "radius": 1.0, "height": 2.0}"#).expect("a cone");
    assert_eq!(cone, Solid::Cone { radius: 1.0, height: 2.0 });
}

#[cfg(feature = "glam")]
#[test]
fn pose_equals_body_pose() {
    use piola_kinematics::{BodyPose, Pose};
    let pose = BodyPose { position: Vector3::new(1.0, 2.0, 3.0), attitude: Attitude::from_euler_zyz([0.3, 0.5, 0.7]) };
    let y = Vector3::new(0.2, -0.4, 0.9);
    let fast = Pose::from(pose);
    let there = fast.to_space(glam::DVec3::new(y.x, y.y, y.z));
    assert_close("x^p", &there.to_array(), pose.embedded_point(&y).as_slice(), Tol::ulps(4.0));
    assert_close("y", &fast.to_body(there).to_array(), y.as_slice(), Tol::ulps(8.0));
    assert_eq!(BodyPose::from(fast), pose);
}
