//! Numbered equations against values worked out by hand, or by mpmath from their definitions.

use nalgebra::Vector3;
use piola_kinematics::particle::{Motion, MovingFrame};
use piola_kinematics::placement::{PlacementEvaluator, independence};
use piola_kinematics::system::largest_distance_change;
use piola_kinematics::{Attitude, BodyPose, BodyVelocity, Holonomic, KinematicsError, Placement};
use piola_numerics::Real;
use piola_testkit::golden::{load, matrix, text, vector};
use piola_testkit::strategies::{finite, rotation, vector as random};
use piola_testkit::{Tol, assert_close, assert_each_close, assert_each_close_at_scales};
use proptest::prelude::*;

use crate::systems::{DoublePendulum, TopOnTable};

/// Sums of some ten products of rounded numbers.
const FEW: Tol = Tol::ulps(16.0);

type Case = serde_json::Value;

fn triple(value: &Case) -> Vector3<f64> {
    Vector3::from_column_slice(&vector(value))
}

/// Three vectors: a quantity and its first two derivatives, or a basis.
fn three(value: &Case) -> [Vector3<f64>; 3] {
    let rows = matrix(value);
    core::array::from_fn(|i| Vector3::from_column_slice(&rows[i]))
}

fn motion(value: &Case) -> Motion<f64> {
    let [position, velocity, acceleration] = three(value);
    Motion { position, velocity, acceleration }
}

fn close(what: &str, actual: &Vector3<f64>, expected: &Vector3<f64>) {
    assert_close(what, actual.as_slice(), expected.as_slice(), FEW);
}

/// W(1.9), term by term, in a frame that precesses, nods and spins: ω̇ is not along ω, and every term has a component
/// that no other has.
#[test]
fn terms_of_the_motion_in_a_moving_frame_equal_reference() {
    let data = load("equations");
    let case = data.cases.iter().find(|case| text(&case["equation"]) == "W(1.9)").expect("a case");
    let basis = case["basis"].as_array().expect("three derivatives");
    let given = MovingFrame {
        origin: motion(&case["origin"]),
        basis: three(&basis[0]),
        basis_rate: three(&basis[1]),
        basis_second_rate: three(&basis[2]),
    };
    let (omega, omega_rate) = (triple(&case["angular_velocity"]), triple(&case["angular_acceleration"]));
    let rigid = MovingFrame::rigid(given.origin, given.basis, &omega, &omega_rate);
    for i in 0..3 {
        close("ė_i", &rigid.basis_rate[i], &given.basis_rate[i]);
        close("ë_i", &rigid.basis_second_rate[i], &given.basis_second_rate[i]);
    }
    let (within, expected) = (motion(&case["within"]), motion(&case["motion"]));
    for frame in [given, rigid] {
        let found = frame.motion_in_space(&within);
        close("x", &found.position, &expected.position);
        close("v", &found.velocity, &expected.velocity);
        close("a", &found.acceleration, &expected.acceleration);
        let terms = frame.acceleration_terms(&within);
        close("a°", &terms.origin, &expected_origin(case));
        close("ẍⁱ e_i", &terms.relative, &triple(&case["relative"]));
        close("2 ẋⁱ ė_i", &terms.coriolis, &triple(&case["coriolis"]));
        close("xⁱ ë_i", &terms.transport, &triple(&case["transport"]));
    }
}

fn expected_origin(case: &Case) -> Vector3<f64> {
    three(&case["origin"])[2]
}

/// W(1.26) for changes of size: distances 5, 12 and 13 before.
#[test]
fn largest_change_of_distance_equals_that_of_right_triangles() {
    let before = [Vector3::zeros(), Vector3::new(3.0, 4.0, 0.0), Vector3::new(0.0, 0.0, 12.0)];
    let change = |after: [Vector3<f64>; 3]| {
        let found = largest_distance_change(&before, &after).expect("finite").expect("three particles");
        (found.pair, found.relative_change)
    };
    // (0, 1) grows from 5 to 10, (1, 2) from 13 to √(100 + 144) = 15.6…: by 5 of the largest, 13.
    let (pair, found) = change([before[0], Vector3::new(6.0, 8.0, 0.0), before[2]]);
    assert_eq!(pair, (0, 1));
    assert_each_close("longer", &[found], &[5.0 / 13.0], Tol::ulps(2.0));
    // (0, 2) shrinks from 12 to 5, (1, 2) from 13 to √50 = 7.07…: by −7.
    let (pair, found) = change([before[0], before[1], Vector3::new(0.0, 0.0, 5.0)]);
    assert_eq!(pair, (0, 2));
    assert_each_close("shorter", &[found], &[-7.0 / 13.0], Tol::ulps(2.0));
    // All by a half: the longest, (1, 2), by 6.5.
    let (pair, found) = change(before.map(|x| 1.5 * x));
    assert_eq!(pair, (1, 2));
    assert_each_close("swollen", &[found], &[0.5], Tol::ulps(2.0));
    // A half turn about an axis and a shift in whole numbers, and a reflection: nothing to the last bit.
    for rigid in [Vector3::new(-1.0, -1.0, 1.0), Vector3::new(1.0, 1.0, -1.0)] {
        let (_, found) = change(before.map(|x| x.component_mul(&rigid) + Vector3::new(7.0, -2.0, 5.0)));
        assert_eq!(found.to_bits(), 0.0_f64.to_bits());
    }
}

proptest! {
    /// x ↦ s R x + c changes the distance d by (s − 1) d, the largest most.
    #[test]
    fn largest_change_of_distance_of_a_similarity_equals_its_excess_over_one(
        x in proptest::collection::vec(random(3, -2.0..2.0), 4..9), q in rotation(), shift in random(3, -2.0..2.0),
        stretch in finite(0.25..3.0),
    ) {
        let attitude = Attitude::from_quaternion(q).expect("a unit quaternion");
        let before: Vec<_> = x.iter().map(|x| Vector3::from_column_slice(x)).collect();
        let shift = Vector3::from_column_slice(&shift);
        let after: Vec<_> = before.iter().map(|x| attitude.to_space(x) * stretch + shift).collect();
        let found = largest_distance_change(&before, &after).expect("finite").expect("several particles");
        // Places of some ten are rounded; the largest of six or more distances is seldom below one.
        let largest = before.iter().flat_map(|a| before.iter().map(move |b| (a - b).norm())).fold(0.0, f64::max);
        let scale = 10.0 / largest;
        assert_each_close_at_scales("s − 1", &[found.relative_change], &[stretch - 1.0], &[scale], FEW);
        // The nearer s to one, the sooner rounding hides which pair is the longest.
        let (i, j) = found.pair;
        let hidden = Tol::ulps(8.0).times(scale / (stretch - 1.0).abs());
        assert_each_close("the longest pair", &[(before[i] - before[j]).norm()], &[largest], hidden);
    }
}

/// The closed form of [`TopOnTable`], with φ = θ¹ + Ωt, a = Ωt, h = 9/8 and r = q⁴:
///
/// ```text
/// foot = r (cos a, sin a, 0)                  v = ṙ (cos a, sin a, 0) + r Ω (−sin a, cos a, 0)
/// f₃ = (s₂ cos φ, s₂ sin φ, c₂)               ḟ₃ = θ̇² (c₂ cos φ, c₂ sin φ, −s₂) + (θ̇¹ + Ω) s₂ (−sin φ, cos φ, 0)
/// ξ = foot + h f₃                             ω = W(θ) (θ̇¹ + Ω, θ̇², θ̇³),  W(2.26)
/// ```
struct ByHand {
    foot: [f64; 3],
    foot_velocity: [f64; 3],
    centre: [f64; 3],
    centre_velocity: [f64; 3],
    angular_velocity: [f64; 3],
    /// Sizes of the terms that make a velocity, and an angular velocity.
    sizes: [f64; 2],
}

fn by_hand(q: &[f64], v: &[f64], t: f64) -> ByHand {
    let (speed, height) = (1.5, 1.125);
    let (a, phi, r) = (speed * t, q[0] + speed * t, q[3]);
    let ((s2, c2), (s3, c3)) = (q[1].sin_cos(), q[2].sin_cos());
    let turning = v[0] + speed;
    let foot = [r * a.cos(), r * a.sin(), 0.0];
    let foot_velocity = [v[3] * a.cos() - r * speed * a.sin(), v[3] * a.sin() + r * speed * a.cos(), 0.0];
    let axis = [s2 * phi.cos(), s2 * phi.sin(), c2];
    let axis_rate = [
        v[1] * c2 * phi.cos() - turning * s2 * phi.sin(),
        v[1] * c2 * phi.sin() + turning * s2 * phi.cos(),
        -v[1] * s2,
    ];
    ByHand {
        foot,
        foot_velocity,
        centre: core::array::from_fn(|i| foot[i] + height * axis[i]),
        centre_velocity: core::array::from_fn(|i| foot_velocity[i] + height * axis_rate[i]),
        angular_velocity: [-s2 * c3 * turning + s3 * v[1], s2 * s3 * turning + c3 * v[1], c2 * turning + v[2]],
        sizes: [
            v[3].abs() + r * speed + height * (v[1].abs() + turning.abs()),
            turning.abs() + v[1].abs() + v[2].abs(),
        ],
    }
}

proptest! {
    /// W(3.24) with W(3.28–3.31): the explicit dependence on time enters as Ω beside θ̇¹ and as r Ω of the foot.
    #[test]
    fn placement_and_velocities_of_a_top_on_a_turning_table_equal_their_closed_form(
        theta in random(3, -3.0..3.0), r in finite(0.5..3.0), v in random(4, -2.0..2.0), t in finite(-3.0..3.0)
    ) {
        let (system, q) = (TopOnTable::new(), [theta[0], theta[1], theta[2], r]);
        let expected = by_hand(&q, &v, t);
        let mut evaluator = PlacementEvaluator::new(4);
        let at_origin = BodyPose { position: Vector3::zeros(), attitude: Attitude::identity() };
        let (mut place, mut pose) = ([Vector3::zeros()], [at_origin]);
        evaluator.positions_into(&system, &q, t, &mut place, &mut pose).expect("places");
        // Angles of some seven radians round to seven ulp of one.
        let tol = Tol::ulps(32.0);
        assert_each_close_at_scales("x", place[0].as_slice(), &expected.foot, &[r; 3], tol);
        assert_each_close_at_scales("ξ", pose[0].position.as_slice(), &expected.centre, &[r + 1.125; 3], tol);
        let (mut velocity, mut body) = ([Vector3::zeros()], [BodyVelocity::at_rest()]);
        evaluator.velocities_into(&system, &q, &v, t, &mut velocity, &mut body).expect("velocities");
        let [linear, angular] = expected.sizes.map(|size| [size; 3]);
        assert_each_close_at_scales("v", velocity[0].as_slice(), &expected.foot_velocity, &linear, tol);
        assert_each_close_at_scales("v^c", body[0].velocity.as_slice(), &expected.centre_velocity, &linear, tol);
        assert_each_close_at_scales("ω", body[0].angular_velocity.as_slice(), &expected.angular_velocity, &angular, tol);
        // The tangent vectors h_Δ and ∂/∂t are the closed form at q̇ = e_Δ less that at rest, and at rest.
        let rest = by_hand(&q, &[0.0; 4], t);
        for direction in 0..5 {
            evaluator.tangent_into(&system, &q, t, direction, &mut velocity, &mut body).expect("a tangent");
            let mut unit = [0.0; 4];
            if let Some(rate) = unit.get_mut(direction) {
                *rate = 1.0;
            }
            let along = by_hand(&q, &unit, t);
            let less = |along: [f64; 3], rest: [f64; 3]| -> [f64; 3] {
                if direction == 4 { rest } else { core::array::from_fn(|i| along[i] - rest[i]) }
            };
            let scale = [2.0 + 3.0 * r; 3];
            let what = format!("direction {direction}");
            let expected = less(along.foot_velocity, rest.foot_velocity);
            assert_each_close_at_scales(&what, velocity[0].as_slice(), &expected, &scale, tol);
            let expected = less(along.centre_velocity, rest.centre_velocity);
            assert_each_close_at_scales(&what, body[0].velocity.as_slice(), &expected, &scale, tol);
            let expected = less(along.angular_velocity, rest.angular_velocity);
            assert_each_close_at_scales(&what, body[0].angular_velocity.as_slice(), &expected, &[4.0; 3], tol);
        }
    }

    /// W(3.2–3.4) of a double pendulum with equal bobs. Its columns √m ∂x/∂q have the squares 2 l₁² and l₂² and the
    /// product l₁ l₂ cos(q¹ − q²): of length one they make the cosine c = cos(q¹ − q²)/√2, and singular values √(1 ± |c|).
    #[test]
    fn placement_and_condition_number_of_a_double_pendulum_equal_their_closed_form(
        q in random(2, -3.0..3.0), lengths in random(2, 0.25..4.0)
    ) {
        let system = DoublePendulum { length: [lengths[0], lengths[1]] };
        let mut places = [Vector3::zeros(); 2];
        PlacementEvaluator::new(2).positions_into(&system, &q, 0.0, &mut places, &mut []).expect("places");
        let first = [lengths[0] * q[0].sin(), 0.0, -lengths[0] * q[0].cos()];
        let second = [first[0] + lengths[1] * q[1].sin(), 0.0, first[2] - lengths[1] * q[1].cos()];
        assert_each_close("x¹", places[0].as_slice(), &first, Tol::ulps(1.0));
        assert_each_close_at_scales("x²", places[1].as_slice(), &second, &[lengths[0] + lengths[1]; 3], Tol::ulps(1.0));
        let cosine = (q[0] - q[1]).cos().abs() / 2.0_f64.sqrt();
        let expected = ((1.0 + cosine) / (1.0 - cosine)).sqrt();
        let found = independence(&system, &q, 0.0).expect("independent").condition_number;
        // ∂κ/∂c = κ/(1 − c²), at most 2κ.
        assert_each_close("κ", &[found], &[expected], Tol::ulps(32.0));
    }
}

/// Two particles on a line; the heavy one is carried along by the coordinate of the light one.
struct Carried {
    heavy: f64,
}

impl Holonomic for Carried {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        bodies.particle(self.heavy, Vector3::new(q[0] + q[1], T::zero(), T::zero()));
        bodies.particle(1.0, Vector3::new(q[1], T::zero(), T::zero()));
    }
}

/// W(3.4): g = [[M, M], [M, M + 1]], so that c = √(M/(M + 1)) and κ = √((1 + c)/(1 − c)) = (1 + c) √(M + 1), up to where
/// the smallest singular value is rounding, 64 · 6 ε of the largest.
#[test]
fn rank_is_lost_where_the_condition_number_reaches_rounding() {
    let mut compared = 0;
    for exponent in [0, 2, 4, 8, 12, 16, 20, 24] {
        let heavy = 10.0_f64.powi(exponent);
        let cosine = (heavy / (heavy + 1.0)).sqrt();
        let expected = (1.0 + cosine) * (heavy + 1.0).sqrt();
        let found = independence(&Carried { heavy }, &[0.1, 0.2], 0.0).expect("independent").condition_number;
        // The smallest singular value is off by some ε of the largest.
        assert_each_close(&format!("κ of M = 1e{exponent}"), &[found], &[expected], Tol::ulps(4.0).times(expected));
        compared += 1;
    }
    assert_eq!(compared, 8);
    // 2 √M against 1/(64 · 6 ε) = 1.2e13.
    let found = independence(&Carried { heavy: 1e27 }, &[0.1, 0.2], 0.0);
    assert_eq!(found, Err(KinematicsError::DependentCoordinates { coordinates: vec![0, 1], rank: 1 }));
}
