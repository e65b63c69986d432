//! One long stretch and two short ones close together: the rounding of the long one turns the axes of the short ones.

use piola_continuum::DeformationGradient;
use piola_continuum::polar::StretchAnalysis;
use piola_numerics::{Dual, Gradient, Real};
use piola_testkit::{Tol, assert_close_at_scale, golden};

use super::cases::{analysis, flat, matrix};

struct Case {
    name: String,
    gradient: [[f64; 3]; 3],
    stretches: Vec<f64>,
    logarithms: Vec<f64>,
}

fn cases() -> Vec<Case> {
    let case = |case: &serde_json::Value| {
        let f = golden::matrix(&case["input"]["F"]);
        Case {
            name: golden::text(&case["id"]).to_owned(),
            gradient: core::array::from_fn(|i| core::array::from_fn(|j| f[i][j])),
            stretches: golden::vector(&case["output"]["principal_stretches"]),
            logarithms: golden::vector(&case["output"]["log_principal_stretches"]),
        }
    };
    golden::load("principal_stretches").cases.iter().map(case).collect()
}

/// The bound that [`StretchAnalysis`] states.
const BOUND: f64 = 8.0;

#[test]
fn principal_stretches_equal_singular_values_within_8_ulp_of_the_longest() {
    for case in cases() {
        let found = analysis(case.gradient).principal_stretches();
        assert_close_at_scale(&case.name, &found, &case.stretches, case.stretches[0], Tol::ulps(BOUND));
    }
}

#[test]
fn log_principal_stretches_equal_logarithms_of_singular_values_within_8_ulp_of_the_ratio() {
    for case in cases() {
        let found = analysis(case.gradient).log_principal_stretches();
        let ratio = case.stretches[0] / case.stretches[2];
        assert_close_at_scale(&case.name, &found, &case.logarithms, ratio, Tol::ulps(BOUND));
    }
}

/// Σ λₖ qₖ ⊗ qₖ is the returned U, Σ λₖ R qₖ ⊗ R qₖ the returned V.
#[test]
fn stretch_tensors_equal_sums_over_stretches_and_axes() {
    for case in cases() {
        let stretch = analysis(case.gradient);
        let values = stretch.principal_stretches();
        for (axes, tensor) in
            [(stretch.material_axes(), stretch.right_stretch()), (stretch.spatial_axes(), stretch.left_stretch())]
        {
            let entry = |place: usize| {
                let (i, j) = (place / 3, place % 3);
                (0..3).map(|k| values[k] * axes[k][i] * axes[k][j]).sum::<f64>()
            };
            let sum: Vec<f64> = (0..9).map(entry).collect();
            // Axes of distinct short stretches are known within ε λ₁²/(λ₂² − λ₃²).
            let tol = Tol::ulps(BOUND).times((case.stretches[0] / case.stretches[2]).max(8.0) / 8.0);
            assert_close_at_scale(&case.name, &sum, &flat(&tensor), case.stretches[0], tol);
        }
    }
}

#[test]
fn stretches_over_scalars_with_derivatives_have_the_same_values() {
    for case in cases() {
        let f = DeformationGradient::new(matrix(case.gradient).map(Dual::lit)).expect("0 < det F");
        let found = StretchAnalysis::of(&f).principal_stretches().map(|x| x.value);
        assert_close_at_scale(&case.name, &found, &case.stretches, case.stretches[0], Tol::ulps(BOUND));
    }
}

/// Σ λₖ has the derivative R, whatever the gap.
#[test]
fn derivative_of_the_sum_of_the_stretches_equals_the_rotation() {
    for case in cases() {
        let varied = nalgebra::Matrix3::from_fn(|i, j| Gradient::<f64, 9>::variable(case.gradient[i][j], 3 * i + j));
        let f = DeformationGradient::new(varied).expect("0 < det F");
        let [a, b, c] = StretchAnalysis::of(&f).principal_stretches();
        let sum = (a + b + c).partials;
        let rotation = analysis(case.gradient).rotation().concat();
        let ratio = case.stretches[0] / case.stretches[2];
        assert_close_at_scale(&case.name, &sum, &rotation, 1.0, Tol::ulps(BOUND).times(ratio * ratio));
    }
}
