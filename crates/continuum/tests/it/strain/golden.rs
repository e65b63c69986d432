//! Reference values of every measure of strain, of both constructors.
//!
//! The condition number of a quantity is that of its reference in doubled precision, with respect to the entries of F.

use piola_continuum::strain::{
    AlmansiStrain, GreenStrain, LeftCauchyGreen, LinearStrain, RightCauchyGreen, invariants,
};
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient, Symmetric};
use piola_numerics::Real;
use piola_testkit::spectral::polar_reference;
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale, condition_number_by_steps, golden};
use serde_json::Value;

use super::cases::{analysis, hencky, left_stretch, polar_rotation, right_stretch, spatial_hencky};

type Rows = [[f64; 3]; 3];

/// Every quantity of the reference file.
const QUANTITIES: [&str; 17] = [
    "J",
    "C",
    "B",
    "U",
    "V",
    "R",
    "E",
    "e",
    "lnU",
    "lnV",
    "linear_strain",
    "invariants",
    "J_minus_1",
    "I1_minus_3",
    "I2_minus_3",
    "principal_stretches",
    "log_principal_stretches",
];

struct Case {
    id: String,
    f: Rows,
    output: Value,
}

fn rows(value: &Value) -> Rows {
    let rows = golden::matrix(value);
    core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]))
}

fn cases() -> Vec<Case> {
    let case = |case: &Value| Case {
        id: golden::text(&case["id"]).to_owned(),
        f: rows(&case["input"]["F"]),
        output: case["output"].clone(),
    };
    let cases: Vec<Case> = golden::load("strain").cases.iter().map(case).collect();
    for case in &cases {
        let Value::Object(output) = &case.output else { panic!("{}: no object", case.id) };
        assert!(output.keys().all(|key| QUANTITIES.contains(&key.as_str())), "{}: a quantity is not tested", case.id);
        assert_eq!(output.len(), QUANTITIES.len(), "{}: a quantity is missing", case.id);
    }
    cases
}

impl Case {
    fn expected(&self, quantity: &str) -> Vec<f64> {
        match &self.output[quantity] {
            value @ Value::Array(list) if list[0].is_array() => golden::matrix(value).concat(),
            value @ Value::Array(_) => golden::vector(value),
            value => vec![golden::number(value)],
        }
    }

    /// ∇u where F − 1 is exact.
    fn displacement(&self) -> Option<DisplacementGradient> {
        let mut h = self.f;
        for (i, row) in h.iter_mut().enumerate() {
            row[i] -= 1.0;
        }
        let exact = self.f.iter().enumerate().all(|(i, row)| (h[i][i] + 1.0).to_bits() == row[i].to_bits())
            && (0..3).all(|i| (self.f[i][i] - h[i][i]).to_bits() == 1.0_f64.to_bits());
        exact.then(|| DisplacementGradient::from_rows(h).expect("0 < det F"))
    }

    fn gradient(&self) -> DeformationGradient {
        DeformationGradient::from_rows(self.f).expect("0 < det F")
    }

    fn is(&self, kind: &str) -> bool {
        self.id.starts_with(kind)
    }
}

fn nine(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().as_flattened().to_vec()
}

/// What Piola computes.
fn computed(quantity: &str, f: &impl Deformation<f64>) -> Vec<f64> {
    match quantity {
        "J" => vec![f.jacobian()],
        "C" => nine(&RightCauchyGreen::of(f).0),
        "B" => nine(&LeftCauchyGreen::of(f).0),
        "U" => nine(&right_stretch(f)),
        "V" => nine(&left_stretch(f)),
        "R" => polar_rotation(f).rows().as_flattened().to_vec(),
        "E" => nine(&GreenStrain::of(f).0),
        "e" => nine(&AlmansiStrain::of(f).0),
        "lnU" => nine(&hencky(f)),
        "lnV" => nine(&spatial_hencky(f)),
        "linear_strain" => nine(&LinearStrain::of(f).0),
        "invariants" => vec![invariants::first(f), invariants::second(f), invariants::third(f)],
        "J_minus_1" => vec![f.volume_change()],
        "I1_minus_3" => vec![invariants::first_minus_three(f)],
        "I2_minus_3" => vec![invariants::second_minus_three(f)],
        "principal_stretches" => analysis(f).principal_stretches().to_vec(),
        "log_principal_stretches" => analysis(f).log_principal_stretches().to_vec(),
        _ => panic!("no quantity {quantity}"),
    }
}

/// By how much relative errors of the entries of F are magnified in a quantity, from 31 digits.
fn condition(quantity: &str, f: &Rows) -> f64 {
    let reference = |x: &[f64]| -> Vec<f64> {
        let f: Rows = core::array::from_fn(|i| core::array::from_fn(|j| x[3 * i + j]));
        let polar = polar_reference(f);
        match quantity {
            "U" => polar.right_stretch.as_flattened().to_vec(),
            "V" => polar.left_stretch.as_flattened().to_vec(),
            "R" => polar.rotation.as_flattened().to_vec(),
            "lnU" => polar.hencky_material.as_flattened().to_vec(),
            "lnV" => polar.hencky_spatial.as_flattened().to_vec(),
            "principal_stretches" => polar.stretches.to_vec(),
            "log_principal_stretches" => polar.log_stretches.to_vec(),
            _ => {
                let lifted = f.map(|row| row.map(<DoubleDouble as Real>::lit));
                let f = DeformationGradient::from_rows(lifted).expect("0 < det F");
                match quantity {
                    "e" => AlmansiStrain::of(&f).rows().as_flattened().iter().map(|x| x.primal(0)).collect(),
                    _ => vec![1.0],
                }
            }
        }
    };
    condition_number_by_steps(2.0_f64.powi(-44), reference, f.as_flattened())
}

const ORDINARY: Tol = Tol::ulps(8.0);
const EXTREME: Tol = Tol::stated(1e-13, "the specification of listed extremes");
/// What the reference values' own table states for a ratio of 10⁸, where it is tighter than the condition number.
const REACHED: [(&str, Tol); 3] = [
    ("R", Tol::stated(1e-12, "stretch ratio 1e8")),
    ("lnU", Tol::stated(1e-9, "stretch ratio 1e8, whose conditioning alone gives 5e-10")),
    ("lnV", Tol::stated(1e-9, "stretch ratio 1e8, whose conditioning alone gives 5e-10")),
];

fn tolerance(case: &Case, quantity: &str) -> Tol {
    if !case.is("stretch_ratio") {
        return ORDINARY;
    }
    let conditioned = EXTREME.or(ORDINARY.times(condition(quantity, &case.f)));
    match REACHED.iter().find(|(name, _)| *name == quantity) {
        Some((_, reached)) if reached.value() < conditioned.value() => *reached,
        _ => conditioned,
    }
}

/// Of a rotation rounded to doubles, whose strains are as small as the rounding.
fn check_rotation(case: &Case, quantity: &str, actual: &[f64], expected: &[f64]) {
    let absolute = Tol::stated(4e-16, "absolute, of a rounded rotation");
    assert_close_at_scale(&format!("{}: {quantity}", case.id), actual, expected, 1.0, absolute);
}

#[test]
fn measures_of_the_deformation_gradient_equal_reference() {
    for case in cases() {
        let f = case.gradient();
        for quantity in QUANTITIES {
            let (actual, expected) = (computed(quantity, &f), case.expected(quantity));
            if case.is("pure_rotation") {
                check_rotation(&case, quantity, &actual, &expected);
            } else {
                assert_close(&format!("{}: {quantity}", case.id), &actual, &expected, tolerance(&case, quantity));
            }
        }
    }
}

#[test]
fn measures_of_the_displacement_gradient_equal_reference() {
    let mut exact = 0;
    for case in cases() {
        let Some(displacement) = case.displacement() else { continue };
        exact += 1;
        for quantity in QUANTITIES {
            let (actual, expected) = (computed(quantity, &displacement), case.expected(quantity));
            if case.is("pure_rotation") {
                check_rotation(&case, quantity, &actual, &expected);
            } else if case.is("near_identity") || case.is("simple_shear_1e-8") {
                let small = Tol::stated(1e-15, "small strain from the displacement gradient");
                assert_close(&format!("{}: {quantity} of ∇u", case.id), &actual, &expected, small);
            } else {
                let what = format!("{}: {quantity} of ∇u", case.id);
                assert_close(&what, &actual, &expected, tolerance(&case, quantity));
            }
        }
    }
    assert!(25 < exact, "only {exact} cases have an exact displacement gradient");
}

/// The lines of the table of reachable accuracies that are about strain.
#[test]
fn small_strains_and_large_ratios_equal_reference_as_far_as_is_reachable() {
    // 2e-16 to the digit that the table has.
    let green = Tol::stated(2.0e-16, "the largest component, rounded");
    let almansi = Tol::stated(2.5e-16, "so too, behind the inverse of F");
    for case in cases() {
        let f = case.gradient();
        let check = |quantity: &str, tolerance: Tol| {
            let what = format!("{}: {quantity}", case.id);
            assert_close(&what, &computed(quantity, &f), &case.expected(quantity), tolerance);
        };
        if case.is("near_identity") {
            check("E", green);
            check("e", almansi);
            check("lnU", Tol::stated(1e-15, "logarithms of 1 + 2E"));
        }
        if case.id == "stretch_ratio_1e4" {
            check("R", Tol::stated(6e-15, "as by a singular value decomposition of F"));
        }
        if case.id == "stretch_ratio_1e8" {
            check("R", Tol::stated(7e-13, "as by a singular value decomposition of F"));
            check("lnU", Tol::stated(5e-10, "the conditioning of the logarithm"));
        }
    }
}
