//! Reference energies, stresses and tangents of every law.

use piola_continuum::{DeformationGradient, Symmetric};
use piola_solids::{Compressible, NeoHookeanLogarithmic, SaintVenantKirchhoff, isochoric, volumetric};
use piola_solids::{Hencky, Hyperelastic, IsochoricOgden, MooneyRivlin, Ogden, OgdenTerm};
use piola_tensor::PairSymmetric;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use serde_json::Value;

use super::once::Once;

const STRESS: Tol = Tol::stated(1e-13, "stresses of ordinary and of small strains");
/// Small strains: stresses of a neo-Hookean solid, and energies of every law.
const NEO_HOOKEAN: Tol = Tol::stated(2e-16, "B − 1 and J − 1 from ∇u");
const ENERGY: Tol = Tol::stated(1e-15, "I₁ − 3 − 2 (J − 1) without cancellation");
const TANGENT: Tol = Tol::stated(1e-12, "tangents");

fn parameter(case: &Value, name: &str) -> f64 {
    golden::number(&case["params"][name])
}

fn nine(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().as_flattened().to_vec()
}

/// Checks all cases of a model against the law that `law` makes of the case's parameters.
fn check<L: Hyperelastic>(model: &str, law: impl Fn(&Value) -> L) {
    let golden = golden::load("hyperelastic");
    let cases: Vec<&Value> = golden.cases.iter().filter(|case| golden::text(&case["model"]) == model).collect();
    assert!(10 < cases.len(), "{model}: {} cases", cases.len());
    for case in cases {
        let id = golden::text(&case["id"]);
        let law = law(case);
        let law = Once(&law);
        let rows = golden::matrix(&case["input"]["F"]);
        let rows = core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]));
        let f = DeformationGradient::from_rows(rows).expect("0 < det F");
        let output = &case["output"];
        let expected = |name: &str| golden::matrix(&output[name]).concat();
        let tangent = law.first_piola_tangent(&f);
        let entries = tangent.0.components.as_flattened();
        // A stress that is zero is rounding of the moduli.
        let moduli = entries.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let rest = if id.contains("/identity") { moduli * 1e-3 } else { 0.0 };
        let stress = |what: &str, name: &str, actual: &[f64]| {
            assert_close_at_scale(&format!("{id}: {what}"), actual, &expected(name), rest, STRESS);
        };
        stress("P", "P", law.first_piola(&f).0.transpose().as_slice());
        stress("S", "S", &nine(&law.second_piola(&f).0));
        stress("T", "T", &nine(&law.cauchy(&f).0));
        let energy = law.energy(&f);
        if id.contains("near_identity") {
            // What is reachable at small strains, as the reference values' table has it.
            let (cauchy, whole) = (nine(&law.cauchy(&f).0), golden::number(&output["W_minus_Wref"]));
            let digits = if model.starts_with("neo_hookean") { NEO_HOOKEAN } else { Tol::ulps(8.0) };
            assert_close(&format!("{id}: T of a small strain"), &cauchy, &expected("T"), digits);
            assert_close(&format!("{id}: W − W(1) of a small strain"), &[energy], &[whole], ENERGY);
        }
        let change = golden::number(&output["W_minus_Wref"]);
        assert_close_at_scale(&format!("{id}: W − W(1)"), &[energy], &[change], rest, STRESS);
        let whole = golden::number(&output["W"]);
        assert_close_at_scale(&format!("{id}: W"), &[energy + law.reference_energy()], &[whole], rest, STRESS);
        assert_close(&format!("{id}: dP/dF"), entries, &expected("dP_dF"), TANGENT);
        let material = law.material_tangent(&f).0.slots();
        assert_close(&format!("{id}: dS/dE"), material.as_flattened(), &expected("dS_dE"), TANGENT);
        let (shared, both) = law.first_piola_and_tangent(&f);
        // Together they share what apart each rounds for itself.
        stress("P together", "P", shared.0.transpose().as_slice());
        let both = both.0.components;
        assert_close(&format!("{id}: dP/dF together"), both.as_flattened(), &expected("dP_dF"), TANGENT);
        // Whether the reference is free of stress, as the file says.
        let rest = law.reference_stress().norm();
        let free = case["reference_stress_free"].as_bool().expect("a flag");
        assert_eq!(rest <= 16.0 * f64::EPSILON * moduli, free, "{id}: the reference has {rest:e} Pa");
    }
}

#[test]
fn compressible_mooney_rivlin_equals_reference() {
    check("mooney_rivlin_compressible", |case| {
        let [c10, c01, c, d] = ["c10", "c01", "c", "d"].map(|name| parameter(case, name));
        MooneyRivlin::new(c10, c01, c, d).expect("parameters")
    });
}

fn ogden_terms(case: &Value) -> Vec<OgdenTerm> {
    let list = |name: &str| golden::vector(&case["params"][name]);
    list("mu").into_iter().zip(list("alpha")).map(|(mu, alpha)| OgdenTerm { modulus: mu, exponent: alpha }).collect()
}

#[test]
fn ogden_with_logarithm_equals_reference() {
    check("ogden_log", |case| Ogden::new(&ogden_terms(case), parameter(case, "lambda")).expect("parameters"));
}

#[test]
fn isochoric_ogden_equals_reference() {
    check("ogden_isochoric", |case| {
        IsochoricOgden::new(&ogden_terms(case), parameter(case, "kappa")).expect("parameters")
    });
}

#[test]
fn hencky_equals_reference() {
    check("hencky", |case| Hencky::new(parameter(case, "lambda"), parameter(case, "mu")).expect("parameters"));
}

#[test]
fn saint_venant_kirchhoff_equals_reference() {
    check("saint_venant_kirchhoff", |case| {
        SaintVenantKirchhoff::new(parameter(case, "lambda"), parameter(case, "mu")).expect("parameters")
    });
}

#[test]
fn neo_hookean_with_logarithm_equals_reference() {
    check("neo_hookean_log", |case| {
        NeoHookeanLogarithmic::with_constants(parameter(case, "mu"), parameter(case, "lambda")).expect("parameters")
    });
}

#[test]
fn isochoric_neo_hookean_equals_reference() {
    check("neo_hookean_isochoric", |case| {
        Compressible::new(
            isochoric::NeoHookean::new(parameter(case, "mu")).expect("parameters"),
            volumetric::Quadratic::new(parameter(case, "kappa")).expect("parameters"),
        )
    });
}
