//! What is easily done wrong, one test each.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::strain::{
    GreenStrain, HenckyStrain, LeftCauchyGreen, LinearStrain, RightCauchyGreen, RightStretch, Rotation, SethHill,
    invariants,
};
use piola_continuum::{
    ContinuumError, Deformation, DeformationGradient, DisplacementGradient, HomogeneousDeformation, Symmetric,
};
use piola_numerics::Real;
use piola_tensor::TensorError;
use piola_testkit::spectral::{adversarial_set, polar_reference, polar_reference_of_displacement};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale};

use super::cases::{analysis, biot, coalescent, flat, hencky, nine, polar_rotation, right_stretch, seth_hill};

fn entries() -> Matrix3<f64> {
    Matrix3::new(0.516, -0.764, -0.507, -0.798, -0.880, 0.594, -0.645, 0.119, -0.105)
}

#[test]
fn dependent_rows_are_refused() {
    let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
    assert_eq!(DeformationGradient::from_rows(rows), Err(ContinuumError::NonPositiveJacobian { determinant: 0.0 }));
}

#[test]
fn determinant_beyond_the_range_of_numbers_is_refused_by_name() {
    // Positive, but rounded to zero: not the same as flattened.
    for (stretches, logarithm) in [([1e-200, 1e-200, 1.0], -400.0), ([1e-120, 1e-110, 1e-105], -335.0)] {
        let f = Matrix3::from_diagonal(&Vector3::from(stretches));
        let Err(ContinuumError::VanishingJacobian { logarithm: found }) = DeformationGradient::new(f) else {
            panic!("{stretches:?} was not told apart");
        };
        assert_close("log₁₀ det F", &[found], &[logarithm], Tol::ulps(8.0));
    }
    let Err(ContinuumError::VanishingJacobian { .. }) =
        DeformationGradient::new(Matrix3::from_diagonal(&Vector3::new(1e-20_f32, 1e-30, 1.0)))
    else {
        panic!("a small determinant of single precision was not told apart");
    };
    for flat in [[1e-200, 0.0, 1.0], [0.0; 3], [1e-200, -0.0, 1e-200]] {
        let f = DeformationGradient::new(Matrix3::from_diagonal(&Vector3::from(flat)));
        assert!(matches!(f, Err(ContinuumError::NonPositiveJacobian { .. })), "{f:?}");
    }
    // Products of huge entries overflow, some to ∞ − ∞.
    let huge = Matrix3::new(1e200, 2e200, 3e200, -4e200, 5e200, 6e200, 7e200, -8e200, 9e200);
    for result in [DeformationGradient::new(huge).err(), DisplacementGradient::new(huge).err()] {
        assert!(matches!(result, Some(ContinuumError::NotFinite { quantity: "det F", .. })), "{result:?}");
    }
}

#[test]
fn bad_input_is_refused_by_name() {
    let one = Matrix3::<f64>::identity();
    assert_eq!(DeformationGradient::new(-one), Err(ContinuumError::NonPositiveJacobian { determinant: -1.0 }));
    let mut infinite = one;
    infinite[(1, 2)] = f64::INFINITY;
    assert_eq!(
        DeformationGradient::new(infinite),
        Err(ContinuumError::NotFinite { quantity: "F", index: 5, value: f64::INFINITY })
    );
    let mut nan = one;
    nan[(0, 0)] = f64::NAN;
    assert!(matches!(DisplacementGradient::new(nan), Err(ContinuumError::NotFinite { quantity: "∇u", index: 0, .. })));
    assert_eq!(
        DeformationGradient::diagonal([1.0, -2.0, 1.0]),
        Err(ContinuumError::NonPositiveStretch { index: 1, value: -2.0 })
    );
    assert_eq!(
        DisplacementGradient::diagonal([0.0, 0.0, -1.0]),
        Err(ContinuumError::NonPositiveStretch { index: 2, value: 0.0 })
    );
    assert_eq!(
        DeformationGradient::from_principal_stretches([1.0; 3], &(one * 2.0)),
        Err(ContinuumError::Tensor(TensorError::NotARotation { defect: 3.0, determinant: 8.0 }))
    );
    // Two stretches turned inside out have 0 < det F: only their own condition refuses them.
    assert_eq!(
        DeformationGradient::diagonal([-1.0, -1.0, 1.0]),
        Err(ContinuumError::NonPositiveStretch { index: 0, value: -1.0 })
    );
    assert_eq!(
        DeformationGradient::dilatation(1e200),
        Err(ContinuumError::NotFinite { quantity: "det F", index: 0, value: f64::INFINITY })
    );
    assert!(matches!(DeformationGradient::dilatation(1e-200), Err(ContinuumError::VanishingJacobian { .. })));
    assert!(matches!(SethHill::new(f64::NAN), Err(ContinuumError::NotFinite { .. })));
    let nowhere = Vector3::new(0.0, f64::NAN, 0.0);
    assert!(matches!(
        HomogeneousDeformation::new(DeformationGradient::identity(), nowhere),
        Err(ContinuumError::NotFinite { quantity: "translation", index: 1, .. })
    ));
    let skew = Matrix3::new(1.0, 0.5, 0.0, -0.5, 1.0, 0.0, 0.0, 0.0, 1.0);
    assert!(matches!(
        RightCauchyGreen::from_matrix(&skew),
        Err(ContinuumError::Tensor(TensorError::NotSymmetric { quantity: "C", row: 0, column: 1, .. }))
    ));
    assert_eq!(
        RightCauchyGreen::new(1.0, 1.0, 1.0, 2.0, 0.0, 0.0),
        Err(ContinuumError::Tensor(TensorError::NotPositiveDefinite {
            quantity: "C",
            order: 2,
            minor: -0.75,
            scale: 2.0
        }))
    );
    assert!(matches!(
        GreenStrain::new(-1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        Err(ContinuumError::Tensor(TensorError::NotPositiveDefinite { quantity: "1 + 2E", order: 1, .. }))
    ));
    assert!(Rotation::from_matrix(-one).is_err());
}

#[test]
fn strain_of_any_size_keeps_its_digits_from_the_displacement_gradient() {
    for exponent in [-6, -9, -12, -14, -20, -100] {
        let h = DisplacementGradient::new(entries() * 10.0_f64.powi(exponent)).expect("0 < det F");
        let reference = polar_reference_of_displacement(h.displacement_rows());
        let small = Tol::stated(1e-15, "ln U from the displacement gradient");
        assert_close("ln U", &nine(&hencky(&h)), reference.hencky_material.as_flattened(), small);
        let less_one = reference.right_stretch_less_one;
        assert_close("U − 1", &nine(&biot(&h)), less_one.as_flattened(), small);
        // All strains of the family agree to first order.
        if exponent <= -20 {
            for m in [-3.0, -1.0, 0.5, 2.0, 7.0] {
                let strain = seth_hill(&h, SethHill::new(m).expect("finite"));
                assert_close("Seth-Hill", &nine(&strain), &nine(&LinearStrain::of(&h).0), small);
            }
        }
    }
}

#[test]
fn hencky_strain_from_a_rounded_gradient_is_that_of_the_rounded_one() {
    // F = 1 + 1e-14 A has lost digits of A, but what is left of it is decomposed exactly.
    let f = DeformationGradient::new(Matrix3::identity() + entries() * 1e-14).expect("0 < det F");
    let reference = polar_reference(f.gradient_rows());
    let small = Tol::stated(1e-15, "F − 1 is exact");
    assert_close("ln U", &nine(&hencky(&f)), reference.hencky_material.as_flattened(), small);
}

#[test]
fn coalescent_stretches_equal_reference_and_have_finite_derivatives() {
    for f in coalescent() {
        let reference = polar_reference(f.gradient_rows());
        assert_close("U", &nine(&right_stretch(&f)), reference.right_stretch.as_flattened(), Tol::ulps(8.0));
        assert_close("R", &flat(polar_rotation(&f).matrix()), reference.rotation.as_flattened(), Tol::ulps(8.0));
        let logarithm = nine(&hencky(&f));
        assert_close_at_scale("ln U", &logarithm, reference.hencky_material.as_flattened(), 1.0, Tol::ulps(8.0));
        let whole = HenckyStrain::derivative_matrix(&f);
        assert!(whole.as_flattened().iter().all(|x| x.is_finite()), "{whole:?}");
    }
}

#[test]
fn nearly_isotropic_and_uniaxial_stretches_never_fail() {
    let mut random = piola_testkit::spectral::Random::new(4);
    for case in 0..20_000 {
        let gap = 10.0_f64.powf(-8.0 - 8.0 * random.symmetric().abs());
        let lateral = if case % 2 == 0 { 1.3 } else { 0.6 };
        let stretches = [1.3, lateral * (1.0 + gap * random.symmetric()), lateral * (1.0 + gap * random.symmetric())];
        let f = piola_testkit::spectral::with_stretches(&random.rotation(), stretches, &random.rotation());
        let f = DeformationGradient::from_rows(f).expect("0 < det F");
        let analysis = analysis(&f);
        let (u, r) = (RightStretch::from_analysis(&analysis), Rotation::from_analysis(&analysis));
        assert_close("F = R U", &flat(&(r.matrix() * u.matrix())), &flat(f.matrix()), Tol::ulps(16.0));
        assert!(Rotation::from_matrix(*r.matrix()).is_ok());
        let logarithm = HenckyStrain::from_analysis(&analysis).0;
        assert_close_at_scale("tr ln U", &[logarithm.trace()], &[f.ln_jacobian()], 1.0, Tol::ulps(16.0));
    }
}

/// How much half an ulp of each entry of F moves the rotation, in 31 digits.
fn moved_by_half_an_ulp(gradient: [[f64; 3]; 3], rotation: &[[f64; 3]; 3]) -> f64 {
    let change = |place: usize| {
        let mut moved = gradient;
        moved[place / 3][place % 3] = moved[place / 3][place % 3].next_up();
        let moved = polar_reference(moved).rotation;
        moved.as_flattened().iter().zip(rotation.as_flattened()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    0.5 * (0..9).map(change).sum::<f64>()
}

/// Where two stretches are small, the rounding of F turns R by more than 10⁻¹²: no number could be right to that.
#[test]
fn rotation_at_ratio_1e8_is_within_1e_12_unless_half_an_ulp_of_the_gradient_moves_it_further() {
    let bar = Tol::stated(1e-12, "stretch ratio 1e8");
    let (mut determined, mut moved_further) = (0, 0);
    for case in adversarial_set().iter().filter(|case| 1e7 < case.condition) {
        let f = DeformationGradient::from_rows(case.gradient).expect("0 < det F");
        let reference = polar_reference(case.gradient).rotation;
        let moved = moved_by_half_an_ulp(case.gradient, &reference);
        let (tolerance, count) = if moved < bar.value() {
            (bar, &mut determined)
        } else {
            (Tol::stated(moved, "half an ulp of the entries of F"), &mut moved_further)
        };
        *count += 1;
        assert_close(case.kind, polar_rotation(&f).rows().as_flattened(), reference.as_flattened(), tolerance);
    }
    assert!(10 < determined && 10 < moved_further, "{determined} determined, {moved_further} not");
}

#[test]
fn stretch_ratio_of_1e8_keeps_stretch_and_logarithm() {
    let mut seen = 0;
    for case in adversarial_set().iter().filter(|case| 1e7 < case.condition) {
        seen += 1;
        let f = DeformationGradient::from_rows(case.gradient).expect("0 < det F");
        let reference = polar_reference(case.gradient);
        let logarithm = Tol::stated(1e-9, "stretch ratio 1e8");
        assert_close(case.kind, &nine(&hencky(&f)), reference.hencky_material.as_flattened(), logarithm);
        assert_close(case.kind, &nine(&right_stretch(&f)), reference.right_stretch.as_flattened(), Tol::ulps(8.0));
    }
    assert!(20 < seen, "{seen} cases");
}

/// I₁ − 3 and I₂ − 3 of a rotation as doubles hold it are not zero but up to 10⁻¹⁴: what its entries amount to is found.
#[test]
fn invariants_of_rounded_rotations_equal_those_of_their_entries_within_4e_16() {
    let absolute = Tol::stated(4e-16, "absolute, of a rounded rotation");
    let one = DoubleDouble::lit(1.0);
    let exact = |f: [[DoubleDouble; 3]; 3]| -> [f64; 2] {
        let square = |rows: [[DoubleDouble; 3]; 3]| {
            rows.as_flattened().iter().fold(DoubleDouble::lit(-3.0), |sum, x| sum + *x * *x).primal(0)
        };
        let minor = |i: usize, j: usize| {
            let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            f[a][c] * f[b][d] - f[a][d] * f[b][c]
        };
        let cofactor = core::array::from_fn(|i| core::array::from_fn(|j| minor(i, j)));
        [square(f), square(cofactor)]
    };
    let mut random = piola_testkit::spectral::Random::new(23);
    let mut largest: f64 = 0.0;
    for _ in 0..10_000 {
        let rotation = random.rotation();
        let expected = exact(rotation.map(|row| row.map(DoubleDouble::lit)));
        let f = DeformationGradient::from_rows(rotation).expect("a rotation");
        let actual = [invariants::first_minus_three(&f), invariants::second_minus_three(&f)];
        assert_close_at_scale("of F", &actual, &expected, 1.0, absolute);
        largest = largest.max(expected[0].abs());

        let mut h = rotation;
        (0..3).for_each(|i| h[i][i] -= 1.0);
        let mut of_displacement = h.map(|row| row.map(DoubleDouble::lit));
        (0..3).for_each(|i| of_displacement[i][i] += one);
        let h = DisplacementGradient::from_rows(h).expect("a rotation");
        let actual = [invariants::first_minus_three(&h), invariants::second_minus_three(&h)];
        assert_close_at_scale("of ∇u", &actual, &exact(of_displacement), 1.0, absolute);
    }
    assert!(2e-15 < largest, "the rounding of rotations itself is {largest}");
}

#[test]
fn jacobian_of_cancelling_products_equals_that_in_doubled_precision() {
    let mut random = piola_testkit::spectral::Random::new(9);
    for ratio in [1e2, 1e4, 1e6, 1e8] {
        for _ in 0..1_000 {
            let stretches = [ratio, 1.0, 1.0 / ratio];
            let rows = piola_testkit::spectral::with_stretches(&random.rotation(), stretches, &random.rotation());
            let precise = DeformationGradient::from_rows(rows.map(|row| row.map(DoubleDouble::lit)));
            // At the largest ratio the rounding of F alone can turn the body inside out: both see that.
            match (DeformationGradient::from_rows(rows), precise) {
                (Ok(f), Ok(precise)) => {
                    let exact = precise.jacobian();
                    assert_close("J", &[f.jacobian()], &[exact.primal(0)], Tol::ulps(2.0));
                    let less_one = exact - DoubleDouble::lit(1.0);
                    assert_close_at_scale("J − 1", &[f.volume_change()], &[less_one.primal(0)], 1.0, Tol::ulps(2.0));
                }
                (plain, precise) => assert_eq!(plain.is_ok(), precise.is_ok(), "{rows:?}"),
            }
        }
    }
}

#[test]
fn nearly_flattened_body_keeps_its_volume() {
    for thickness in [1e-5, 1e-30, 1e-100, 1e-300] {
        let f = DeformationGradient::diagonal([1.0, 1.0, thickness]).expect("0 < λ");
        assert_close("J", &[f.jacobian()], &[thickness], Tol::ulps(1.0));
        // ln(1 + (J − 1)) would be −∞.
        assert_close("ln J", &[f.ln_jacobian()], &[thickness.ln()], Tol::ulps(1.0));
        // λ² is formed, and is below the range of doubles where λ < 1e-150.
        if 1e-150 < thickness {
            assert_close("λ₃", &analysis(&f).principal_stretches()[2..], &[thickness], Tol::ulps(4.0));
        }
    }
    // ∇u cannot hold such a stretch.
    let flat = DeformationGradient::diagonal([1.0, 1.0, 1e-30]).expect("0 < λ");
    assert_eq!(flat.to_displacement_gradient(), Err(ContinuumError::NonPositiveJacobian { determinant: 0.0 }));
}

#[test]
fn third_invariant_has_a_derivative_at_singular_tensors() {
    // I₃ B⁻¹ would be 0 · ∞.
    let singular = Symmetric::diagonal([2.0, 3.0, 0.0]);
    assert_eq!(invariants::derivatives(&singular)[2], Symmetric::diagonal([0.0, 0.0, 6.0]));
}

#[test]
fn second_invariant_of_a_large_stretch_keeps_its_digits() {
    // ½ (I₁² − tr C²) would lose 1e16 · 2⁻⁵³ ≈ 1 of I₂ = 2·10⁸ + 1.
    let f = DeformationGradient::diagonal([1e4_f64, 1.0, 1.0]).expect("0 < λ");
    assert_eq!(invariants::second(&f).to_bits(), (2e8 + 1.0_f64).to_bits());
}

#[test]
fn isochoric_invariants_of_a_large_stretch_are_those_of_its_shape() {
    // Stretches λ, λ^−½ and λ^−½ at λ = 4 and at 1/4, swollen s times: Ī₁ = λ² + 2/λ and Ī₂ = 2 λ + 1/λ².
    for (stretches, expected) in [([4.0, 0.5, 0.5], [13.5, 5.0625]), ([0.25, 2.0, 2.0], [5.0625, 13.5])] {
        for swelling in [0.25, 1.0, 3.0] {
            let f = Matrix3::from_diagonal(&Vector3::from(stretches)) * swelling;
            let f = DeformationGradient::new(f).expect("0 < det F");
            let apart = [invariants::isochoric_first_minus_three(&f), invariants::isochoric_second_minus_three(&f)];
            let both = invariants::isochoric_minus_three(&f);
            let what = format!("Ī₁ − 3, Ī₂ − 3 at {swelling}");
            assert_close(&what, &[apart, both].concat(), &[expected, expected].concat(), Tol::ulps(16.0));
        }
    }
}

#[test]
fn engineering_vectors_differ_in_the_order_of_shears() {
    // u_y + v_x = 1, u_z + w_x = 2, v_z + w_y = 4.
    let h = DisplacementGradient::from_rows([[0.0, 1.0, 2.0], [0.0, 0.0, 4.0], [0.0, 0.0, 0.0]]).expect("0 < det F");
    let strain = LinearStrain::of(&h);
    let bits = |vector: [f64; 6]| vector.map(f64::to_bits);
    assert_eq!(bits(strain.engineering_bro_nielsen()), bits([0.0, 0.0, 0.0, 1.0, 2.0, 4.0]));
    assert_eq!(bits(strain.engineering()), bits([0.0, 0.0, 0.0, 1.0, 4.0, 2.0]));
    assert_eq!(LinearStrain::from_engineering_bro_nielsen(strain.engineering_bro_nielsen()), Ok(strain));
    // Stored components are those of the tensor: shears are not doubled.
    assert_eq!(strain.0, Symmetric::new(0.0, 0.0, 0.0, 0.5, 2.0, 1.0));
}

#[test]
fn right_and_left_tensors_are_not_exchanged() {
    let shear = DeformationGradient::simple_shear(2.0).expect("finite");
    assert_eq!(flat(shear.matrix()), [1.0, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    assert_eq!(RightCauchyGreen::of(&shear).0, Symmetric::new(5.0, 1.0, 1.0, 2.0, 0.0, 0.0));
    assert_eq!(LeftCauchyGreen::of(&shear).0, Symmetric::new(1.0, 5.0, 1.0, 2.0, 0.0, 0.0));
}

#[test]
fn green_strain_has_its_half() {
    let stretched = DeformationGradient::uniaxial(3.0, 1.0).expect("0 < λ");
    assert_eq!(GreenStrain::of(&stretched).0, Symmetric::diagonal([4.0, 0.0, 0.0])); // ½ (9 − 1)
}

#[test]
fn linear_strain_sees_a_rotation_and_green_strain_does_not() {
    let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let turn = DeformationGradient::new(quarter_turn).expect("0 < det F");
    assert_eq!(GreenStrain::of(&turn).0, Symmetric::zero());
    assert_eq!(LinearStrain::of(&turn).0, Symmetric::diagonal([-1.0, -1.0, 0.0]));
}

#[test]
fn composition_applies_the_argument_first() {
    let shear = DeformationGradient::simple_shear(1.0).expect("finite");
    let bar = DeformationGradient::uniaxial(2.0, 1.0).expect("0 < λ");
    // First the shear, then the stretch: F = diag(2, 1, 1) (1 + e₂⊗e₁).
    let both = bar.compose(&shear).expect("0 < det F");
    assert_eq!(flat(both.matrix()), [2.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    assert_eq!(flat(shear.compose(&bar).expect("0 < det F").matrix()), [2.0, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn displacement_gradient_far_from_zero_equals_deformation_gradient() {
    let f =
        DeformationGradient::from_rows([[0.25_f64, 0.125, 0.0], [0.0, 0.25, 0.0], [0.0, 0.5, 3.0]]).expect("0 < det F");
    let h = f.to_displacement_gradient().expect("exact");
    assert_eq!(h.jacobian().to_bits(), f.jacobian().to_bits());
    assert_eq!(h.volume_change().to_bits(), f.volume_change().to_bits());
    assert_eq!(h.to_deformation_gradient(), Ok(f));
}
