//! The same formulas over f32 and over lanes.

use piola_continuum::strain::{AlmansiStrain, GreenStrain, SethHill, invariants};
use piola_continuum::{ContinuumError, Deformation, DeformationGradient, DisplacementGradient, Symmetric};
use piola_numerics::{Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{
    biot, deformation, displacement, hencky, left_stretch, right_stretch, seth_hill, spatial_hencky, spatial_seth_hill,
};

/// Everything that is asked of a deformation, by name and at which scale it is compared.
fn everything<T: Real>(f: &impl Deformation<T>) -> Vec<(&'static str, Vec<T>)> {
    let six = |a: Symmetric<T>| a.components.to_vec();
    let scale = SethHill::new(-0.5).expect("finite");
    vec![
        ("J", vec![f.jacobian()]),
        ("J − 1", vec![f.volume_change()]),
        ("ln J", vec![f.ln_jacobian()]),
        ("E", six(GreenStrain::of(f).0)),
        ("e", six(AlmansiStrain::of(f).0)),
        ("U", six(right_stretch(f))),
        ("V", six(left_stretch(f))),
        ("U − 1", six(biot(f))),
        ("ln U", six(hencky(f))),
        ("ln V", six(spatial_hencky(f))),
        ("Seth-Hill", six(seth_hill(f, scale))),
        ("spatial Seth-Hill", six(spatial_seth_hill(f, scale))),
        ("I₁ − 3", vec![invariants::first_minus_three(f)]),
        ("I₂ − 3", vec![invariants::second_minus_three(f)]),
        ("Ī₁ − 3", vec![invariants::isochoric_first_minus_three(f)]),
        ("Ī₂ − 3", vec![invariants::isochoric_second_minus_three(f)]),
        ("∂Ī₁/∂C", six(invariants::isochoric_first_derivative(f))),
    ]
}

/// The size to which errors are relative: that of the strain, for the invariants that of its square.
fn size(name: &str, f: &impl Deformation<f64>) -> f64 {
    let h = f.displacement_rows().as_flattened().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    match name {
        "J" | "U" | "V" => 1.0,
        _ if name.contains('3') => h * h,
        _ => h,
    }
}

fn lanes(fs: &[[[f64; 3]; 3]; 4]) -> [[Lanes<f64, 4>; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| Lanes(core::array::from_fn(|lane| fs[lane][i][j]))))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn lanes_equal_scalars(fs in prop::array::uniform4(deformation()), hs in prop::array::uniform4(displacement())) {
        let packed = DeformationGradient::from_rows(lanes(&fs.map(|f| f.gradient_rows()))).expect("0 < det F");
        let small = DisplacementGradient::from_rows(lanes(&hs.map(|h| h.displacement_rows()))).expect("0 < det F");
        let (packed, small) = (everything(&packed), everything(&small));
        for lane in 0..4 {
            let in_lane = |values: &[Lanes<f64, 4>]| values.iter().map(|x| x.primal(lane)).collect::<Vec<_>>();
            for ((name, expected), (_, actual)) in everything(&fs[lane]).iter().zip(&packed) {
                let what = format!("{name} of F");
                assert_close_at_scale(&what, &in_lane(actual), expected, size(name, &fs[lane]).max(1.0), Tol::ulps(32.0));
            }
            for ((name, expected), (_, actual)) in everything(&hs[lane]).iter().zip(&small) {
                let what = format!("{name} of ∇u");
                assert_close_at_scale(&what, &in_lane(actual), expected, size(name, &hs[lane]), Tol::ulps(32.0));
            }
        }
    }

    #[test]
    fn single_precision_equals_double_precision(f in deformation(), h in displacement()) {
        let single = f.matrix().map(f32::lit);
        let (single, double) = (
            DeformationGradient::new(single).expect("0 < det F"),
            DeformationGradient::new(single.map(f64::from)).expect("0 < det F"),
        );
        for ((name, expected), (_, actual)) in everything(&double).iter().zip(everything(&single)) {
            let actual: Vec<f64> = actual.into_iter().map(f64::from).collect();
            let what = format!("{name} of F in f32");
            assert_close_at_scale(&what, &actual, expected, size(name, &double).max(4.0), Tol::ulps32(64.0));
        }
        let single = h.matrix().map(f32::lit);
        let (single, double) = (
            DisplacementGradient::new(single).expect("0 < det F"),
            DisplacementGradient::new(single.map(f64::from)).expect("0 < det F"),
        );
        for ((name, expected), (_, actual)) in everything(&double).iter().zip(everything(&single)) {
            let actual: Vec<f64> = actual.into_iter().map(f64::from).collect();
            let what = format!("{name} of ∇u in f32");
            assert_close_at_scale(&what, &actual, expected, size(name, &double), Tol::ulps32(64.0));
        }
    }
}

#[test]
fn a_bad_lane_is_refused_with_its_number() {
    let good = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let bad = [[1.0, 0.0, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, 1.0]];
    let refused = DeformationGradient::from_rows(lanes(&[good, good, bad, good]));
    assert_eq!(refused, Err(ContinuumError::NonPositiveJacobian { determinant: -0.5 }));
}
