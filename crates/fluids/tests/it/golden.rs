//! Golden values of viscometric functions and of flows through closed moments.

use core::f64::consts::PI;

use piola_fluids::{AnyFluid, Bingham, CarreauYasuda, FlowMoment, Newtonian, OldroydB, PowerLaw, ViscometricFluid};
use piola_testkit::golden::{load, number, text};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use serde_json::Value;

/// A power and some products; moments are sums of several.
const FUNCTIONS: Tol = Tol::ulps(4.0);
const CLOSED: Tol = Tol::ulps(32.0);

/// The fluid of a case of `viscometric`.
fn fluid(case: &Value) -> AnyFluid {
    let of = |name: &str| number(&case["params"][name]);
    let fluid = match text(&case["fluid"]) {
        "newtonian" => Newtonian::new(of("mu")).map(AnyFluid::from),
        "power_law" => PowerLaw::new(of("K"), of("n")).map(AnyFluid::from),
        "bingham" => Bingham::new(of("tau_y"), of("mu")).map(AnyFluid::from),
        "carreau_yasuda" => {
            CarreauYasuda::new(of("eta0"), of("eta_inf"), of("lam"), of("n"), of("a")).map(AnyFluid::from)
        }
        "oldroyd_b" => OldroydB::new(of("eta_s"), of("eta_p"), of("lam")).map(AnyFluid::from),
        other => unreachable!("{other}"),
    };
    fluid.expect("golden parameters are within bounds")
}

#[test]
fn viscometric_functions_equal_golden() {
    let (mut count, mut elastic) = (0, 0);
    for case in load("viscometric").cases.iter().filter(|case| text(&case["geometry"]) == "plane_couette") {
        let fluid = fluid(case);
        for state in case["output"]["states"].as_array().expect("states") {
            let k = number(&state["kappa"]);
            let of = |name: &str| [number(&state[name])];
            let what = |name: &str| format!("{} at {k}: {name}", text(&case["id"]));
            assert_close(&what("T12"), &[fluid.shear_stress(k)], &of("T12"), FUNCTIONS);
            assert_close(&what("viscosity"), &[fluid.viscosity(k)], &of("viscosity"), FUNCTIONS);
            assert_close(&what("odd"), &[-fluid.shear_stress(-k)], &of("T12"), FUNCTIONS);
            for k in [k, -k] {
                assert_close(&what("sigma1"), &[fluid.sigma1(k)], &of("sigma1"), FUNCTIONS);
                assert_close(&what("sigma2"), &[fluid.sigma2(k)], &of("sigma2"), FUNCTIONS);
            }
            assert_close(&what("N1"), &[fluid.first_normal_stress_difference(k)], &of("N1"), FUNCTIONS);
            assert_close(&what("N2"), &[fluid.second_normal_stress_difference(k)], &of("N2"), FUNCTIONS);
            count += 1;
            elastic += usize::from(0.0 < number(&state["N1"]));
        }
    }
    // Of nine fluids; one, Oldroyd's, has normal stresses.
    assert_eq!((count, elastic), (9 * 6, 6));
}

#[test]
fn closed_moments_equal_golden_discharges_and_speed_differences() {
    let mut count = 0;
    for case in &load("viscometric").cases {
        let fluid = fluid(case);
        let (input, output) = (&case["input"], &case["output"]);
        let of = |name: &str| number(&input[name]);
        let (closed, name) = match text(&case["geometry"]) {
            "channel" => {
                let c = of("c");
                (fluid.flow_moment(FlowMoment::First, 0.0, c * of("d")).map(|m| 2.0 / (c * c) * m), "Q_per_width")
            }
            "poiseuille" => {
                let c = 2.0 / of("c");
                (fluid.flow_moment(FlowMoment::Second, 0.0, of("R0") / c).map(|m| PI * c * c * c * m), "Q")
            }
            "couette" => {
                let wall = |radius: &str| of("M") / (2.0 * PI * of(radius) * of(radius));
                let m = fluid.flow_moment(FlowMoment::Reciprocal, wall("R2"), wall("R1"));
                (m.map(|m| m / 2.0), "delta_omega")
            }
            _ => continue,
        };
        if let Some(closed) = closed {
            // A moment knows the wall stress to an ulp; close to yield that is what the discharge knows.
            let wall = output.get("tau_wall").or(output.get("tau_inner")).map_or(1.0, number);
            let excess = wall - fluid.yield_stress();
            let narrow = input.get("R2").map_or(1.0, |r2| number(r2) / (number(r2) - of("R1")));
            let condition = if 0.0 < excess { 3.0 * wall / excess } else { 1.0 };
            let tolerance = CLOSED.or(Tol::ulps(8.0).times(condition.max(narrow)));
            assert_close_at_scale(text(&case["id"]), &[closed], &[number(&output[name])], 0.0, tolerance);
            count += 1;
        }
    }
    assert_eq!(count, 32);
}
