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
            seen += 1;
        }
    }
    assert!(0 < seen);
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
