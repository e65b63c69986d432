//! Reference values of rates, exponentials and relative deformations.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_continuum::rates::{
    ExponentialMotion, GradientRate, HomogeneousMotion, LinearMotion, RelativeDeformation, StretchRates,
    VelocityGradient, exponential, exponential_minus_identity, strain,
};
use piola_testkit::{Tol, assert_close, condition_number, golden};
use serde_json::Value;

/// Inputs that are no extremes: 8 ulp of the result's own norm.
const ORDINARY: Tol = Tol::ulps(8.0);

fn rows(value: &Value) -> Vec<f64> {
    golden::matrix(value).concat()
}

fn flat(matrix: &Matrix3<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// One output of a case of `kind: rates` from the 18 numbers F and Ḟ.
fn rate(name: &str, x: &[f64]) -> Vec<f64> {
    let f = DeformationGradient::new(Matrix3::from_row_slice(&x[..9])).expect("0 < det F");
    let fdot = GradientRate::new(Matrix3::from_row_slice(&x[9..])).expect("finite");
    let l = VelocityGradient::of(&f, &fdot);
    let stretch = StretchRates::of(&f, &fdot);
    match name {
        "L" => flat(&l.0),
        "D" => flat(&l.rate_of_deformation().matrix()),
        "spin" => flat(&l.spin().matrix()),
        "Cdot" => flat(&strain::right_cauchy_green_rate(&f, &fdot).matrix()),
        "Edot" => flat(&strain::green_rate(&f, &fdot).matrix()),
        "Jdot" => vec![strain::jacobian_rate(&f, &fdot)],
        "Udot" => flat(&stretch.right_stretch().matrix()),
        "Rdot" => flat(&stretch.rotation()),
        "RtRdot" => flat(&stretch.material_spin().matrix()),
        "lnU_dot" => flat(&stretch.hencky_material().matrix()),
        other => panic!("{other}: not an output of rates"),
    }
}

/// The listed extremes: max(1e-13, 8 ulp × condition number).
fn extreme(f: impl Fn(&[f64]) -> Vec<f64>, x: &[f64]) -> Tol {
    let floor = Tol::stated(1e-13, "what is asked of extremes");
    floor.or(ORDINARY.times(condition_number(f, x)))
}

#[test]
fn rates_of_kinematic_measures_equal_reference() {
    let mut compared = 0;
    for case in golden::load("rates").cases.iter().filter(|case| case["kind"] == "rates") {
        let id = golden::text(&case["id"]);
        let input = [rows(&case["input"]["F"]), rows(&case["input"]["Fdot"])].concat();
        for (name, expected) in case["output"].as_object().expect("outputs") {
            let expected = if expected.is_array() { rows(expected) } else { vec![golden::number(expected)] };
            // Every other case, coalescent, nearly so or near the identity, holds as if it were ordinary.
            let tolerance = match (id, name.as_str()) {
                ("ratio_1e6", "Jdot") => extreme(|x| rate("Jdot", x), &input),
                _ => ORDINARY,
            };
            assert_close(&format!("{id}: {name}"), &rate(name, &input), &expected, tolerance);
            compared += 1;
        }
    }
    assert_eq!(compared, 170);
}

#[test]
fn exponentials_equal_reference() {
    let of = |name: &str, x: &[f64]| {
        let k = Matrix3::from_row_slice(x);
        flat(&if name == "exp_Kt" { exponential(&k) } else { exponential_minus_identity(&k) }.expect("finite"))
    };
    let mut compared = 0;
    for case in golden::load("rates").cases.iter().filter(|case| case["kind"] == "exp") {
        let id = golden::text(&case["id"]);
        let k = Matrix3::from_row_slice(&rows(&case["input"]["K"]));
        let t = golden::number(&case["input"]["t"]);
        let input = flat(&(k * t));
        for (name, expected) in case["output"].as_object().expect("outputs") {
            let tolerance = if id == "stiff" { extreme(|x| of(name, x), &input) } else { ORDINARY };
            assert_close(&format!("{id}: {name}"), &of(name, &input), &rows(expected), tolerance);
            compared += 1;
        }
        let motion = ExponentialMotion::new(k, Matrix3::identity()).expect("finite");
        let tolerance = if id == "stiff" { extreme(|x| of("exp_Kt", x), &input) } else { ORDINARY };
        let gradient = motion.gradient(t);
        assert_close(&format!("{id}: as a motion"), &flat(&gradient), &rows(&case["output"]["exp_Kt"]), tolerance);
    }
    assert_eq!(compared, 22);
}

#[test]
fn relative_deformations_equal_reference() {
    let mut compared = 0;
    for case in golden::load("rates").cases.iter().filter(|case| case["kind"] == "relative") {
        let id = golden::text(&case["id"]);
        let matrix = |name: &str| Matrix3::from_row_slice(&rows(&case["input"][name]));
        let (f0, a) = (matrix("F0"), matrix("A"));
        let t = golden::number(&case["input"]["t"]);
        for entry in case["output"]["history"].as_array().expect("a list") {
            let s = golden::number(&entry["s"]);
            let (by_motion, now, then) = if id == "linear_motion" {
                both_ways(&LinearMotion::new(f0, a).expect("0 < det F"), t, s)
            } else {
                both_ways(&ExponentialMotion::new(a, f0).expect("0 < det F"), t, s)
            };
            let condition = now.matrix().norm() * now.matrix().try_inverse().expect("regular").norm();
            let of_two = RelativeDeformation::of(&now, &then).expect("0 < det F");
            let ways = [("", by_motion, ORDINARY), (", of two gradients", of_two, ORDINARY.times(condition))];
            for (way, relative, tolerance) in ways {
                let assert = |name: &str, actual: &[f64]| {
                    assert_close(&format!("{id}, s = {s}: {name}{way}"), actual, &rows(&entry[name]), tolerance);
                };
                assert("F_t", &flat(&relative.gradient()));
                assert("C_t", &flat(&relative.right_cauchy_green().matrix()));
                assert("C_t_inv", &flat(&relative.inverse_right_cauchy_green().matrix()));
                compared += 3;
            }
        }
    }
    assert_eq!(compared, 48);
}

/// Fₜ(t − s) of a motion, and F(t) and F(t − s).
fn both_ways(
    motion: &impl HomogeneousMotion,
    t: f64,
    s: f64,
) -> (RelativeDeformation, DeformationGradient, DeformationGradient) {
    let at = |time| motion.deformation(time).expect("0 < det F");
    (motion.relative(t, -s).expect("0 < det F"), at(t), at(t - s))
}
