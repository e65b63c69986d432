//! Lagrange's top in closed form: against its reference, itself begun anew, the laws of conservation, and its equations.

use core::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Attitude, FreeRotation, HeavyTop, Inertia, KinematicsError};
use piola_testkit::strategies::{rotation, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use proptest::prelude::*;

fn quaternion(attitude: Attitude<f64>) -> [f64; 4] {
    [attitude.w, attitude.x, attitude.y, attitude.z]
}

fn case(of: &serde_json::Value) -> HeavyTop {
    let moments = golden::vector(&of["inertia"]);
    let inertia = Inertia::principal([moments[0], moments[1], moments[2]]).unwrap();
    let q = golden::vector(&of["attitude"]);
    let attitude = Attitude { w: q[0], x: q[1], y: q[2], z: q[3] }.normalise();
    let omega = Vector3::from_vec(golden::vector(&of["angular_velocity"]));
    HeavyTop::new(&inertia, Vector3::from_vec(golden::vector(&of["weight_times_arm"])), attitude, omega).unwrap()
}

fn compare(of: &serde_json::Value, name: &str, ulps: f64) -> usize {
    let motion = case(of);
    let states = of["states"].as_array().unwrap();
    for state in states {
        let t = golden::number(&state["t"]);
        let (attitude, omega) = motion.at(t);
        let expected = golden::vector(&state["attitude"]);
        let found = quaternion(attitude);
        let along: f64 = found.iter().zip(&expected).map(|(a, b)| a * b).sum();
        let found = found.map(|x| x * 1.0_f64.copysign(along));
        let sensitivity = state.get("sensitivity").map_or(1.0, |s| s.as_f64().unwrap());
        let tolerance = Tol::ulps(ulps).times(sensitivity.max(1.0));
        assert_close(&format!("{name}, attitude after {t}"), &found, &expected, tolerance);
        let expected = golden::vector(&state["angular_velocity"]);
        assert_close(&format!("{name}, ω after {t}"), omega.as_slice(), &expected, tolerance);
    }
    states.len()
}

#[test]
fn motions_follow_their_reference() {
    let golden = golden::load("symmetric_tops");
    let mut compared = 0;
    for of in &golden.cases {
        compared += compare(of, golden::text(&of["name"]), 64.0);
    }
    assert_eq!(compared, 48);
}

/// The axis of the test set's top passes 7e-7 rad from straight down every 0.75 s. The top turns by 300 rad, so that 2048 ulp are
/// seven of the angle.
#[test]
fn the_top_of_the_test_set_follows_its_reference() {
    let golden = golden::load("tops");
    let of = golden.cases.iter().find(|of| golden::text(&of["name"]) == "heavy top of the test set").unwrap();
    assert_eq!(compare(of, "test set", 2048.0), 4);
}

/// A body with the moments A, A, C whose axis is the third of a turned frame.
fn body(across: f64, along: f64, axes: Attitude<f64>) -> (Inertia, Vector3<f64>) {
    let frame: Matrix3<f64> = axes.to_matrix();
    let matrix = frame * Matrix3::from_diagonal(&Vector3::new(across, across, along)) * frame.transpose();
    (Inertia::new(0.5 * (matrix + matrix.transpose())).unwrap(), frame.column(2).into())
}

fn rotation_of(q: [f64; 4]) -> Attitude<f64> {
    Attitude::from_quaternion(q).unwrap()
}

/// The largest difference of two states, of which quaternions have no sign.
fn difference(a: &(Attitude<f64>, Vector3<f64>), b: &(Attitude<f64>, Vector3<f64>)) -> f64 {
    let turn = (a.0.to_matrix() - b.0.to_matrix()).amax();
    turn.max((a.1 - b.1).amax())
}

proptest! {
    /// A motion that is begun anew at any of its states goes on as before.
    #[test]
    fn motions_begun_anew_go_on(
        across in 0.5..2.0, ratio in 0.1..1.9, weight in 0.0..4.0, axes in rotation(), start in rotation(),
        omega in vector(3, -3.0..3.0), times in (0.0..4.0, -4.0..4.0),
    ) {
        let (inertia, axis) = body(across, ratio * across, rotation_of(axes));
        let start = (rotation_of(start), Vector3::from_column_slice(&omega));
        let motion = HeavyTop::new(&inertia, axis * weight, start.0, start.1).unwrap();
        let middle = motion.at(times.0);
        let anew = HeavyTop::new(&inertia, axis * weight, middle.0, middle.1).unwrap();
        let moved = Vector3::new(1e-9, -1e-9, 1e-9);
        let near = HeavyTop::new(&inertia, axis * weight, middle.0, middle.1 + moved).unwrap();
        let (expected, found) = (motion.at(times.0 + times.1), anew.at(times.1));
        let magnified = (difference(&found, &near.at(times.1)) * 1e9).max(1.0);
        prop_assert!(difference(&expected, &found) < 1e-13 * magnified, "{expected:?} {found:?} {magnified}");
        prop_assert!(difference(&start, &motion.at(0.0)) < 1e-14 * (1.0 + start.1.amax()), "{:?}", motion.at(0.0));
    }

    /// Energy and the angular momenta about the vertical and the axis are kept; attitude and ω belong together.
    #[test]
    fn motions_obey_their_equations(
        across in 0.5..2.0, ratio in 0.1..1.9, weight in 0.0..4.0, axes in rotation(), start in rotation(),
        omega in vector(3, -3.0..3.0), t in -20.0..20.0,
    ) {
        let (inertia, axis) = body(across, ratio * across, rotation_of(axes));
        let motion = HeavyTop::new(&inertia, axis * weight, rotation_of(start), Vector3::from_column_slice(&omega)).unwrap();
        let up = |attitude: Attitude<f64>| attitude.to_body(&Vector3::z());
        let kept = |(attitude, omega): (Attitude<f64>, Vector3<f64>)| {
            let spin = inertia.times(&omega);
            [0.5 * omega.dot(&spin) + weight * up(attitude).dot(&axis), spin.dot(&up(attitude)), spin.dot(&axis)]
        };
        let scale = 4.0 + 20.0 * across;
        let (before, now) = (kept((rotation_of(start), Vector3::from_column_slice(&omega))), motion.at(t));
        assert_close_at_scale("energy and momenta", &kept(now), &before, scale, Tol::ulps(64.0));
        // Differences of the fourth order over 2h; their rounding is some 1e-13.
        let h = 1e-3;
        let states = [-2.0, -1.0, 1.0, 2.0].map(|k| motion.at(t + k * h));
        let sign = |attitude: Attitude<f64>| {
            let (a, b) = (quaternion(attitude), quaternion(now.0));
            a.map(|x| x * 1.0_f64.copysign(a.iter().zip(&b).map(|(a, b)| a * b).sum()))
        };
        let rate = |values: [f64; 4]| (values[0] - 8.0 * values[1] + 8.0 * values[2] - values[3]) / (12.0 * h);
        let found = [0, 1, 2, 3].map(|i| rate(states.map(|state| sign(state.0)[i])));
        let bound = Tol::stated(1e-7, "differences of the fourth order");
        assert_close_at_scale("q̇", &found, &now.0.rate(&now.1), 8.0, bound);
        let spin = inertia.times(&now.1);
        let moment: Vector3<f64> = spin.cross(&now.1) + up(now.0).cross(&(axis * weight));
        let found = [0, 1, 2].map(|i| rate(states.map(|state| inertia.times(&state.1)[i])));
        assert_close_at_scale("J ω̇", &found, moment.as_slice(), 40.0, bound);
    }
}

/// Near the vertical, near steady precession and near the limit of the sleeping top the same holds.
#[test]
fn motions_near_their_special_cases_go_on() {
    let (inertia, weight) = (Inertia::principal([1.0, 1.0, 0.5]).unwrap(), Vector3::new(0.0, 0.0, 1.0));
    let mut compared = 0;
    for tilt in [0.0, 1e-12, 1e-6, 0.5, PI - 1e-6, PI] {
        for across in
            [[0.0, 0.0], [1e-12, 0.0], [0.0, 1e-6], [1e-3, 1e-3], [1.0, 0.0], [2.0, 1e-9], [2.0, 0.0], [1e-9, 3.0]]
        {
            for spin in [0.0, 1e-9, 1.0, -3.0, 4.0 - 1e-9, 4.0, 4.0 + 1e-9, 9.0] {
                let start = (Attitude::about_x(tilt), Vector3::new(across[0], across[1], spin));
                let motion = HeavyTop::new(&inertia, weight, start.0, start.1).unwrap();
                assert!(difference(&start, &motion.at(0.0)) < 1e-13, "{start:?}: {:?}", motion.at(0.0));
                for t in [0.25, 1.0, 2.5] {
                    let middle = motion.at(t);
                    let anew = HeavyTop::new(&inertia, weight, middle.0, middle.1).unwrap();
                    let near = HeavyTop::new(&inertia, weight, middle.0, middle.1 + Vector3::repeat(1e-9)).unwrap();
                    for more in [0.5, -t] {
                        let (expected, found) = (motion.at(t + more), anew.at(more));
                        let magnified = (difference(&found, &near.at(more)) * 1e9).max(1.0);
                        let error = difference(&expected, &found);
                        assert!(
                            error < 4e-13 * magnified,
                            "{start:?} after {t} and {more}: {expected:?} {found:?} {error:e}"
                        );
                        compared += 1;
                    }
                }
            }
        }
    }
    assert_eq!(compared, 2304);
}

/// The directions of q₀ + i q₃ and q₁ + i q₂, turned by the turns from those at the start, are those at t: both with one sign.
fn assert_turns_belong(motion: &HeavyTop, t: f64) {
    let halves = |t: f64| {
        let q = motion.at(t).0;
        [[q.w, q.z], [q.x, q.y]]
    };
    let (start, now, turns) = (halves(0.0), halves(t), motion.turns(t));
    let found = [0, 1].map(|i| {
        let (size, (sine, cosine)) = (now[i][0].hypot(now[i][1]) / start[i][0].hypot(start[i][1]), turns[i].sin_cos());
        let [re, im] = start[i];
        [size * (cosine * re - sine * im), size * (sine * re + cosine * im)]
    });
    let (found, now) = (found.as_flattened(), now.as_flattened());
    let sign = 1.0_f64.copysign(found.iter().zip(now).map(|(a, b)| a * b).sum());
    let now: Vec<f64> = now.iter().map(|x| sign * x).collect();
    let tolerance = Tol::ulps(256.0).times(1.0 + turns[0].abs() + turns[1].abs());
    assert_close_at_scale(&format!("turns after {t}"), found, &now, 1.0, tolerance);
}

/// Precession and own turn of tops that keep away from the vertical, counted in small steps.
#[test]
fn turns_are_those_counted_in_small_steps() {
    let (inertia, weight) = (Inertia::principal([1.0, 1.0, 0.5]).unwrap(), Vector3::new(0.0, 0.0, 1.0));
    for (tilt, omega) in
        [(0.5, [0.0, 0.0, 9.0]), (1.0, [0.3, -0.2, -7.0]), (2.5, [1.0, 0.9, 1.0]), (1.5, [0.5, 2.0, 0.0])]
    {
        let motion = HeavyTop::new(&inertia, weight, Attitude::about_x(tilt), omega.into()).unwrap();
        let angles = |t: f64| {
            let q = motion.at(t).0;
            [q.z.atan2(q.w), q.y.atan2(q.x)]
        };
        for direction in [1.0, -1.0] {
            let (mut before, mut counted) = (angles(0.0), [0.0; 2]);
            for step in 1..=4000 {
                let t = direction * 5e-3 * f64::from(step);
                let now = angles(t);
                for i in 0..2 {
                    // An attitude has two quaternions: angles are those but for π.
                    let change = now[i] - before[i];
                    counted[i] += change - PI * (change / PI).round();
                }
                before = now;
                if step % 500 == 0 {
                    let bound = Tol::stated(1e-11, "sums of 4000 angles");
                    assert_close("turns", &motion.turns(t), &counted, bound);
                    assert_turns_belong(&motion, t);
                }
            }
            assert!(3.0 < counted[0].abs().max(counted[1].abs()), "{counted:?}");
        }
    }
}

/// A body that moves in a vertical plane turns by jumps of π alone: the first where the arm points down, the second where it points up.
#[test]
fn turns_of_a_pendulum_count_its_passages_of_the_vertical() {
    let (inertia, weight) = (Inertia::principal([1.0, 1.0, 0.5]).unwrap(), Vector3::new(0.0, 0.0, 1.0));
    // Below 2 rad/s it swings, above it goes over the top.
    for (azimuth, tilt, rate, over) in [
        (0.0, 0.5, 0.0, false),
        (0.0, 2.0, 0.3, false),
        (0.0, 0.5, 2.5, true),
        (0.0, 3.0, -4.0, true),
        (0.7, 1.0, 3.0, true),
    ] {
        let start = Attitude::about_z(azimuth).product(Attitude::about_x(tilt));
        let motion = HeavyTop::new(&inertia, weight, start, Vector3::new(rate, 0.0, 0.0)).unwrap();
        let period = motion.period_of_nutation();
        for k in [1.0, 2.0, 3.0, 8.0, -1.0, -5.0] {
            let [down, up] = motion.turns(k * period);
            let expected = [PI * k, if over { PI * k } else { 0.0 }].map(f64::abs);
            assert_close("half turns", &[down.abs(), up.abs()], &expected, Tol::ulps(64.0));
        }
        for step in -300..300 {
            assert_turns_belong(&motion, 0.013 * f64::from(step) * period);
        }
    }
    // In the vertical itself at the start.
    let motion = HeavyTop::new(&inertia, weight, Attitude::about_x(PI), Vector3::new(1.0, 0.0, 0.0)).unwrap();
    let [down, up] = motion.turns(0.0);
    assert!(down.abs() + up.abs() <= 0.0, "{down} {up}");
    let down = motion.turns(0.25 * motion.period_of_nutation())[0].abs();
    assert!(down.min((down - PI).abs()) < 1e-14, "{down}");
}

/// Without weight it is free rotation.
#[test]
fn without_weight_it_turns_freely() {
    for (moments, omega) in [([1.0, 1.0, 1.5], [0.6, -0.8, 2.0]), ([0.5, 1.0, 1.0], [1.5, 0.25, 0.0])] {
        let inertia = Inertia::principal(moments).unwrap();
        let start = Attitude::from_quaternion([0.5, -0.5, 0.5, 0.5]).unwrap();
        let free = FreeRotation::new(&inertia, start, omega.into()).unwrap();
        let top = HeavyTop::new(&inertia, Vector3::zeros(), start, omega.into()).unwrap();
        for t in [0.0, 1.0, 17.0, -5.0] {
            assert!(difference(&free.at(t), &top.at(t)) < 1e-14 * (1.0 + 4.0 * t.abs()));
        }
    }
}

/// Steady precession: A cos θ φ̇² − L₃ φ̇ + P = 0; the nutation does not grow.
#[test]
fn steady_precession_stays_steady() {
    let (inertia, weight) = (Inertia::principal([1.0, 1.0, 0.5]).unwrap(), Vector3::new(0.0, 0.0, 1.0));
    let (tilt, precession) = (0.75_f64, 1.25_f64);
    let momentum = tilt.cos() * precession + 1.0 / precession;
    let omega = Vector3::new(0.0, precession * tilt.sin(), 2.0 * momentum);
    let motion = HeavyTop::new(&inertia, weight, Attitude::about_x(tilt), omega).unwrap();
    let [least, most] = motion.range_of_nutation();
    assert!(most - least < 1e-15 && (least - tilt.cos()).abs() < 1e-15, "{least} {most}");
    for t in [1.0, 10.0, -100.0] {
        let (attitude, _) = motion.at(t);
        let own = 2.0 * momentum - precession * tilt.cos();
        let expected =
            Attitude::about_z(precession * t).product(Attitude::about_x(tilt)).product(Attitude::about_z(own * t));
        let tolerance = Tol::ulps(64.0).times(1.0 + t.abs());
        assert_close("Q", attitude.to_matrix().as_slice(), expected.to_matrix().as_slice(), tolerance);
    }
}

#[test]
fn what_is_no_symmetric_top_is_refused() {
    let (start, omega) = (Attitude::identity(), Vector3::new(0.0, 0.0, 1.0));
    let inertia = Inertia::principal([1.0, 1.5, 2.0]).unwrap();
    let refused = HeavyTop::new(&inertia, Vector3::z(), start, omega);
    assert!(
        matches!(refused, Err(KinematicsError::NotSymmetricAbout { difference, .. }) if (difference - 0.25).abs() < 1e-15),
        "{refused:?}"
    );
    let inertia = Inertia::principal([1.0, 1.0, 1.5]).unwrap();
    let refused = HeavyTop::new(&inertia, Vector3::x(), start, omega);
    assert!(matches!(refused, Err(KinematicsError::NotSymmetricAbout { .. })), "{refused:?}");
    let none = Attitude { w: 0.0, x: 0.0, y: 0.0, z: 0.0 };
    let refused = HeavyTop::new(&inertia, Vector3::z(), none, omega);
    assert!(matches!(refused, Err(KinematicsError::NoDirection { quantity: "attitude", .. })), "{refused:?}");
    let refused = HeavyTop::new(&inertia, Vector3::new(0.0, f64::NAN, 1.0), start, omega);
    assert!(
        matches!(refused, Err(KinematicsError::NotFinite { quantity: "weight times arm", index: 1, .. })),
        "{refused:?}"
    );
}
