//! Bodies on a plane against closed forms and against Newton's and Euler's laws with the force of contact.

use nalgebra::{Matrix3, Vector3};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_kinematics::Attitude;
use piola_lagrangian::Holonomic;
use piola_lagrangian::anholonomic::AnholonomicFrame;
use piola_lagrangian::anholonomic::rolling::{KnifeEdge, OnPlane, RollingDisc, RollingSphere};
use piola_numerics::{Lanes, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

use crate::systems::body;

/// What an integration at a relative tolerance of 10⁻¹³ leaves after some hundred steps.
fn integrated() -> Tol {
    Tol::stated(1e-11, "hundred times the tolerance of a step")
}

fn run<S: Holonomic + AnholonomicFrame>(system: &OnPlane<S>, q: &[f64], w: &[f64], end: f64) -> (Vec<f64>, Vec<f64>) {
    let mut state = State::new(0.0, [q, w].concat()).unwrap();
    let mut method = DormandPrince853::new(Tolerance::relative(1e-13).unwrap());
    method.integrate_to(&mut system.motion(q.len()), &mut state, end).unwrap();
    let (q, w) = state.values.split_at(q.len());
    (q.to_vec(), w.to_vec())
}

/// The directions of a disc: down its steepest line, along the track, its axis.
fn directions(theta: [f64; 3]) -> [Vector3<f64>; 3] {
    let ((s1, c1), (s2, c2)) = (theta[0].sin_cos(), theta[1].sin_cos());
    [Vector3::new(c2 * c1, c2 * s1, -s2), Vector3::new(-s1, c1, 0.0), Vector3::new(s2 * c1, s2 * s1, c2)]
}

fn three(values: &[f64]) -> Vector3<f64> {
    Vector3::new(values[0], values[1], values[2])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn disc_equals_newton_and_euler_with_contact_force(
        place in strategies::vector(5, -1.0..1.0),
        w in strategies::vector(3, -4.0..4.0),
        gravity in strategies::vector(3, -10.0..10.0),
        thickness in 1.1..1.9_f64,
    ) {
        let (mass, radius, across) = (1.5, 0.75, 0.3);
        let disc = RollingDisc::new(body(mass, [across, across, across * thickness]), radius).unwrap();
        let system = disc.on_plane([gravity[0], gravity[1], gravity[2]]);
        let q = [place[0], place[1], 3.0 * place[2], 1.5 + place[3], 3.0 * place[4]];
        let theta = [q[2], q[3], q[4]];
        let [down, track, axis] = directions(theta);
        let up = Vector3::z();
        let turning = up * w[0] + track * w[1]; // of the three directions
        let omega = turning + axis * w[2];

        // The contact's material point has no velocity.
        let v = system.velocities(&q, &w, 0.0).unwrap();
        let arm = down * radius;
        let arm_rate = turning.cross(&arm);
        let centre_velocity = Vector3::new(v[0], v[1], 0.0) - arm_rate;
        let contact_velocity = centre_velocity + omega.cross(&arm);
        let scale = radius * omega.norm();
        assert_close_at_scale("contact velocity", contact_velocity.as_slice(), &[0.0; 3], scale, Tol::ulps(8.0));

        // M (a − g) = F, I α + ω×Iω = r×F, a = −α×r − ω×ṙ: one equation for α.
        let project = |n: Vector3<f64>| n * n.transpose();
        let inertia = Matrix3::identity() * across + project(axis) * (across * (thickness - 1.0));
        let pull = three(&gravity);
        let matrix = inertia + (Matrix3::identity() * radius * radius - project(arm)) * mass;
        let moment = -omega.cross(&(inertia * omega)) - arm.cross(&(omega.cross(&arm_rate) + pull)) * mass;
        let alpha = matrix.lu().solve(&moment).unwrap();
        let force = (-alpha.cross(&arm) - omega.cross(&arm_rate) - pull) * mass;

        let rates = system.acceleration(&q, &w, 0.0).unwrap();
        let found = up * rates[0] + track * rates[1] + axis * rates[2]
            + up.cross(&track) * (w[0] * w[1]) + turning.cross(&axis) * w[2];
        let tolerance = Tol::stated(1e-12, "angles with sin θ² down to 0.4, inertias in proportion 1 : 5");
        assert_close_at_scale("α", found.as_slice(), alpha.as_slice(), 10.0 + alpha.norm(), tolerance);
        let contact = system.part_reactions(&q, &w, 0.0).unwrap()[0];
        let scale = 10.0 + force.norm();
        assert_close_at_scale("contact force", contact.force().as_slice(), force.as_slice(), scale, tolerance);
        // It acts at the contact, and its friction is what holds the slip at zero.
        let about_contact = contact.moment_about(&Vector3::new(q[0], q[1], 0.0));
        assert_close_at_scale("moment about the contact", about_contact.as_slice(), &[0.0; 3], scale, tolerance);
        let friction = system.reactions(&q, &w, 0.0).unwrap();
        let across_track = up.cross(&track) * -1.0;
        let expected = [force.dot(&track), force.dot(&across_track)];
        assert_close_at_scale("friction", friction.as_slice(), &expected, scale, tolerance);
    }

    #[test]
    fn sphere_equals_newton_and_euler_with_contact_force(
        place in strategies::vector(2, -2.0..2.0),
        quaternion in strategies::rotation(),
        w in strategies::vector(3, -4.0..4.0),
        gravity in strategies::vector(3, -10.0..10.0),
        rate in -3.0..3.0_f64,
        length in 0.5..2.0_f64,
    ) {
        let (mass, radius, moments) = (1.5, 0.75, [0.3, 0.35, 0.4]);
        let sphere = RollingSphere::new(body(mass, moments), radius).unwrap().on_turntable(rate).unwrap();
        let system = sphere.on_plane([gravity[0], gravity[1], gravity[2]]);
        // The length of the quaternion plays no role.
        let q: Vec<f64> = place.iter().copied().chain(quaternion.iter().map(|x| x * length)).collect();
        let [a, b, c, d] = quaternion;
        let to_space = Attitude { w: a, x: b, y: c, z: d }.to_matrix().transpose(); // v_body = Q v_space
        let inertia = to_space * Matrix3::from_diagonal(&three(&moments)) * to_space.transpose();
        let (omega, up, pull) = (three(&w), Vector3::z(), three(&gravity));
        let velocity = omega.cross(&up) * radius + up.cross(&Vector3::new(place[0], place[1], 0.0)) * rate;
        let v = system.velocities(&q, &w, 0.0).unwrap();
        assert_close_at_scale("velocity", &v.as_slice()[..2], &velocity.as_slice()[..2], 1.0, Tol::ulps(8.0));

        let arm = up * -radius;
        let carried = up.cross(&velocity) * rate;
        let matrix = inertia + (Matrix3::identity() - up * up.transpose()) * (mass * radius * radius);
        let moment = -omega.cross(&(inertia * omega)) + arm.cross(&(carried - pull)) * mass;
        let alpha = matrix.lu().solve(&moment).unwrap();
        let force = (alpha.cross(&up) * radius + carried - pull) * mass;
        let tolerance = Tol::stated(1e-12, "sums of some dozens of terms");
        let rates = system.acceleration(&q, &w, 0.0).unwrap();
        assert_close_at_scale("α", rates.as_slice(), alpha.as_slice(), 10.0 + alpha.norm(), tolerance);
        let contact = system.part_reactions(&q, &w, 0.0).unwrap()[0];
        let scale = 10.0 + force.norm();
        assert_close_at_scale("contact force", contact.force().as_slice(), force.as_slice(), scale, tolerance);
        let about_contact = contact.moment_about(&Vector3::new(q[0], q[1], 0.0));
        assert_close_at_scale("moment about the contact", about_contact.as_slice(), &[0.0; 3], scale, tolerance);
    }

    #[test]
    fn disc_turns_steadily_with_its_steady_spin(
        inclination in 0.4..2.7_f64,
        turn in 0.5..4.0_f64,
        hoop in any::<bool>(),
    ) {
        let disc = if hoop { RollingDisc::hoop(2.0, 0.5) } else { RollingDisc::homogeneous(2.0, 0.5) }.unwrap();
        let spin = disc.steady_spin(inclination, turn, 9.8).unwrap();
        let system = disc.on_plane([0.0, 0.0, -9.8]);
        let (q, w) = ([0.0, 0.0, 0.0, inclination, 0.0], [turn, 0.0, spin]);
        let rates = system.acceleration(&q, &w, 0.0).unwrap();
        let scale = 10.0 + spin * spin + turn * turn;
        assert_close_at_scale("rates", rates.as_slice(), &[0.0; 3], scale, Tol::ulps(256.0));
        // Friction bends the path of the centre: M R Ω (θ̇³ + Ω cos θ²) across the track, none along it.
        let friction = system.reactions(&q, &w, 0.0).unwrap();
        let expected = [0.0, 2.0 * 0.5 * turn * (spin + turn * inclination.cos())];
        assert_close_at_scale("friction", friction.as_slice(), &expected, 2.0 * scale, Tol::ulps(256.0));
    }
}

#[test]
fn steadily_turning_disc_draws_a_circle() {
    let disc = RollingDisc::homogeneous(2.0, 0.5).unwrap();
    let (inclination, turn) = (1.2_f64, 2.0);
    let spin = disc.steady_spin(inclination, turn, 9.8).unwrap();
    let system = disc.on_plane([0.0, 0.0, -9.8]);
    let end = 0.4;
    let (q, w) = run(&system, &[0.0, 0.0, 0.0, inclination, 0.0], &[turn, 0.0, spin], end);
    // ẋ = R θ̇³ sin Ωt, ẏ = −R θ̇³ cos Ωt
    let (s, c) = (turn * end).sin_cos();
    let radius = 0.5 * spin / turn;
    let expected = [radius * (1.0 - c), -radius * s, turn * end, inclination, spin * end];
    assert_close("coordinates", &q, &expected, integrated());
    assert_close("rates", &w, &[turn, 0.0, spin], integrated());
}

#[test]
fn energy_of_rolling_disc_is_conserved() {
    let system = RollingDisc::homogeneous(2.0, 0.5).unwrap().on_plane([0.0, 0.0, -9.8]);
    let (q, w) = ([0.0, 0.0, 0.3, 1.2, 0.0], [0.5, 0.25, 6.0]);
    let before = system.energies(&q, &w, 0.0).unwrap().total();
    let (q, w) = run(&system, &q, &w, 10.0);
    let after = system.energies(&q, &w, 0.0).unwrap().total();
    assert_close("energy", &[after], &[before], integrated());
}

#[test]
fn sphere_on_turntable_runs_on_a_circle_with_two_sevenths_of_its_rate() {
    let rate = 3.5;
    let sphere = RollingSphere::homogeneous(1.0, 0.25).unwrap().on_turntable(rate).unwrap();
    let system = sphere.on_plane([0.0, 0.0, -9.8]);
    let (start, w) = (RollingSphere::coordinates(1.0, 0.5), [2.0, -1.0, 0.5]);
    let v = system.velocities(&start, &w, 0.0).unwrap();
    let (v, n) = ([v[0], v[1]], 2.0 / 7.0 * rate);
    for end in [0.5, 2.0, 2.0 * core::f64::consts::PI / n] {
        let (q, _) = run(&system, &start, &w, end);
        let (s, c) = (n * end).sin_cos();
        let expected = [1.0 + (v[0] * s - v[1] * (1.0 - c)) / n, 0.5 + (v[1] * s + v[0] * (1.0 - c)) / n];
        assert_close(&format!("centre after {end} s"), &q[..2], &expected, integrated());
    }
}

#[test]
fn sphere_on_incline_has_five_sevenths_of_the_pull() {
    let system = RollingSphere::homogeneous(3.0, 0.25).unwrap().on_plane([6.0, 0.0, -8.0]);
    let (q, w) = run(&system, &RollingSphere::coordinates(0.0, 0.0), &[0.0; 3], 2.0);
    let speed = 5.0 / 7.0 * 6.0 * 2.0;
    assert_close("distance", &q[..2], &[speed, 0.0], integrated()); // ½ a t² = a t at t = 2
    assert_close("rates", &w, &[0.0, speed / 0.25, 0.0], integrated());
}

#[test]
fn blade_on_incline_draws_a_cycloid() {
    let (mass, pull, turn, end) = (2.0, 3.0, 1.5, 4.0);
    let system = KnifeEdge::new(mass, 0.5, 0.0).unwrap().on_plane([pull, 0.0, -9.0]);
    let (q, w) = run(&system, &[0.0; 3], &[0.0, turn], end);
    let angle: f64 = turn * end;
    let radius = pull / (2.0 * turn * turn);
    let expected = [radius * angle.sin().powi(2), radius * (angle - angle.sin() * angle.cos()), angle];
    assert_close("coordinates", &q, &expected, integrated());
    assert_close("rates", &w, &[pull / turn * angle.sin(), turn], integrated());
    let reaction = system.reactions(&q, &w, end).unwrap();
    assert_close("reaction", reaction.as_slice(), &[2.0 * mass * pull * angle.sin()], integrated());
}

#[test]
fn chaplygin_sleigh_follows_its_hyperbolic_functions() {
    let (mass, moment, ahead) = (2.0_f64, 0.5, 0.375);
    let system = KnifeEdge::new(mass, moment, ahead).unwrap().on_plane([0.0, 0.0, -9.8]);
    // v̇ = a φ̇², v² + φ̇²/k² = v∞², k² = M/(J + M a²)
    let k = (mass / (moment + mass * ahead * ahead)).sqrt();
    let (start, terminal) = (-1.0_f64, 2.0);
    let at = |t: f64| {
        let phase = (start / terminal).atanh() + ahead * k * k * terminal * t;
        [terminal * phase.tanh(), k * terminal / phase.cosh()]
    };
    for end in [0.5, 1.0, 3.0] {
        let (_, w) = run(&system, &[0.0, 0.0, 0.25], &at(0.0), end);
        assert_close(&format!("after {end} s"), &w, &at(end), integrated());
    }
}

#[test]
fn discs_in_lanes_equal_discs_one_by_one() {
    let system = RollingDisc::homogeneous(2.0, 0.5).unwrap().on_plane([0.5, 0.0, -9.8]);
    let place = |lane: usize| [0.0, 0.5, 0.25, 1.0 + 0.125 * lane as f64, 0.75];
    let rates = |lane: usize| [0.5 * lane as f64, -0.25, 6.0];
    let q: [Lanes<f64, 4>; 5] = core::array::from_fn(|i| Lanes(core::array::from_fn(|lane| place(lane)[i])));
    let w: [Lanes<f64, 4>; 3] = core::array::from_fn(|i| Lanes(core::array::from_fn(|lane| rates(lane)[i])));
    let all = system.acceleration(&q, &w, Real::lit(0.0)).unwrap();
    for lane in 0..4 {
        let found: Vec<f64> = all.iter().map(|x| x.primal(lane)).collect();
        let expected = system.acceleration(&place(lane), &rates(lane), 0.0).unwrap();
        assert_close("rates", &found, expected.as_slice(), Tol::ulps(64.0));
    }
}
