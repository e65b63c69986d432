//! Energy, stresses and both tangents of laws: `testdata/golden/solid_laws.json`, four deformations each.

use nalgebra::{Matrix3, Matrix6};
use piola_continuum::{DeformationGradient, DisplacementGradient};
use piola_solids::isochoric::{self, ArrudaBoyce, Gent, Rivlin, RivlinTerm, Yeoh};
use piola_solids::volumetric::Quadratic;
use piola_solids::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, BlatzKo, Compressible, EngineeringConstants, Fibre, Fung,
    HolzapfelGasserOgden, Hyperelastic, ReinforcedNeoHookean, SolidsError, Stiffness, TransverseConstants,
};
use piola_tensor::PairSymmetric;
use piola_testkit::golden::{self, matrix, number, vector};
use piola_testkit::{Tol, assert_close, assert_each_close};
use serde_json::Value;

use super::once::Once;

/// Of the largest component: stresses and tangents are sums of some ten terms, each of a few ulp.
const SUMS: Tol = Tol::ulps(16.0);

fn rows<const N: usize>(value: &Value) -> [[f64; N]; N] {
    let rows = matrix(value);
    assert_eq!((rows.len(), rows[0].len()), (N, N));
    core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]))
}

/// The cases of a law: four deformations for each of `sets` sets of parameters.
fn cases(law: &str, sets: usize) -> Vec<Value> {
    let cases: Vec<_> =
        golden::load("solid_laws").cases.into_iter().filter(|case| golden::text(&case["law"]) == law).collect();
    assert_eq!(cases.len(), 4 * sets, "{law}");
    cases
}

/// Compares a law with the script. `energy` is the tolerance of W, of W itself.
fn check<L: Hyperelastic>(
    law: &str,
    sets: usize,
    energy: Tol,
    make: impl Fn(&dyn Fn(&str) -> f64, &Value) -> Result<L, SolidsError>,
) {
    for case in cases(law, sets) {
        let (id, output) = (golden::text(&case["id"]), &case["output"]);
        let parameter = |name: &str| number(&case["params"][name]);
        let law = make(&parameter, &case["params"]).expect("parameters within bounds");
        let law = Once(&law);
        let f = DeformationGradient::from_rows(rows(&case["input"]["F"])).expect("0 < det F");
        assert_eq!(law.check(&f), Ok(()), "{id}");
        let close = |name: &str, actual: &[f64]| {
            assert_close(&format!("{id}: {name}"), actual, &matrix(&output[name]).concat(), SUMS);
        };
        assert_each_close(&format!("{id}: W"), &[law.energy(&f)], &[number(&output["W"])], energy);
        close("P", law.first_piola(&f).0.transpose().as_slice());
        close("T", law.cauchy(&f).0.rows().as_flattened());
        close("dP_dF", law.first_piola_tangent(&f).0.components.as_flattened());
        close("dS_dE", law.material_tangent(&f).0.slots().as_flattened());
    }
}

#[test]
fn yeoh_equals_reference() {
    check("yeoh", 1, Tol::ulps(8.0), |p, _| {
        Ok(Compressible::new(Yeoh::new(p("c1"), p("c2"), p("c3"))?, Quadratic::new(p("kappa"))?))
    });
}

#[test]
fn rivlin_with_mixed_terms_equals_reference() {
    check("rivlin", 1, Tol::ulps(8.0), |p, params| {
        let terms = matrix(&params["terms"]).into_iter().map(|term| {
            let power = |x: f64| (0..=9_u8).find(|&n| (f64::from(n) - x).abs() < 0.5).expect("a whole power");
            RivlinTerm { first: power(term[0]), second: power(term[1]), coefficient: term[2] }
        });
        Ok(Compressible::new(Rivlin::new(terms.collect())?, Quadratic::new(p("kappa"))?))
    });
}

#[test]
fn isochoric_mooney_rivlin_equals_reference() {
    check("mooney_rivlin", 1, Tol::ulps(8.0), |p, params| {
        let terms = matrix(&params["terms"]);
        let shape = isochoric::MooneyRivlin::new(terms[0][2], terms[1][2])?;
        Ok(Compressible::new(shape, Quadratic::new(p("kappa"))?))
    });
}

#[test]
fn gent_equals_reference() {
    check("gent", 1, Tol::ulps(8.0), |p, _| {
        Ok(Compressible::new(Gent::new(p("mu"), p("limit"))?, Quadratic::new(p("kappa"))?))
    });
}

#[test]
fn arruda_boyce_equals_reference() {
    check("arruda_boyce", 1, Tol::ulps(8.0), |p, _| {
        Ok(Compressible::new(ArrudaBoyce::new(p("modulus"), p("links"))?, Quadratic::new(p("kappa"))?))
    });
}

#[test]
fn blatz_ko_of_foam_of_solid_and_between_equals_reference() {
    check("blatz_ko", 3, Tol::ulps(8.0), |p, _| BlatzKo::new(p("mu"), p("nu"), p("f")));
}

#[test]
fn fung_without_symmetry_equals_reference() {
    check("fung", 1, Tol::ulps(8.0), |p, params| {
        let exponents = Matrix6::from_row_slice(rows::<6>(&params["exponents"]).as_flattened());
        Fung::new(p("c"), Stiffness::from_matrix(&exponents)?)
    });
}

#[test]
fn holzapfel_gasser_ogden_with_and_without_dispersion_equals_reference() {
    check("holzapfel_gasser_ogden", 2, Tol::ulps(8.0), |p, params| {
        let [first, second] = [0, 1].map(|family| {
            let direction = vector(&params["fibres"][family]);
            Fibre::new([direction[0], direction[1], direction[2]])
        });
        HolzapfelGasserOgden::new(p("mu"), p("kappa"), p("k1"), p("k2"), p("dispersion"), [first?, second?])
    });
}

fn direction(value: &Value) -> Result<Fibre, SolidsError> {
    let direction = vector(value);
    Fibre::new([direction[0], direction[1], direction[2]])
}

#[test]
fn reinforced_neo_hookean_equals_reference() {
    check("reinforced_neo_hookean", 1, Tol::ulps(8.0), |p, params| {
        ReinforcedNeoHookean::new(p("mu"), p("lame"), p("k"), direction(&params["fibre"])?)
    });
}

fn orthotropic(params: &Value) -> Result<Stiffness, SolidsError> {
    let three = |name: &str| -> [f64; 3] { vector(&params[name]).try_into().expect("three constants") };
    let constants = EngineeringConstants { young: three("young"), poisson: three("poisson"), shear: three("shear") };
    Stiffness::orthotropic(&constants, &Matrix3::from_row_slice(rows::<3>(&params["axes"]).as_flattened()))
}

fn transverse(p: &dyn Fn(&str) -> f64, params: &Value) -> Result<Stiffness, SolidsError> {
    let constants = TransverseConstants {
        young_along: p("along"),
        young_across: p("across"),
        poisson_along: p("poisson_along"),
        poisson_across: p("poisson_across"),
        shear_along: p("shear"),
    };
    Stiffness::transversely_isotropic(&constants, direction(&params["direction"])?)
}

#[test]
fn orthotropic_saint_venant_kirchhoff_equals_reference() {
    check("saint_venant_kirchhoff_orthotropic", 1, Tol::ulps(8.0), |_, params| {
        Ok(AnisotropicSaintVenantKirchhoff::new(orthotropic(params)?))
    });
}

#[test]
fn transversely_isotropic_saint_venant_kirchhoff_equals_reference() {
    check("saint_venant_kirchhoff_transverse", 1, Tol::ulps(8.0), |p, params| {
        Ok(AnisotropicSaintVenantKirchhoff::new(transverse(p, params)?))
    });
}

/// T = C : ε of the six unit strains is the columns of C, whose components are the ∂S/∂E of the reference; a spin has no stress.
#[test]
fn anisotropic_linear_elasticity_equals_reference() {
    const STRAINS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
    // A small strain: 2⁻²⁰, exact in doubles.
    let small = 2.0_f64.powi(-20);
    let mut count = 0;
    for name in ["saint_venant_kirchhoff_orthotropic", "saint_venant_kirchhoff_transverse"] {
        let case = cases(name, 1).swap_remove(0);
        let parameter = |name: &str| number(&case["params"][name]);
        let stiffness = if name.ends_with("transverse") {
            transverse(&parameter, &case["params"])
        } else {
            orthotropic(&case["params"])
        };
        let law = AnisotropicLinear::new(stiffness.expect("definite"));
        let components = matrix(&case["output"]["dS_dE"]);
        for (column, (i, j)) in STRAINS.into_iter().enumerate() {
            let mut gradient = [[0.0; 3]; 3];
            // Of a shear one half of ∇u is strain: T = 2 C_klij ε_ij = C_klij ∂u_i/∂X_j.
            gradient[i][j] = small;
            let found = law.cauchy(&DisplacementGradient::from_rows(gradient).expect("0 < det F")).0.components;
            let expected: Vec<f64> = components.iter().map(|row| small * row[column]).collect();
            assert_close(&format!("{name}: C of {i}{j}"), &found, &expected, SUMS);
            // W = ½ T : ε, ε_ij = ½ ∂u_i/∂X_j of a shear, twice in the sum.
            let energy = law.energy(&DisplacementGradient::from_rows(gradient).expect("0 < det F"));
            assert_each_close("W", &[energy], &[0.5 * expected[column] * small], SUMS);
            count += 1;
        }
        let spin = [[0.0, small, 0.0], [-small, 0.0, 0.0], [0.0; 3]];
        let found = law.cauchy(&DisplacementGradient::from_rows(spin).expect("0 < det F")).0.components;
        assert_close("spin", &found, &[0.0; 6], Tol::ulps(0.0));
    }
    assert_eq!(count, 12);
}
