//! Where formulas of stress usually fail: pressure, scale, coincident principal stresses, bad input.

use core::f64::consts::{FRAC_PI_3, FRAC_PI_6};

use nalgebra::{Matrix3, Vector3};
use piola_continuum::stress::{PrincipalStresses, gradients, invariants};
use piola_continuum::{
    BiotStress, CauchyStress, ContinuumError, DeformationGradient, FirstPiola, KirchhoffStress, MandelStress,
    ReferenceNormal, SecondPiola, Symmetric, UnitNormal,
};
use piola_numerics::{Dual, Real};
use piola_tensor::TensorError;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

/// Not a bit of difference: scaling by powers of two and pressures that cancel exactly.
const EXACT: Tol = Tol::ulps(0.0);

fn diagonal(values: [f64; 3]) -> Symmetric {
    Symmetric::diagonal(values)
}

#[test]
fn pressure_changes_no_digit_of_deviatoric_quantities() {
    // All sums are exact in doubles: the deviators are the same to the last bit.
    let small = Symmetric::new(1.0, -2.0, 0.5, 0.5, 0.25, -0.75);
    for pressure in [1e9, -1e9, 2.0_f64.powi(50)] {
        let large = small + Symmetric::identity() * pressure;
        assert_eq!(invariants::deviator(&large), invariants::deviator(&small));
        let all = |t: &Symmetric| {
            [
                invariants::von_mises(t),
                invariants::tresca(t),
                invariants::j2(t),
                invariants::j3(t),
                invariants::lode_angle(t),
                invariants::octahedral_shear(t),
            ]
        };
        assert_close("under pressure", &all(&large), &all(&small), EXACT);
        let n = UnitNormal::new(Vector3::new(1.0, 2.0, 3.0)).expect("a direction");
        assert_eq!(CauchyStress(large).shear_traction(&n), CauchyStress(small).shear_traction(&n));
    }
}

#[test]
fn stresses_near_the_ends_of_the_range_have_finite_invariants() {
    let t = Symmetric::new(1.0, -2.0, 0.5, 0.5, 0.25, -0.75);
    let reference = [
        invariants::von_mises(&t),
        invariants::tresca(&t),
        invariants::octahedral_shear(&t),
        invariants::HaighWestergaard::of(&t).deviatoric,
    ];
    let angle = invariants::lode_angle(&t);
    let gradient = gradients::von_mises(&t);
    for exponent in [-1000, -531, 498, 1000, 1020] {
        let factor = 2.0_f64.powi(exponent);
        let scaled = t * factor;
        let actual = [
            invariants::von_mises(&scaled),
            invariants::tresca(&scaled),
            invariants::octahedral_shear(&scaled),
            invariants::HaighWestergaard::of(&scaled).deviatoric,
        ];
        assert_close(&format!("2^{exponent}"), &actual, &reference.map(|x| x * factor), EXACT);
        assert_close(&format!("2^{exponent}"), &[invariants::lode_angle(&scaled)], &[angle], EXACT);
        assert_eq!(gradients::von_mises(&scaled), gradient, "2^{exponent}");
        let n = UnitNormal::new(Vector3::new(1.0, -2.0, 2.0) * factor).expect("a direction");
        assert_close("n", &n.components(), &[1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0], Tol::ulps(1.0));
    }
    // The smallest numbers of all, where digits are few.
    let least = f64::from_bits(16);
    assert_close("von Mises", &[invariants::von_mises(&diagonal([least, 0.0, 0.0]))], &[least], EXACT);
    let n = UnitNormal::new(Vector3::new(f64::from_bits(3), 0.0, f64::from_bits(4))).expect("a direction");
    assert_close("n", &n.components(), &[0.6, 0.0, 0.8], Tol::ulps(1.0));
}

#[test]
fn triaxial_states_have_the_ends_of_the_lode_angle() {
    for value in [250.0, 1.0, 7.3, 1e-200, 3e200] {
        for axis in 0..3 {
            let mut values = [0.0; 3];
            values[axis] = value;
            let angles = |t: Symmetric| [invariants::lode_angle(&t), invariants::lode_angle_from_shear(&t)];
            assert_close_at_scale("extension", &angles(diagonal(values)), &[0.0, FRAC_PI_6], 1.0, Tol::ulps(1.0));
            values[axis] = -value;
            assert_close_at_scale(
                "compression",
                &angles(diagonal(values)),
                &[FRAC_PI_3, -FRAC_PI_6],
                1.0,
                Tol::ulps(1.0),
            );
        }
    }
    // A state that is triaxial about (1, 1, 1), of exact numbers.
    let about_diagonal = Symmetric::new(2.0, 2.0, 2.0, 1.0, 1.0, 1.0);
    assert_close("θ", &[invariants::lode_angle(&about_diagonal)], &[0.0], EXACT);
    assert_close("Tresca", &[invariants::tresca(&about_diagonal)], &[3.0], Tol::ulps(4.0));
}

#[test]
fn lode_angle_near_its_ends_equals_its_series() {
    // diag(1, ε, −ε)… deviators with s₂ − s₃ = 2ε: tan θ = √3 (s₂ − s₃)/(2 s₁ − s₂ − s₃).
    for gap in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let expected = (3.0_f64.sqrt() * 2.0 * gap).atan2(2.0);
        let extension = diagonal([1.0, gap, -gap]);
        assert_close_at_scale("θ", &[invariants::lode_angle(&extension)], &[expected], 1.0, Tol::ulps(2.0));
        // The arccosine has no digit of it below 1e-8.
        let compression = diagonal([-1.0, gap, -gap]);
        let from_end = FRAC_PI_3 - invariants::lode_angle(&compression);
        assert_close_at_scale("π/3 − θ", &[from_end], &[expected], 1.0, Tol::ulps(2.0));
        // In a turned basis the entries themselves are rounded.
        let (s, c) = 0.7_f64.sin_cos();
        let q = Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0) * Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c);
        let turned = CauchyStress(extension).rotated(&q).expect("a rotation");
        assert_close_at_scale("turned θ", &[turned.lode_angle()], &[expected], 1.0, Tol::ulps(8.0));
    }
}

#[test]
fn lode_angle_near_pure_shear_equals_its_series() {
    for offset in [1e-3, 1e-9, 1e-15] {
        // D = diag(1 − δ, 2δ… ): J₃ to first order is −2δ… for (1 + δ, −2δ, −1 + δ).
        let t = diagonal([1.0 + offset, -2.0 * offset, -1.0 + offset]);
        let [d1, d2, d3] = [1.0 + offset, -2.0 * offset, -1.0 + offset];
        let exact = ((2.0 * d2 - d1 - d3) / (3.0_f64.sqrt() * (d1 - d3))).atan();
        // θₛ counted from shear: positive towards extension, where s₂ approaches s₃.
        let expected = -exact;
        let tolerance = Tol::ulps(8.0).or(Tol::stated(f64::EPSILON / offset, "rounding of 1 + δ"));
        assert_close("θₛ", &[invariants::lode_angle_from_shear(&t)], &[expected], tolerance);
        assert_close("θ", &[invariants::lode_angle(&t)], &[FRAC_PI_6 - expected], Tol::ulps(8.0));
    }
}

#[test]
fn zero_deviator_gives_zeros_and_no_nan() {
    for t in [Symmetric::zero(), diagonal([-7.0; 3]), diagonal([1e200; 3])] {
        let stresses = [
            invariants::von_mises(&t),
            invariants::tresca(&t),
            invariants::octahedral_shear(&t),
            invariants::j2(&t),
            invariants::j3(&t),
            invariants::lode_angle(&t),
        ];
        assert_close("nothing", &stresses, &[0.0; 6], EXACT);
        for gradient in [gradients::von_mises(&t), gradients::lode_angle(&t), gradients::tresca(&t), gradients::j2(&t)]
        {
            assert_eq!(gradient, Symmetric::zero());
        }
        let mean = invariants::mean(&t);
        assert_eq!(invariants::triaxiality(&t), Err(ContinuumError::ZeroDeviator { mean }));
        // Numbers with derivatives stay numbers too.
        let dual = Symmetric { components: t.components.map(|x| Dual::new(x, 1.0)) };
        for value in [invariants::von_mises(&dual), invariants::tresca(&dual), invariants::lode_angle(&dual)] {
            assert_eq!(value, Dual::lit(0.0));
        }
    }
}

#[test]
fn gradients_at_coincident_stresses_are_the_mean_of_both_sides() {
    // Tresca's gradient on the edge of the prism: n₁⊗n₁ − n₃⊗n₃ with n₃ any of the plane.
    let edge = gradients::tresca(&diagonal([250.0, 0.0, 0.0]));
    assert_close("extension", &edge.components, &[1.0, -0.5, -0.5, 0.0, 0.0, 0.0], Tol::ulps(4.0));
    let edge = gradients::tresca(&diagonal([-250.0, 0.0, 0.0]));
    assert_close("compression", &edge.components, &[-1.0, 0.5, 0.5, 0.0, 0.0, 0.0], Tol::ulps(4.0));
    // Also where rounding keeps the stresses from being equal to the last bit.
    let q = Matrix3::new(0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 1.0);
    let turned = CauchyStress(diagonal([7.3, 0.0, 0.0])).rotated(&q).expect("a rotation");
    let edge = gradients::tresca(&turned.0);
    assert_close("turned", &edge.components, &[0.04, 0.46, -0.5, 0.72, 0.0, 0.0], Tol::ulps(8.0));
    assert_eq!(gradients::lode_angle(&turned.0), Symmetric::zero());
    let along = Symmetric { components: turned.0.components.map(|x| Dual::new(x, 1.0)) };
    let tangents = [invariants::tresca(&along).tangent, invariants::lode_angle(&along).tangent];
    assert_close("dual", &tangents, &[0.04 + 0.46 - 0.5 + 2.0 * 0.72, 0.0], Tol::ulps(16.0));
    // The tangent of numbers with derivatives is the same one.
    let dual = Symmetric { components: [250.0, 0.0, 0.0, 0.0, 0.0, 0.0].map(|x| Dual::new(x, 1.0)) };
    let tangent = invariants::tresca(&dual).tangent;
    assert_close_at_scale("dual", &[tangent], &[0.0], 1.0, Tol::ulps(4.0));
    // A hair beside the edge the angle's gradient has its full size.
    let beside = gradients::lode_angle(&diagonal([1.0, 1e-12, 0.0]));
    let radius = (2.0 / 3.0_f64).sqrt();
    assert_close(
        "|∂θ|",
        &[beside.double_contraction(&beside).sqrt()],
        &[1.0 / radius],
        Tol::ulps(8.0).or(Tol::stated(2e-12, "radius to first order")),
    );
}

#[test]
fn gradients_of_stresses_of_any_size_stay_finite() {
    let t = Symmetric::new(1.0, -2.0, 0.5, 0.5, 0.25, -0.75);
    for exponent in [-900, -400, 400, 900] {
        let factor = 2.0_f64.powi(exponent);
        let gradient = gradients::lode_angle(&(t * factor)) * factor;
        assert_close("∂θ", &gradient.components, &gradients::lode_angle(&t).components, Tol::ulps(1.0));
        assert_eq!(gradients::tresca(&(t * factor)), gradients::tresca(&t));
    }
}

#[test]
fn bad_stresses_are_refused_by_name() {
    let not_finite = |quantity, index| ContinuumError::NotFinite { quantity, index, value: f64::INFINITY };
    let stress: Result<CauchyStress, _> = CauchyStress::new(0.0, f64::INFINITY, 0.0, 0.0, 0.0, 0.0);
    assert_eq!(stress, Err(not_finite("Cauchy stress", 1)));
    let stress: Result<KirchhoffStress, _> = KirchhoffStress::new(0.0, 0.0, 0.0, 0.0, 0.0, f64::INFINITY);
    assert_eq!(stress, Err(not_finite("Kirchhoff stress", 5)));
    let mut matrix = Matrix3::<f64>::zeros();
    matrix[(1, 2)] = f64::INFINITY;
    assert_eq!(SecondPiola::from_matrix(&matrix), Err(not_finite("second Piola-Kirchhoff stress", 5)));
    assert_eq!(FirstPiola::new(matrix), Err(not_finite("first Piola-Kirchhoff stress", 5)));
    assert_eq!(BiotStress::new(matrix), Err(not_finite("Biot stress", 5)));
    assert_eq!(MandelStress::new(matrix), Err(not_finite("Mandel stress", 5)));
    matrix[(1, 2)] = 3.0;
    let expected = ContinuumError::Tensor(TensorError::NotSymmetric {
        quantity: "Cauchy stress",
        row: 1,
        column: 2,
        difference: 3.0,
        scale: 3.0,
    });
    assert_eq!(CauchyStress::from_matrix(&matrix), Err(expected));
    let tractions = [Vector3::<f64>::x(), Vector3::x(), Vector3::z()];
    assert!(matches!(
        CauchyStress::of_coordinate_tractions(&tractions),
        Err(ContinuumError::Tensor(TensorError::NotSymmetric { .. }))
    ));
}

#[test]
fn bad_normals_and_rotations_are_refused_by_name() {
    assert_eq!(UnitNormal::new(Vector3::<f64>::zeros()), Err(ContinuumError::ZeroNormal));
    assert_eq!(ReferenceNormal::new(Vector3::<f64>::zeros()), Err(ContinuumError::ZeroNormal));
    let infinite = UnitNormal::new(Vector3::new(0.0, f64::INFINITY, 0.0));
    assert_eq!(infinite, Err(ContinuumError::NotFinite { quantity: "normal", index: 1, value: f64::INFINITY }));
    let stress = CauchyStress(diagonal([1.0, 2.0, 3.0]));
    let reflection = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
    assert_eq!(
        stress.rotated(&reflection),
        Err(ContinuumError::Tensor(TensorError::NotARotation { defect: 0.0, determinant: -1.0 }))
    );
    let stretch = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0));
    assert_eq!(
        stress.rotated(&stretch),
        Err(ContinuumError::Tensor(TensorError::NotARotation { defect: 3.0, determinant: 2.0 }))
    );
    let first_piola = FirstPiola(Matrix3::identity());
    assert!(matches!(
        first_piola.biot_of_rotation(&stretch),
        Err(ContinuumError::Tensor(TensorError::NotARotation { .. }))
    ));
    let f = DeformationGradient::new(Matrix3::identity()).expect("0 < det F");
    let twist = FirstPiola(Matrix3::new(0.0, 2.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0));
    let refused = twist.check_moment(&f);
    let expected = ContinuumError::Tensor(TensorError::NotSymmetric {
        quantity: "P F^T",
        row: 0,
        column: 1,
        difference: 3.0,
        scale: 2.0,
    });
    assert_eq!(refused, Err(expected));
}

#[test]
fn stresses_at_the_end_of_the_range_equal_scaled_ones() {
    // 2¹⁰²² and 2⁻¹⁰¹⁰ times a few units: what can be represented is, to the last bit.
    for stress in [Symmetric::new(3.0, -0.5, 1.5, 0.5, 0.0, -0.25), diagonal([3.0, 3.0, 2.5])] {
        for scale in [2.0_f64.powi(1022), 2.0_f64.powi(-1010)] {
            let large = stress * scale;
            let scaled = |x: f64| [x * scale];
            assert_close("mean", &[invariants::mean(&large)], &scaled(invariants::mean(&stress)), EXACT);
            assert_close("von Mises", &[invariants::von_mises(&large)], &scaled(invariants::von_mises(&stress)), EXACT);
            assert_close("Tresca", &[invariants::tresca(&large)], &scaled(invariants::tresca(&stress)), EXACT);
            assert_eq!(invariants::deviator(&large), invariants::deviator(&stress) * scale);
            let (found, expected) = (PrincipalStresses::of(&large).values(), PrincipalStresses::of(&stress).values());
            assert_close("principal", &found, &expected.map(|x| x * scale), EXACT);
            assert_eq!(invariants::lode_angle(&large).to_bits(), invariants::lode_angle(&stress).to_bits());
            let gradient = gradients::von_mises(&large);
            assert_eq!(gradient, gradients::von_mises(&stress));
        }
    }
}

#[test]
fn stresses_are_shown_by_rows() {
    let stress: CauchyStress = CauchyStress::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0).expect("finite");
    assert_eq!(stress.to_string(), "[[1, 4, 6], [4, 2, 5], [6, 5, 3]]");
    assert_eq!(
        format!("{:.1}", FirstPiola(Matrix3::identity() * 0.5)),
        "[[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]]"
    );
}
