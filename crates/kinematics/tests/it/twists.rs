//! Twists, the exponential map of rigid motions and chains of joints.

use nalgebra::{Vector3, Vector6};
use piola_kinematics::twist::{ScrewAxis, adjoint, joint_twists_into, product_of_exponentials};
use piola_kinematics::{Attitude, BodyPose, BodyTwist, BodyVelocity, KinematicsError, SpaceTwist};
use piola_numerics::Dual;
use piola_testkit::strategies::{finite, rotation, unit_vector, vector};
use piola_testkit::{DoubleDouble, Tol, allocations_in, assert_close, assert_close_at_scale};
use proptest::prelude::*;

const FEW: Tol = Tol::ulps(64.0);

fn triple() -> impl Strategy<Value = Vector3<f64>> {
    vector(3, -2.0..2.0).prop_map(|v| Vector3::from_column_slice(&v))
}

fn pose() -> impl Strategy<Value = BodyPose<f64>> {
    (rotation(), triple()).prop_map(|(q, position)| BodyPose {
        position,
        attitude: Attitude::from_quaternion(q).expect("a unit quaternion"),
    })
}

/// ω up to nearly a half turn, of any size down to nothing.
fn twist() -> impl Strategy<Value = BodyTwist<f64>> {
    let angle = prop_oneof![finite(-200.0..0.0).prop_map(|e| 10.0_f64.powf(e)), finite(0.0..3.1)];
    (unit_vector(), angle, triple()).prop_map(|(axis, angle, v)| BodyTwist::new(Vector3::from(axis) * angle, v))
}

fn space(twist: &BodyTwist<f64>) -> SpaceTwist<f64> {
    SpaceTwist::new(twist.angular, twist.linear)
}

fn close(what: &str, actual: &Vector3<f64>, expected: &Vector3<f64>, scale: f64) {
    assert_close_at_scale(what, actual.as_slice(), expected.as_slice(), scale, FEW);
}

fn close_pose(what: &str, actual: &BodyPose<f64>, expected: &BodyPose<f64>, scale: f64) {
    close(what, &actual.position, &expected.position, scale);
    let (actual, expected) = (actual.attitude.to_matrix(), expected.attitude.to_matrix());
    assert_close(what, actual.as_slice(), expected.as_slice(), FEW);
}

/// The velocity of a pose computed over duals.
fn velocity(pose: &BodyPose<Dual<f64>>) -> (BodyPose<f64>, BodyVelocity<f64>) {
    let q = <[Dual<f64>; 4]>::from(pose.attitude);
    let [w, x, y, z] = q.map(|x| x.value);
    let attitude = Attitude { w, x, y, z };
    let velocity = BodyVelocity {
        velocity: pose.position.map(|x| x.tangent),
        angular_velocity: attitude.angular_velocity_in_body(q.map(|x| x.tangent)),
    };
    (BodyPose { position: pose.position.map(|x| x.value), attitude }, velocity)
}

proptest! {
    #[test]
    fn logarithm_of_exponential_equals_twist(twist in twist()) {
        let back = BodyTwist::logarithm(&twist.exponential());
        assert_close("ω", back.angular.as_slice(), twist.angular.as_slice(), FEW);
        close("v", &back.linear, &twist.linear, 2.0);
    }

    #[test]
    fn exponential_of_logarithm_equals_pose(pose in pose()) {
        close_pose("g", &SpaceTwist::logarithm(&pose).exponential(), &pose, 2.0);
    }

    #[test]
    fn twist_of_the_exponential_of_time_equals_the_exponent(twist in twist(), t in finite(-2.0..2.0), start in pose()) {
        let time = Dual::variable(t);
        // In body components the exponential stands on the right, in space components on the left.
        let moving = BodyPose::constant(&start).product(&BodyTwist::constant(&twist).scaled(time).exponential());
        let (pose, rate) = velocity(&moving);
        let found = BodyTwist::of_motion(&pose, &rate);
        close("ω", &found.angular, &twist.angular, 2.0);
        close("v", &found.linear, &twist.linear, 4.0);
        let fixed = space(&twist);
        let moving = SpaceTwist::constant(&fixed).scaled(time).exponential().product(&BodyPose::constant(&start));
        let (pose, rate) = velocity(&moving);
        let found = SpaceTwist::of_motion(&pose, &rate);
        close("ω", &found.angular, &fixed.angular, 2.0);
        close("v", &found.linear, &fixed.linear, 40.0);
    }

    #[test]
    fn exponential_of_the_displaced_twist_equals_the_displaced_exponential(twist in twist(), g in pose()) {
        let displaced = space(&twist).displaced(&g).exponential();
        close_pose("g exp ξ g⁻¹", &displaced, &g.product(&twist.exponential()).product(&g.inverse()), 8.0);
    }

    #[test]
    fn twist_of_space_equals_adjoint_times_twist_of_body(twist in twist(), g in pose(), h in pose()) {
        let in_space = twist.in_space(&g);
        let [a, v] = [twist.angular, twist.linear];
        let by_matrix = adjoint(&g) * Vector6::new(a.x, a.y, a.z, v.x, v.y, v.z);
        close("ω", &in_space.angular, &by_matrix.fixed_rows::<3>(0).into_owned(), 2.0);
        close("v", &in_space.linear, &by_matrix.fixed_rows::<3>(3).into_owned(), 8.0);
        let back = in_space.in_body(&g);
        close("ω back", &back.angular, &a, 2.0);
        close("v back", &back.linear, &v, 16.0);
        // Ad is a homomorphism.
        let product = adjoint(&g.product(&h));
        assert_close_at_scale("Ad_gh", product.as_slice(), (adjoint(&g) * adjoint(&h)).as_slice(), 8.0, FEW);
        // Both twists and the velocity say the same of the motion.
        let velocity = twist.velocity(&g);
        let other = in_space.velocity(&g);
        close("v^c", &velocity.velocity, &other.velocity, 16.0);
        close("ω", &velocity.angular_velocity, &other.angular_velocity, 2.0);
        let again = SpaceTwist::of_motion(&g, &velocity);
        close("ξ_s", &again.linear, &in_space.linear, 16.0);
        // Any embedded point moves by v + ω×x.
        let y = h.position;
        let at = in_space.velocity_at(&g.embedded_point(&y));
        let direct = velocity.velocity + g.attitude.to_space(&velocity.angular_velocity.cross(&y));
        close("v^p", &at, &direct, 32.0);
    }

    #[test]
    fn commutator_equals_derivative_of_the_displaced_twist(xi in twist(), eta in twist()) {
        let along = SpaceTwist::constant(&space(&xi)).scaled(Dual::variable(0.0)).exponential();
        let moving = SpaceTwist::constant(&space(&eta)).displaced(&along);
        let found = space(&xi).commutator(&space(&eta));
        close("ω", &found.angular, &moving.angular.map(|x| x.tangent), 10.0);
        close("v", &found.linear, &moving.linear.map(|x| x.tangent), 20.0);
    }

    #[test]
    fn screw_axis_of_a_screw_equals_its_axis(point in triple(), axis in unit_vector(), pitch in finite(-2.0..2.0), exponent in finite(-150.0..10.0)) {
        let (axis, speed) = (Vector3::from(axis), 10.0_f64.powf(exponent));
        let motion = SpaceTwist::screw(&point, &axis, pitch).expect("an axis").scaled(speed);
        let ScrewAxis::Screw { point: found, direction, speed: found_speed, pitch: found_pitch } =
            motion.screw_axis().expect("finite")
        else {
            panic!("{motion:?} turns");
        };
        close("direction", &direction, &axis, 1.0);
        close("point", &found, &(point - axis * axis.dot(&point)), 4.0);
        assert_close("speed", &[found_speed], &[speed], FEW);
        assert_close_at_scale("pitch", &[found_pitch], &[pitch], 4.0, FEW);
    }

    #[test]
    fn twist_of_a_chain_equals_columns_times_rates(
        axes in proptest::collection::vec((triple(), unit_vector(), finite(-1.0..1.0)), 5),
        q in vector(5, -2.0..2.0), rates in vector(5, -2.0..2.0), home in pose()
    ) {
        let joints: Vec<_> = axes
            .iter()
            .enumerate()
            .map(|(i, (point, axis, pitch))| {
                let axis = Vector3::from(*axis);
                // Three that turn, one that slides, one screw.
                match i {
                    2 => SpaceTwist::prismatic(&axis),
                    4 => SpaceTwist::screw(point, &axis, *pitch),
                    _ => SpaceTwist::revolute(point, &axis),
                }
                .expect("an axis")
            })
            .collect();
        let moving_q: Vec<_> = q.iter().zip(&rates).map(|(q, rate)| Dual::new(*q, *rate)).collect();
        let (pose, rate) = velocity(&product_of_exponentials(&joints, &moving_q, &home).expect("a pose"));
        close_pose("g", &product_of_exponentials(&joints, &q, &home).expect("a pose"), &pose, 40.0);
        let direct = SpaceTwist::of_motion(&pose, &rate);
        let mut columns = [SpaceTwist::at_rest(); 5];
        joint_twists_into(&joints, &q, &mut columns).expect("columns");
        let sum = columns.iter().zip(&rates).fold(SpaceTwist::at_rest(), |sum, (column, rate)| sum.plus(&column.scaled(*rate)));
        close("ω", &sum.angular, &direct.angular, 10.0);
        close("v", &sum.linear, &direct.linear, 200.0);
    }
}

#[test]
fn exponential_of_a_screw_equals_a_helix() {
    let screw = SpaceTwist::screw(&Vector3::new(1.0, 0.0, 0.0), &Vector3::z(), 0.25).expect("an axis");
    for angle in [1.0e-12, 1.0e-8, 1.0e-4, 0.3, 1.0, 2.0, 4.0, 6.0, 60.0] {
        let x = screw.scaled(angle).exponential().position;
        // 1 − cos in its half angle, which does not cancel.
        let half = (0.5 * angle).sin();
        let expected = [2.0 * half * half, -angle.sin(), 0.25 * angle];
        assert_close(&format!("{angle}"), x.as_slice(), &expected, Tol::ulps(4.0));
        assert_close_at_scale(
            &format!("{angle}: across"),
            &x.as_slice()[..1],
            &expected[..1],
            0.0,
            Tol::ulps(4.0 + 4.0 * angle),
        );
    }
}

#[test]
fn exponential_equals_that_in_doubled_precision() {
    let mut worst = 0.0_f64;
    for exponent in -12..1_i32 {
        for direction in [Vector3::new(0.6, 0.48, 0.64), Vector3::new(-0.28, 0.96, 0.0)] {
            let twist = SpaceTwist::new(direction * 3.0 * 10.0_f64.powi(exponent), Vector3::new(0.3, -1.1, 0.7));
            let pose = twist.exponential();
            let exact = SpaceTwist::<DoubleDouble>::constant(&twist).exponential();
            for (found, exact) in pose.position.iter().zip(exact.position.iter()) {
                worst = worst.max(exact.rounding_of(*found).abs() / f64::EPSILON);
            }
        }
    }
    assert!(worst <= 4.0, "{worst} ulp of |v|");
}

#[test]
fn chains_of_joints_allocate_nothing() {
    let joints = [SpaceTwist::revolute(&Vector3::x(), &Vector3::z()).expect("an axis"); 6];
    let home = BodyPose::at_rest();
    let (allocations, ()) = allocations_in(|| {
        let mut columns = [SpaceTwist::at_rest(); 6];
        joint_twists_into(&joints, &[0.1; 6], &mut columns).expect("columns");
        let _ = product_of_exponentials(&joints, &[0.1; 6], &home).expect("a pose");
        let _ = columns[5].screw_axis().expect("finite");
    });
    assert_eq!(allocations, 0);
}

#[test]
fn bad_axes_and_counts_are_refused_by_name() {
    let (zero, z) = (Vector3::zeros(), Vector3::z());
    assert!(matches!(SpaceTwist::revolute(&z, &zero), Err(KinematicsError::NoDirection { .. })));
    assert!(matches!(SpaceTwist::prismatic(&(z * f64::NAN)), Err(KinematicsError::NotFinite { .. })));
    let refused = SpaceTwist::screw(&zero, &z, f64::INFINITY);
    assert!(matches!(refused, Err(KinematicsError::NotFinite { quantity: "pitch", .. })));
    let refused = SpaceTwist::new(z, z * f64::NAN).screw_axis();
    assert!(matches!(refused, Err(KinematicsError::NotFinite { quantity: "velocity", index: 0, .. })));
    let slide = SpaceTwist::prismatic(&z).expect("an axis");
    assert_eq!(slide.screw_axis(), Ok(ScrewAxis::Translation { velocity: z }));
    let refused = product_of_exponentials(&[slide; 2], &[0.0], &BodyPose::at_rest());
    assert_eq!(refused, Err(KinematicsError::WrongLength { quantity: "coordinates", expected: 2, found: 1 }));
    let refused = joint_twists_into(&[slide; 2], &[0.0; 2], &mut [SpaceTwist::at_rest(); 3]);
    assert_eq!(refused, Err(KinematicsError::WrongLength { quantity: "columns", expected: 2, found: 3 }));
}

#[test]
fn axis_too_far_away_for_numbers_is_refused() {
    let slow = SpaceTwist::new(Vector3::new(0.0, 0.0, 1e-310), Vector3::x());
    let found = slow.screw_axis().expect_err("an axis at 1e310 m");
    assert!(matches!(found, KinematicsError::NotFinite { quantity: "point", .. }), "{found}");
    let fast = SpaceTwist::new(Vector3::repeat(f64::MAX), Vector3::x());
    let found = fast.screw_axis().expect_err("√3 of the largest number");
    assert!(matches!(found, KinematicsError::NotFinite { quantity: "speed", .. }), "{found}");
    let found =
        SpaceTwist::screw(&Vector3::repeat(f64::MAX), &Vector3::new(1.0, 1.0, -1.0), 0.0).expect_err("overflow");
    assert!(matches!(found, KinematicsError::NotFinite { quantity: "velocity", .. }), "{found}");
}
