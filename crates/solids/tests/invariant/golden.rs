//! Linear elasticity, incompressible Mooney–Rivlin and the polynomial against reference values.

use piola_continuum::strain::LinearStrain;
use piola_continuum::{DeformationGradient, Symmetric};
use piola_solids::isochoric::MooneyRivlin;
use piola_solids::{
    ElasticConstants, Hyperelastic, IncompressibleSolid, LinearElastic, MixedLinearElastic, Polynomial, PolynomialTerm,
};
use piola_tensor::PairSymmetric;
use piola_tensor::voigt::Piola;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_each_close, golden};
use serde_json::Value;

/// Stresses and tangents of ordinary and of small strains: sums of some ten terms.
const STRESS: Tol = Tol::ulps(16.0);
const TANGENT: Tol = Tol::ulps(16.0);
/// Of the energy itself, small ones too.
const ENERGY: Tol = Tol::ulps(8.0);

fn cases(model: &str, count: usize) -> Vec<Value> {
    let golden = golden::load("hyperelastic");
    let cases: Vec<Value> = golden.cases.into_iter().filter(|case| golden::text(&case["model"]) == model).collect();
    assert_eq!(cases.len(), count, "{model}");
    cases
}

fn deformation(case: &Value) -> DeformationGradient {
    let rows = golden::matrix(&case["input"]["F"]);
    DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]))).expect("0 < det F")
}

fn parameter(case: &Value, name: &str) -> f64 {
    golden::number(&case["params"][name])
}

fn nine(tensor: &Symmetric) -> Vec<f64> {
    tensor.rows().as_flattened().to_vec()
}

#[test]
fn linear_elastic_equals_reference() {
    for case in cases("linear_elastic", 7) {
        let id = golden::text(&case["id"]);
        let constants =
            ElasticConstants::from_lame(parameter(&case, "lambda"), parameter(&case, "mu")).expect("parameters");
        let law = LinearElastic::new(constants).expect("compressible");
        let f = deformation(&case);
        let strain = LinearStrain::of(&f);
        let output = &case["output"];
        let close = |what: &str, actual: &[f64], expected: &[f64]| {
            assert_close(&format!("{id}: {what}"), actual, expected, STRESS);
        };
        close("ε", &nine(&strain.0), &golden::matrix(&output["linear_strain"]).concat());
        close("ε of Voigt", &strain.engineering(), &golden::vector(&output["strain6"]));
        let stress = law.stress(&strain);
        close("T", &nine(&stress.0), &golden::matrix(&output["T"]).concat());
        close("σ of Voigt", &stress.0.components, &golden::vector(&output["stress6"]));
        close("W", &[law.energy_density(&strain)], &[golden::number(&output["W"])]);
        close("W of F", &[law.energy(&f)], &[golden::number(&output["W"])]);
        let compliance = golden::matrix(&output["compliance6"]).concat();
        close("M⁻¹", law.compliance_matrix::<Piola>().entries.as_flattened(), &compliance);
        let stiffness = golden::matrix(&case["params"]["C6"]).concat();
        close("M", law.material_matrix::<Piola>().entries.as_flattened(), &stiffness);
        close("ε of T", &law.strain(&stress).0.components, &strain.0.components);
        // The mixed form with the pressure of the strain is the same.
        let mixed = MixedLinearElastic::new(constants);
        let bulk = constants.bulk_modulus().expect("compressible");
        let pressure = -bulk * strain.0.trace();
        close("T of ε and p", &mixed.stress(&strain, pressure).0.components, &stress.0.components);
    }
}

#[test]
fn incompressible_mooney_rivlin_equals_reference() {
    for case in cases("mooney_rivlin_incompressible", 14) {
        let id = golden::text(&case["id"]);
        let energy = MooneyRivlin::new(parameter(&case, "c10"), parameter(&case, "c01")).expect("parameters");
        let law = IncompressibleSolid::new(energy).at_pressure(parameter(&case, "p")).expect("finite");
        let f = deformation(&case);
        assert_eq!(law.check(&f), Ok(()), "{id}");
        let output = &case["output"];
        let close = |what: &str, actual: &[f64], name: &str| {
            assert_close(&format!("{id}: {what}"), actual, &golden::matrix(&output[name]).concat(), STRESS);
        };
        close("T", &nine(&law.cauchy(&f).0), "T");
        close("P", law.first_piola(&f).0.transpose().as_slice(), "P");
        close("S", &nine(&law.second_piola(&f).0), "S");
        close("extra stress", &nine(&law.extra_stress(&f).0), "extra_stress");
        close("∂W/∂F", law.energy_gradient(&f).0.transpose().as_slice(), "dW_dF");
        let expected = golden::number(&output["W"]);
        for law in [law, IncompressibleSolid::new(energy)] {
            // Of W itself, 7e-13 Pa in a shear of a millionth; nothing at the identity.
            assert_each_close(&format!("{id}: W"), &[law.energy(&f)], &[expected], ENERGY);
        }
    }
}

#[test]
fn polynomial_equals_reference() {
    for case in cases("polynomial", 13) {
        let id = golden::text(&case["id"]);
        let terms = golden::matrix(&case["params"]["terms"]).into_iter().map(|term| {
            let power = |k: usize| (0..=9_u8).find(|&n| (f64::from(n) - term[k]).abs() < 0.5).expect("a whole power");
            PolynomialTerm { first: power(0), second: power(1), third: power(2), coefficient: term[3] }
        });
        let law = Polynomial::stress_free(terms.collect()).expect("parameters");
        let f = deformation(&case);
        let output = &case["output"];
        let tangent = law.first_piola_tangent(&f);
        let entries = tangent.0.components.as_flattened();
        let moduli = entries.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let rest = if id.contains("/identity") { moduli * 1e-3 } else { 0.0 };
        let close = |what: &str, actual: &[f64]| {
            let expected = golden::matrix(&output[what]).concat();
            assert_close_at_scale(&format!("{id}: {what}"), actual, &expected, rest, STRESS);
        };
        close("P", law.first_piola(&f).0.transpose().as_slice());
        close("S", &nine(&law.second_piola(&f).0));
        close("T", &nine(&law.cauchy(&f).0));
        let energy = golden::number(&output["W_minus_Wref"]);
        assert_each_close(&format!("{id}: W"), &[law.energy(&f)], &[energy], ENERGY);
        assert_close(&format!("{id}: dP_dF"), entries, &golden::matrix(&output["dP_dF"]).concat(), TANGENT);
        let material = law.material_tangent(&f).0.slots();
        assert_close(
            &format!("{id}: dS_dE"),
            material.as_flattened(),
            &golden::matrix(&output["dS_dE"]).concat(),
            TANGENT,
        );
    }
}
