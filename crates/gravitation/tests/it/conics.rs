//! Motion about a centre in universal variables, against the classical anomalies in 60 digits.

use piola_gravitation::kepler::advance;
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use proptest::prelude::*;

fn triple(value: &serde_json::Value) -> [f64; 3] {
    golden::vector(value).try_into().expect("three components")
}

fn length(x: [f64; 3]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Position and velocity after a time.
fn moved<T: Real>(gm: T, x: [T; 3], v: [T; 3], t: T) -> [T; 6] {
    let by = advance(gm, x, v, t);
    [0, 1, 2, 3, 4, 5].map(|i| if i < 3 { x[i] + by.position[i] } else { v[i - 3] + by.velocity[i - 3] })
}

/// How much the end changes when the start changes by its own size: by differences of the reference's own start.
fn condition(gm: f64, x: [f64; 3], v: [f64; 3], t: f64) -> [f64; 2] {
    let (radius, speed) = (length(x), length(v));
    let mut found = [0.0_f64; 2];
    for input in 0..8 {
        let seed = |own: usize, value: f64| Dual::new(value, if own == input { 1.0 } else { 0.0 });
        let size = match input {
            0..3 => radius,
            3..6 => speed,
            6 => t.abs(),
            _ => gm,
        };
        let place = [0, 1, 2].map(|i| seed(i, x[i]));
        let velocity = [0, 1, 2].map(|i| seed(i + 3, v[i]));
        let end = moved(seed(7, gm), place, velocity, seed(6, t));
        for (half, found) in found.iter_mut().enumerate() {
            *found += size * length([0, 1, 2].map(|i| end[3 * half + i].tangent));
        }
    }
    found
}

#[test]
fn every_conic_is_followed_to_its_condition() {
    let golden = golden::load("conics");
    let mut compared = 0;
    for case in &golden.cases {
        let (x, v) = (triple(&case["position"]), triple(&case["velocity"]));
        let gm = golden::number(&case["mu"]);
        for state in case["states"].as_array().expect("states") {
            let t = golden::number(&state["t"]);
            let expected = golden::vector(&state["state"]);
            let found = moved(gm, x, v, t);
            let what = format!("{} after {t}", golden::text(&case["name"]));
            let [of_place, of_velocity] = condition(gm, x, v, t);
            assert_close_at_scale(&format!("x of {what}"), &found[..3], &expected[..3], of_place, Tol::ulps(8.0));
            assert_close_at_scale(&format!("v of {what}"), &found[3..], &expected[3..], of_velocity, Tol::ulps(32.0));
            compared += 1;
        }
    }
    assert_eq!(compared, 45);
}

/// The lanes hold an ellipse, a parabola, a hyperbola and a body far from its start: each as it is alone.
#[test]
fn bodies_in_lanes_move_as_they_do_alone() {
    let bodies = [
        (1.0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.25]),
        (1.0, [0.5, 0.0, 0.0], [0.0, 2.0, 0.0]),
        (2.0, [1.0, 0.5, 0.0], [0.5, 3.0, 0.25]),
        (1.0, [0.0, 0.0, 0.25], [0.5, 0.0, 0.0]),
    ];
    for t in [0.01, 0.3, -4.0] {
        let alone = bodies.map(|(gm, x, v)| moved(gm, x, v, t));
        let lanes = |of: &dyn Fn(usize) -> f64| Lanes::<f64, 4>::from([0, 1, 2, 3].map(of));
        let x = [0, 1, 2].map(|i| lanes(&|lane| bodies[lane].1[i]));
        let v = [0, 1, 2].map(|i| lanes(&|lane| bodies[lane].2[i]));
        let together = moved(lanes(&|lane| bodies[lane].0), x, v, Lanes::splat(t));
        for (lane, alone) in alone.iter().enumerate() {
            let found = together.map(|component| component.0[lane]);
            // The others may make it take another way to the same root.
            assert_close(&format!("lane {lane} after {t}"), &found, alone, Tol::ulps(256.0));
        }
    }
}

/// ∂x/∂v of a circle after a time t: x = f x₀ + g v₀ differentiated by hand with Clohessy and Wiltshire's solution:
/// a push w along the track gives −6w(nt − sin nt…)… in the rotating frame.
#[test]
fn derivative_by_the_velocity_of_a_circle_is_that_of_clohessy_and_wiltshire() {
    for t in [0.25_f64, 2.0, 9.0] {
        let velocity = [Dual::lit(0.0), Dual::variable(1.0), Dual::lit(0.0)];
        let end = moved(Dual::lit(1.0), [1.0, 0.0, 0.0].map(Dual::lit), velocity, Dual::lit(t));
        // Radially 2(1 − cos t), along the track 4 sin t − 3t: then turned by t.
        let (radial, along) = (2.0 * (1.0 - t.cos()), 4.0 * t.sin() - 3.0 * t);
        let expected = [radial * t.cos() - along * t.sin(), radial * t.sin() + along * t.cos(), 0.0];
        assert_close("∂x/∂v", &[0, 1, 2].map(|i| end[i].tangent), &expected, Tol::ulps(64.0));
    }
}

#[test]
fn what_is_not_finite_or_at_the_centre_is_no_number() {
    let x = [1.0, 0.0, 0.0];
    assert!(advance(1.0, [0.0; 3], x, 1.0).position.iter().any(|x: &f64| !x.is_finite()));
    assert!(advance(1.0, x, [f64::NAN, 0.0, 0.0], 1.0).position.iter().all(|x: &f64| x.is_nan()));
    assert!(advance(1.0, x, x, f64::INFINITY).position.iter().any(|x: &f64| !x.is_finite()));
    assert!(advance(1.0, x, x, 0.0).position.iter().all(|&x| x == 0.0));
}

proptest! {
    /// Two halves are the whole, and the way back leads to the start.
    #[test]
    fn motion_is_a_group(
        x in piola_testkit::strategies::unit_vector(), v in prop::array::uniform3(-2.0_f64..2.0), t in -5.0_f64..5.0,
    ) {
        let moment = [x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]];
        // Near the centre nothing is left of the digits of the start.
        prop_assume!(0.3 < length(moment));
        let whole = moved(1.0, x, v, t);
        let half = |state: [f64; 6], t| moved(1.0, [state[0], state[1], state[2]], [state[3], state[4], state[5]], t);
        let start = [x[0], x[1], x[2], v[0], v[1], v[2]];
        let scale = length([whole[0], whole[1], whole[2]]) + 1.0;
        assert_close_at_scale("two halves", &half(half(start, 0.5 * t), 0.5 * t), &whole, scale, Tol::ulps(4096.0));
        assert_close_at_scale("back", &half(whole, -t), &start, scale, Tol::ulps(4096.0));
    }
}
