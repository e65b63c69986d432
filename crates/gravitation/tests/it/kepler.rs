//! The closed form of elliptic motion against values of 30 digits.

use piola_gravitation::kepler::{Elements, KeplerMotion};
use piola_testkit::{Tol, assert_close_at_scale, golden};
use proptest::prelude::*;

#[test]
fn position_equals_golden_trajectory() {
    let golden = golden::load("trajectories");
    let mut seen = 0;
    for case in golden.cases.iter().filter(|case| golden::text(&case["system"]) == "kepler") {
        let start = golden::vector(&case["initial_state"]);
        let gm = golden::number(&case["parameters"]["mu"]);
        let motion = KeplerMotion::new(gm, [start[0], start[1], 0.0], [start[2], start[3], 0.0])
            .unwrap_or_else(|error| panic!("{error}"));
        for state in case["states"].as_array().into_iter().flatten() {
            let expected = golden::vector(&state["state"]);
            let position = motion.position(golden::number(&state["t"]));
            // The condition of a position at the pericentre is its speed there over the mean speed.
            let tolerance = Tol::ulps(8.0).times((1.0 + motion.eccentricity()) / (1.0 - motion.eccentricity()));
            assert_close_at_scale("position", &position[..2], &expected[..2], motion.semi_major_axis(), tolerance);
            // An ulp of the mean anomaly changes the velocity at the pericentre by n a/(1 − e)².
            let (_, velocity) = motion.state(golden::number(&state["t"]));
            let mean_speed = core::f64::consts::TAU * motion.semi_major_axis() / motion.period();
            let tolerance = Tol::ulps(8.0).times(1.0 / (1.0 - motion.eccentricity()).powi(2));
            assert_close_at_scale("velocity", &velocity[..2], &expected[2..], mean_speed, tolerance);
            seen += 1;
        }
    }
    assert!(0 < seen);
}

/// Every invariant of the reference, and the eccentric anomaly of every state.
#[test]
fn elements_equal_the_invariants_of_the_golden_trajectory() {
    let golden = golden::load("trajectories");
    let mut seen = 0;
    for case in golden.cases.iter().filter(|case| golden::text(&case["system"]) == "kepler") {
        let (start, gm) = (golden::vector(&case["initial_state"]), golden::number(&case["parameters"]["mu"]));
        let invariant = |name: &str| golden::number(&case["invariants"][name]);
        let motion = KeplerMotion::new(gm, [start[0], start[1], 0.0], [start[2], start[3], 0.0])
            .unwrap_or_else(|error| panic!("{error}"));
        let (a, e) = (motion.semi_major_axis(), motion.eccentricity());
        let condition = (1.0 + e) / (1.0 - e);
        let check = |what: &str, found: f64, size: f64| {
            assert_close_at_scale(what, &[found], &[invariant(what)], size, Tol::ulps(4.0).times(condition));
        };
        check("semi_major_axis", a, a);
        check("eccentricity", e, 1.0);
        check("period", motion.period(), motion.period());
        check("energy", -0.5 * gm / a, 0.5 * gm / a);
        check("angular_momentum", (gm * a * (1.0 - e * e)).sqrt(), (gm * a).sqrt());
        let (argument, anomaly) = (invariant("argument_of_pericentre"), invariant("mean_anomaly_at_0"));
        let towards = golden::vector(&case["invariants"]["eccentricity_vector"]);
        let expected = [e * argument.cos(), e * argument.sin()];
        assert_close_at_scale("eccentricity_vector", &expected, &towards, 1.0, Tol::ulps(4.0).times(condition));
        let elements = Elements {
            semi_major_axis: a,
            eccentricity: e,
            inclination: 0.0,
            ascending_node: 0.0,
            argument_of_pericentre: argument,
            mean_anomaly: anomaly,
        };
        let (position, velocity) = elements.state(gm);
        let tolerance = Tol::ulps(4.0).times(condition);
        assert_close_at_scale("the start", &position[..2], &start[..2], a, tolerance);
        assert_close_at_scale("its velocity", &velocity[..2], &start[2..], velocity[0].hypot(velocity[1]), tolerance);
        for state in case["states"].as_array().into_iter().flatten() {
            let (sine, cosine) = golden::number(&state["E_anomaly"]).sin_cos();
            let (along, across) = (a * (cosine - e), a * (1.0 - e * e).sqrt() * sine);
            let (s, c) = argument.sin_cos();
            let expected = [c * along - s * across, s * along + c * across];
            let position = motion.position(golden::number(&state["t"]));
            assert_close_at_scale("position of E", &position[..2], &expected, a, tolerance.times(2.0));
            seen += 1;
        }
    }
    assert_eq!(seen, 12);
}

#[test]
fn position_after_a_thousand_periods_equals_the_first_one() {
    let motion =
        KeplerMotion::new(1.0, [0.01, 0.0, 0.0], [0.0, 199.0_f64.sqrt(), 0.0]).unwrap_or_else(|e| panic!("{e}"));
    let position = motion.position(1000.0 * motion.period());
    // Half an ulp of the period, a thousand times, at the speed of the pericentre.
    let rounding = 1000.0 * motion.period() * 0.5 * f64::EPSILON * 2.0 * 199.0_f64.sqrt();
    assert_close_at_scale(
        "position",
        &position,
        &[0.01, 0.0, 0.0],
        1.0,
        Tol::stated(rounding, "rounding of 1000 periods"),
    );
}

proptest! {
    #[test]
    fn state_of_elements_has_these_elements(
        a in 0.1_f64..10.0, e in 0.0_f64..0.999, angles in proptest::array::uniform4(-3.0_f64..3.0), gm in 0.1_f64..10.0,
    ) {
        let [inclination, ascending_node, argument_of_pericentre, mean_anomaly] = angles;
        let elements = Elements {
            semi_major_axis: a, eccentricity: e, inclination, ascending_node, argument_of_pericentre, mean_anomaly,
        };
        let (position, velocity) = elements.state(gm);
        let motion = KeplerMotion::new(gm, position, velocity).unwrap_or_else(|error| panic!("{error}"));
        let condition = (1.0 + e) / (1.0 - e);
        assert_close_at_scale("a", &[motion.semi_major_axis()], &[a], a, Tol::ulps(64.0).times(condition));
        assert_close_at_scale("e", &[motion.eccentricity()], &[e], 1.0, Tol::ulps(64.0).times(condition));
        let start = motion.position(0.0);
        assert_close_at_scale("x", &start, &position, a, Tol::ulps(8.0));
        let later = 0.37 * motion.period();
        let advanced = Elements { mean_anomaly: mean_anomaly + 0.37 * core::f64::consts::TAU, ..elements };
        let (expected, _) = advanced.state(gm);
        assert_close_at_scale("x(t)", &motion.position(later), &expected, a, Tol::ulps(256.0).times(condition));
    }
}
