//! Giesekus' fluid and networks of Phan-Thien and Tanner: `testdata/golden/differential_fluids.json`.

use piola_fluids::{
    AnyFluid, ExponentialPhanThienTanner, Giesekus, LinearPhanThienTanner, ShearStresses, SimpleFluid, ViscometricFluid,
};
use piola_numerics::Dual;
use piola_testkit::golden::{load, number, text};
use piola_testkit::{Tol, assert_close, assert_each_close};
use serde_json::Value;

/// Closed forms of some ten operations.
const CLOSED: Tol = Tol::ulps(16.0);
/// The error allowed in one step. In a strong flow a fading memory forgets the error of earlier steps.
const STEP: f64 = 1e-12;
const FOLLOWED: Tol = Tol::stated(STEP, "tolerance of each step");

fn cases(kind: &str) -> Vec<Value> {
    load("differential_fluids").cases.into_iter().filter(|case| text(&case["kind"]) == kind).collect()
}

fn fluid(case: &Value) -> AnyFluid {
    let (solvent, polymer, time, parameter) = (0.125, 2.0, 0.5, number(&case["parameter"]));
    let fluid = match text(&case["fluid"]) {
        "giesekus" => Giesekus::new(solvent, polymer, time, parameter).map(AnyFluid::from),
        "linear" => LinearPhanThienTanner::new(solvent, polymer, time, parameter).map(AnyFluid::from),
        "exponential" => ExponentialPhanThienTanner::new(solvent, polymer, time, parameter).map(AnyFluid::from),
        other => unreachable!("{other}"),
    };
    fluid.expect("parameters within bounds")
}

/// T₁₂, N₁, N₂.
fn expected(case: &Value) -> [f64; 3] {
    ["T12", "N1", "N2"].map(|name| number(&case["output"][name]))
}

#[test]
fn viscometric_functions_of_nonlinear_fluids_equal_references() {
    let mut count = 0;
    for case in cases("steady") {
        let (what, fluid, k) = (text(&case["id"]), fluid(&case), number(&case["input"]["k"]));
        let [shear, first, second] = expected(&case);
        let functions = |k: f64| {
            [fluid.shear_stress(k), fluid.first_normal_stress_difference(k), fluid.second_normal_stress_difference(k)]
        };
        assert_each_close(what, &functions(k), &[shear, first, second], CLOSED);
        assert_each_close(what, &functions(-k), &[-shear, first, second], CLOSED);
        // σ₁ = T₁₁ − T₃₃, σ₂ = T₂₂ − T₃₃ of T₃₃ = 0; of T₁₁ + N₁ in slow flow the first is the small one.
        assert_each_close(what, &[fluid.sigma1(k), fluid.sigma2(k)], &[second, first + second], CLOSED);
        assert_each_close(what, &[fluid.viscosity(k)], &[shear / k], CLOSED);
        let slope = k * fluid.shear_stress(Dual::variable(k)).tangent / shear;
        let tolerance = Tol::ulps(32.0).times(slope.recip().max(1.0));
        assert_close(what, &[fluid.shear_rate(shear).expect("a rate")], &[k], tolerance);
        count += 1;
    }
    assert_eq!(count, 5 * 6);
}

/// The answers to a start or a stop, each stress beside itself: T₁₂ ≈ 1 of one case, N₂ ≈ 1e-4.
fn followed(kind: &str, answer: impl Fn(&AnyFluid, f64, f64) -> ShearStresses) -> usize {
    let cases = cases(kind);
    for case in &cases {
        let input = |name: &str| number(&case["input"][name]);
        let found = answer(&fluid(case), input("k"), input("t"));
        let [shear, first, second] = expected(case);
        assert_each_close(text(&case["id"]), &[found.shear, found.first], &[shear, first], FOLLOWED);
        // Of N₂ the steps are controlled beside the modulus ηₚ/λ = 4.
        assert_close(text(&case["id"]), &[found.second, 4.0], &[second, 4.0], FOLLOWED);
    }
    cases.len()
}

#[test]
fn stresses_after_the_start_of_shear_equal_references() {
    let count = followed("start", |fluid, k, t| fluid.response_to_start(k, t, STEP).expect("runs"));
    assert_eq!(count, 4 * 2 * 4);
}

#[test]
fn stresses_after_the_stop_of_shear_equal_references() {
    let count = followed("stop", |fluid, k, t| fluid.response_to_stop(k, t, STEP).expect("runs"));
    assert_eq!(count, 4 * 2 * 2);
}
