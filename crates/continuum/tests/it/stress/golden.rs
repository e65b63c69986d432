//! Reference values of stress measures, tractions, areas and invariants.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{CauchyStress, Deformation, DeformationGradient, ReferenceNormal, UnitNormal};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use serde_json::Value;

use super::cases::{nine, size};

/// A stress, a deformation and normals, and what is known of them.
struct Case {
    id: String,
    stress: CauchyStress,
    deformation: DeformationGradient,
    normal: UnitNormal,
    reference_normal: ReferenceNormal,
    output: Value,
}

fn rows(value: &Value) -> Vec<f64> {
    golden::matrix(value).concat()
}

fn cases() -> Vec<Case> {
    let vector = |value: &Value| Vector3::from_column_slice(&golden::vector(value));
    let case = |case: &Value| {
        let input = &case["input"];
        let matrix = |name: &str| Matrix3::from_row_slice(&rows(&input[name]));
        Case {
            id: golden::text(&case["id"]).to_owned(),
            stress: CauchyStress::from_matrix(&matrix("T")).expect("symmetric"),
            deformation: DeformationGradient::new(matrix("F")).expect("0 < det F"),
            normal: UnitNormal::new(vector(&input["n_dir"])).expect("a direction"),
            reference_normal: ReferenceNormal::new(vector(&input["N_dir"])).expect("a direction"),
            output: case["output"].clone(),
        }
    };
    golden::load("stress").cases.iter().map(case).collect()
}

/// Ordinary inputs and listed extremes alike, norm-wise: no extreme needs its condition number.
const TOLERANCE: Tol = Tol::ulps(8.0);

impl Case {
    fn expected(&self, name: &str) -> Option<Vec<f64>> {
        match &self.output[name] {
            Value::Null => None,
            value @ Value::Array(list) if list[0].is_array() => Some(rows(value)),
            value @ Value::Array(_) => Some(golden::vector(value)),
            value => Some(vec![golden::number(value)]),
        }
    }

    fn assert(&self, name: &str, actual: &[f64]) {
        let expected = self.expected(name).unwrap_or_else(|| panic!("{}: no {name}", self.id));
        assert_close(&format!("{}: {name}", self.id), actual, &expected, TOLERANCE);
    }
}

fn flat(matrix: &Matrix3<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

#[test]
fn measures_of_stress_equal_reference() {
    for case in cases() {
        let (t, f) = (&case.stress, &case.deformation);
        let (p, s, kirchhoff) = (t.first_piola(f), t.second_piola(f), t.kirchhoff(f));
        case.assert("J", &[f.jacobian()]);
        case.assert("P", &flat(&p.0));
        case.assert("S", &nine(&s.0));
        case.assert("kirchhoff", &nine(&kirchhoff.0));
        // By the other ways, at the tolerance of two conversions.
        let other = |name: &str, actual: &[f64]| {
            let expected = case.expected(name).expect(name);
            let condition = size(&flat(f.matrix())) * size(&flat(&f.matrix().try_inverse().expect("regular")));
            let what = format!("{}: {name} by another way", case.id);
            assert_close(&what, actual, &expected, TOLERANCE.times(condition.max(1.0)));
        };
        other("S", &nine(&p.second_piola(f).0));
        other("S", &nine(&kirchhoff.second_piola(f).0));
        other("P", &flat(&s.first_piola(f).0));
        other("P", &flat(&kirchhoff.first_piola(f).0));
        other("kirchhoff", &nine(&s.kirchhoff(f).0));
        other("kirchhoff", &nine(&p.kirchhoff(f).0));
    }
}

/// Of the largest component: J T F⁻ᵀ and two more products; the rotation of Biot's is known to some ulp.
const PRODUCTS: Tol = Tol::ulps(8.0);

#[test]
fn every_measure_of_a_stress_equals_reference() {
    let cases = golden::load("stress_measures").cases;
    for case in &cases {
        let matrix = |name: &str| Matrix3::from_row_slice(&rows(&case["input"][name]));
        let t = CauchyStress::from_matrix(&matrix("T")).expect("symmetric");
        let f = &DeformationGradient::new(matrix("F")).expect("0 < det F");
        let close = |by: &str, name: &str, actual: &[f64]| {
            let what = format!("{}: {name} by {by}", golden::text(&case["id"]));
            assert_close(&what, actual, &rows(&case["output"][name]), PRODUCTS);
        };
        let (kirchhoff, p, s) = (t.kirchhoff(f), t.first_piola(f), t.second_piola(f));
        close("Cauchy", "kirchhoff", &nine(&kirchhoff.0));
        close("Cauchy", "first_piola", &flat(&p.0));
        close("Cauchy", "second_piola", &nine(&s.0));
        for (by, mandel, biot) in [
            ("Cauchy", t.mandel(f), t.biot(f)),
            ("Kirchhoff", kirchhoff.mandel(f), kirchhoff.biot(f)),
            ("first Piola", p.mandel(f), p.biot(f)),
            ("second Piola", s.mandel(f), s.biot(f)),
        ] {
            close(by, "mandel", &flat(&mandel.0));
            close(by, "biot", &flat(&biot.0));
            close(by, "biot_symmetric", &nine(&biot.symmetric_part()));
        }
    }
    assert_eq!(cases.len(), 5);
}

#[test]
fn tractions_equal_reference() {
    for case in cases() {
        let (t, n) = (&case.stress, &case.normal);
        let traction = t.traction(n);
        case.assert("traction", traction.as_slice());
        case.assert("normal_traction", &[t.normal_traction(n)]);
        case.assert("nominal_traction", t.first_piola(&case.deformation).traction(&case.reference_normal).as_slice());
        let expected = case.expected("shear_traction").expect("given");
        // Where the normal is a principal direction there is no shear, only the rounding of n.
        let scale = if size(&expected) < 1e-50 { size(&nine(&t.deviator().0)) } else { 0.0 };
        let what = format!("{}: shear", case.id);
        assert_close_at_scale(&what, t.shear_traction(n).as_slice(), &expected, scale, TOLERANCE);
        assert_close_at_scale(&what, &[t.shear_traction_size(n)], &[norm(&expected)], scale, TOLERANCE);
    }
}

fn norm(vector: &[f64]) -> f64 {
    let size = size(vector);
    if size == 0.0 { 0.0 } else { size * vector.iter().map(|x| (x / size).powi(2)).sum::<f64>().sqrt() }
}

#[test]
fn deformed_areas_equal_reference() {
    for case in cases() {
        let area = case.reference_normal.deformed(&case.deformation);
        case.assert("nanson_area_vector", area.vector.as_slice());
        case.assert("area_ratio", &[area.ratio]);
        case.assert("deformed_normal", &area.normal.components());
    }
}

#[test]
fn invariants_of_stress_equal_reference() {
    for case in cases() {
        let t = &case.stress;
        case.assert("mean_stress", &[t.mean()]);
        case.assert("mean_stress", &[-t.pressure()]);
        case.assert("hydrostatic_part", &nine(&t.hydrostatic_part().0));
        case.assert("deviator", &nine(&t.deviator().0));
        case.assert("von_mises", &[t.von_mises()]);
        case.assert("octahedral_shear", &[t.octahedral_shear()]);
        case.assert("max_shear", &[t.maximum_shear()]);
        case.assert("max_shear", &[0.5 * t.tresca()]);
        // Squares of 1e149 are beyond the range of numbers: not given there.
        if case.id != "big_scale" {
            case.assert("J2", &[t.j2()]);
            case.assert("J3", &[t.j3()]);
        }
    }
}

#[test]
fn von_mises_keeps_its_digits_under_pressure_and_at_any_scale() {
    for case in cases() {
        let expected = case.expected("von_mises").expect("given");
        if ["pressure_1e9", "hydrostatic_plus_tiny", "big_scale"].contains(&case.id.as_str()) {
            assert_close(&case.id, &[case.stress.von_mises()], &expected, Tol::ulps(1.0));
        }
        if case.id.starts_with("random") {
            // |T| ~ 1e-160, 1e-300 and 1e150: powers of two change no digit of the reference.
            for exponent in [-531, -996, 498] {
                let factor = 2.0_f64.powi(exponent);
                let what = format!("{} times 2^{exponent}", case.id);
                let table = Tol::stated(1e-15, "table of reachable accuracies");
                assert_close(&what, &[(case.stress * factor).von_mises()], &[expected[0] * factor], table);
                let shear = case.expected("max_shear").expect("given")[0] * factor;
                assert_close(&what, &[(case.stress * factor).maximum_shear()], &[shear], TOLERANCE);
            }
        }
    }
}

#[test]
fn principal_stresses_and_projectors_equal_reference() {
    let mut projected = 0;
    for case in cases() {
        let principal = case.stress.principal();
        case.assert("principal_stresses", &principal.values());
        case.assert("max_shear", &[principal.maximum_shear()]);
        case.assert("max_shear", &[principal.mohr_circles()[0].radius]);
        let Value::Array(expected) = &case.output["principal_projectors"] else { continue };
        projected += 1;
        let [d1, d2, d3] = principal.deviatoric;
        // A direction turns by the relative change of the stress over the relative gap.
        let gap = |k: usize| [d1 - d2, (d1 - d2).min(d2 - d3), d2 - d3][k] / d1.max(-d3);
        for (k, projector) in principal.projectors().iter().enumerate() {
            let what = format!("{}: projector {k}", case.id);
            assert_close(&what, &nine(projector), &rows(&expected[k]), TOLERANCE.times(1.0 / gap(k)));
        }
    }
    // Of equal principal stresses there are no projectors.
    assert_eq!(projected, 10);
}
