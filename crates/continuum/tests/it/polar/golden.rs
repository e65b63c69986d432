//! Reference values of U, V, R, their logarithms and the stretches, and the yardstick of the other tests.

use piola_continuum::polar::StretchAnalysis;
use piola_testkit::spectral::{PolarReference, Rows, polar_reference};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use serde_json::Value;

use super::cases::{analysis, flat, size};

fn cases() -> Vec<(String, Rows<f64>, Value)> {
    let case = |case: &Value| {
        let f = golden::matrix(&case["input"]["F"]);
        let f = core::array::from_fn(|i| core::array::from_fn(|j| f[i][j]));
        (golden::text(&case["id"]).to_owned(), f, case["output"].clone())
    };
    golden::load("strain").cases.iter().map(case).collect()
}

const NAMES: [&str; 7] = ["U", "V", "R", "lnU", "lnV", "principal_stretches", "log_principal_stretches"];

fn computed(name: &str, stretch: &StretchAnalysis) -> Vec<f64> {
    match name {
        "U" => flat(&stretch.right_stretch()),
        "V" => flat(&stretch.left_stretch()),
        "R" => stretch.rotation().concat(),
        "lnU" => flat(&stretch.hencky_material()),
        "lnV" => flat(&stretch.hencky_spatial()),
        "principal_stretches" => stretch.principal_stretches().to_vec(),
        _ => stretch.log_principal_stretches().to_vec(),
    }
}

fn referred(name: &str, reference: &PolarReference) -> Vec<f64> {
    match name {
        "U" => reference.right_stretch.concat(),
        "V" => reference.left_stretch.concat(),
        "R" => reference.rotation.concat(),
        "lnU" => reference.hencky_material.concat(),
        "lnV" => reference.hencky_spatial.concat(),
        "principal_stretches" => reference.stretches.to_vec(),
        _ => reference.log_stretches.to_vec(),
    }
}

fn expected(output: &Value, name: &str) -> Vec<f64> {
    if output[name][0].is_array() { golden::matrix(&output[name]).concat() } else { golden::vector(&output[name]) }
}

/// The condition number maxᵢ Σⱼ |∂fᵢ/∂xⱼ| |xⱼ| / maxᵢ |fᵢ| with steps of 2⁻⁴⁰, since a stretch of 1e-8 of the largest
/// would be lost beside longer ones; 31 digits leave enough of the differences.
fn condition(name: &str, f: &Rows<f64>) -> f64 {
    let step = 2.0_f64.powi(-40);
    let mut sums = [0.0; 9];
    for (i, j) in (0..9).map(|place| (place / 3, place % 3)) {
        let moved = |sign: f64| {
            let mut moved = *f;
            moved[i][j] *= 1.0 + sign * step;
            referred(name, &polar_reference(moved))
        };
        for (sum, (a, b)) in sums.iter_mut().zip(moved(1.0).iter().zip(moved(-1.0))) {
            *sum += (a - b).abs() / (2.0 * step);
        }
    }
    (size(&sums) / size(&referred(name, &polar_reference(*f)))).max(1.0)
}

/// Rotations, whose logarithms are rounding of F: judged absolutely.
fn is_rotation(id: &str) -> bool {
    ["identity", "pure_rotation_rounded", "coalescent_2_rotated"].contains(&id)
}

#[test]
fn stretches_rotations_and_logarithms_equal_reference_values() {
    for (id, f, output) in cases() {
        let stretch = analysis(f);
        for name in NAMES {
            let (actual, wanted) = (computed(name, &stretch), expected(&output, name));
            let what = format!("{id}: {name}");
            if is_rotation(&id) {
                let tol = Tol::stated(4e-16, "absolute, for rounded rotations").times(1.0);
                let scale = piola_testkit::relative_error(&wanted, &vec![0.0; wanted.len()]).max(1.0);
                assert_close_at_scale(&what, &actual, &wanted, scale, tol);
                continue;
            }
            let ordinary = Tol::ulps(8.0);
            let tol = if id.starts_with("stretch_ratio") {
                ordinary.times(condition(name, &f)).or(Tol::stated(1e-13, "listed extremes"))
            } else {
                ordinary
            };
            assert_close(&what, &actual, &wanted, tol);
        }
    }
}

/// 31 digits squared into C leave 15 at a stretch ratio of 1e8.
#[test]
fn the_yardstick_equals_reference_values() {
    for (id, f, output) in cases() {
        let reference = polar_reference(f);
        for name in NAMES {
            let (actual, wanted) = (referred(name, &reference), expected(&output, name));
            let scale = if is_rotation(&id) { 1e-16 } else { 0.0 };
            let tol = Tol::stated(4e-15, "the smallest stretch at a ratio of 1e8; elsewhere rounding");
            assert_close_at_scale(&format!("{id}: {name}"), &actual, &wanted, scale, tol);
        }
    }
}

#[test]
fn listed_extremes_are_within_their_stated_figures() {
    for (id, f, output) in cases() {
        let stretch = analysis(f);
        if id.starts_with("stretch_ratio") && id.ends_with("1e8") {
            let rotation = Tol::stated(1e-12, "R at a stretch ratio of 1e8");
            assert_close(&id, &computed("R", &stretch), &expected(&output, "R"), rotation);
            let logarithm = Tol::stated(1e-9, "ln U at a stretch ratio of 1e8: conditioned to 5e-10");
            assert_close(&id, &computed("lnU", &stretch), &expected(&output, "lnU"), logarithm);
        }
    }
}
