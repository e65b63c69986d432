//! Reference tangents: ∂S/∂E, S and F against ∂P/∂F.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{Deformation, DeformationGradient, SecondPiola, Symmetric};
use piola_tensor::{FourthOrder, Major, MajorSymmetric, MinorSymmetric, PairSymmetric};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use serde_json::Value;

use super::cases::{all, flat};

struct Case {
    id: String,
    deformation: DeformationGradient,
    stress: SecondPiola,
    material: MajorSymmetric,
    first_piola: FourthOrder,
}

fn square<const N: usize>(value: &Value) -> [[f64; N]; N] {
    let rows = golden::matrix(value);
    core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]))
}

fn cases() -> Vec<Case> {
    let read = |case: &Value| {
        let (input, output) = (&case["input"], &case["output"]);
        let f: [[f64; 3]; 3] = square(&input["F"]);
        Case {
            id: golden::text(&case["id"]).to_owned(),
            deformation: DeformationGradient::new(Matrix3::from_fn(|i, j| f[i][j])).expect("0 < det F"),
            stress: SecondPiola(Symmetric::symmetric_part(square(&output["S"]))),
            material: MajorSymmetric::try_from(square::<6>(&output["dS_dE"])).expect("symmetric"),
            first_piola: FourthOrder { components: square(&output["dP_dF"]) },
        }
    };
    golden::load("tangents").cases.iter().map(read).collect()
}

fn norm(f: [[f64; 3]; 3]) -> f64 {
    f.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn first_piola_tangents_equal_the_reference() {
    for case in cases() {
        let tangent: MaterialTangent = MaterialTangent(case.material);
        let first_piola = tangent.first_piola(&case.stress, &case.deformation);
        // The norm is that of the terms: |F|² |C| + |S|; the inputs are rounded to doubles.
        let terms = norm(case.deformation.gradient_rows()).powi(2) * case.material.norm() + case.stress.0.norm();
        assert_close_at_scale(&case.id, &flat(&first_piola.0), &flat(&case.first_piola), terms, Tol::ulps(8.0));
    }
}

#[test]
fn material_tangents_of_first_piola_ones_equal_the_reference() {
    for case in cases() {
        let first_piola = FirstPiolaTangent(case.first_piola);
        let material = first_piola.material(&case.stress, &case.deformation);
        let inverse = norm(case.deformation.inverse_rows());
        let size = case.first_piola.components.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt();
        // Condition of F⁻¹ itself, and the terms of the difference.
        let condition = inverse * norm(case.deformation.gradient_rows());
        let terms = inverse * inverse * (size + 3.0 * case.stress.0.norm());
        let tolerance = Tol::ulps(8.0).times(condition);
        assert_close_at_scale(&case.id, &all(&material.0), &all(&case.material), terms, tolerance);
        let residual = first_piola.objectivity_residual(&case.stress, &case.deformation);
        assert!(residual <= tolerance.value() * terms, "{}: {residual:e}", case.id);
    }
}

#[test]
fn tangents_of_truesdell_by_either_way_agree() {
    for case in cases() {
        let material: MaterialTangent<f64, Major> = MaterialTangent(case.material);
        let direct = material.truesdell(&case.deformation);
        let by_first_piola = FirstPiolaTangent(case.first_piola).truesdell(&case.stress, &case.deformation);
        let (f, inverse) = (norm(case.deformation.gradient_rows()), norm(case.deformation.inverse_rows()));
        let size = case.first_piola.components.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt();
        let terms = f.powi(4) * inverse * inverse * (size + 3.0 * case.stress.0.norm()) / case.deformation.jacobian();
        let tolerance = Tol::ulps(8.0).times(f * inverse);
        assert_close_at_scale(&case.id, &all(&by_first_piola.0), &all(&direct.0), terms, tolerance);
    }
}

#[test]
fn golden_tangents_read_as_matrices_are_the_tensors() {
    for case in cases() {
        let matrix = case.material.matrix();
        assert_eq!(MajorSymmetric::from_matrix(&matrix), Ok(case.material));
        assert_close(
            &case.id,
            &all(&MinorSymmetric::from_matrix(&matrix).expect("finite")),
            &all(&case.material),
            Tol::ulps(0.0),
        );
    }
}
