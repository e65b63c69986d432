//! Identities of strain, each for ten thousand random deformations.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::strain::{
    AlmansiStrain, BiotStrain, GreenStrain, HenckyStrain, LeftCauchyGreen, LeftStretch, LinearStrain, RightCauchyGreen,
    RightStretch, Rotation, SethHill, SethHillStrain, SpatialHenckyStrain, SpatialSethHillStrain, invariants,
};
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient, HomogeneousDeformation, Symmetric};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

use super::cases::{
    analysis, biot, deformation, direction, displacement, doubled, flat, hencky, leading, left_stretch, nine,
    polar_rotation, right_stretch, rotation, seth_hill, spatial_hencky, spatial_seth_hill,
};

/// Both sides of an identity have a few roundings each, and F itself is rounded when it is turned; the stretches are
/// between 1/2 and 2, so no quantity is magnified by more than four.
const ROUNDING: Tol = Tol::ulps(64.0);

fn material_strains(f: &impl Deformation<f64>) -> Vec<(&'static str, Symmetric)> {
    let scale = |m| SethHill::new(m).expect("finite");
    vec![
        ("C", RightCauchyGreen::of(f).0),
        ("U", right_stretch(f)),
        ("E", GreenStrain::of(f).0),
        ("U - 1", biot(f)),
        ("ln U", hencky(f)),
        ("Seth-Hill -1.5", seth_hill(f, scale(-1.5))),
        ("Seth-Hill 0.5", seth_hill(f, scale(0.5))),
        ("Seth-Hill 3", seth_hill(f, scale(3.0))),
    ]
}

fn spatial_strains(f: &impl Deformation<f64>) -> Vec<(&'static str, Symmetric)> {
    let scale = |m| SethHill::new(m).expect("finite");
    vec![
        ("B", LeftCauchyGreen::of(f).0),
        ("V", left_stretch(f)),
        ("e", AlmansiStrain::of(f).0),
        ("ln V", spatial_hencky(f)),
        ("spatial Seth-Hill -1.5", spatial_seth_hill(f, scale(-1.5))),
        ("spatial Seth-Hill 0.5", spatial_seth_hill(f, scale(0.5))),
        ("spatial Seth-Hill 3", spatial_seth_hill(f, scale(3.0))),
    ]
}

fn congruent(q: &Matrix3<f64>, a: &Symmetric) -> Vec<f64> {
    flat(&(q * a.matrix() * q.transpose()))
}

/// At the scale of one: strains may be small here by chance, while F is rounded.
fn assert_same(what: &str, actual: &[f64], expected: &[f64]) {
    assert_close_at_scale(what, actual, expected, 1.0, ROUNDING);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn material_strains_of_a_turned_body_equal_material_strains(f in deformation(), q in rotation()) {
        let turned = DeformationGradient::new(q * f.matrix()).expect("0 < det F");
        for ((name, strain), (_, of_turned)) in material_strains(&f).iter().zip(material_strains(&turned)) {
            assert_same(name, &nine(&of_turned), &nine(strain));
        }
    }

    #[test]
    fn spatial_strains_of_a_turned_body_equal_turned_spatial_strains(f in deformation(), q in rotation()) {
        let turned = DeformationGradient::new(q * f.matrix()).expect("0 < det F");
        for ((name, strain), (_, of_turned)) in spatial_strains(&f).iter().zip(spatial_strains(&turned)) {
            assert_same(name, &nine(&of_turned), &congruent(&q, strain));
        }
        assert_same("R", &flat(polar_rotation(&turned).matrix()), &flat(&(q * polar_rotation(&f).matrix())));
    }

    #[test]
    fn strains_of_a_turned_reference_equal_strains_turned_back(f in deformation(), q in rotation()) {
        let turned = DeformationGradient::new(f.matrix() * q).expect("0 < det F");
        for ((name, strain), (_, of_turned)) in material_strains(&f).iter().zip(material_strains(&turned)) {
            assert_same(name, &nine(&of_turned), &congruent(&q.transpose(), strain));
        }
        for ((name, strain), (_, of_turned)) in spatial_strains(&f).iter().zip(spatial_strains(&turned)) {
            assert_same(name, &nine(&of_turned), &nine(strain));
        }
    }

    #[test]
    fn spatial_measures_equal_rotated_material_ones(f in deformation()) {
        let rotation = polar_rotation(&f);
        let to_space = |a: Symmetric| nine(&rotation.to_space(&a));
        assert_same("B = R C Rᵀ", &nine(&LeftCauchyGreen::of(&f).0), &to_space(RightCauchyGreen::of(&f).0));
        assert_same("V = R U Rᵀ", &nine(&left_stretch(&f)), &to_space(right_stretch(&f)));
        assert_same("ln V = R ln U Rᵀ", &nine(&spatial_hencky(&f)), &to_space(hencky(&f)));
        let back = rotation.to_reference(&left_stretch(&f));
        assert_same("U = Rᵀ V R", &nine(&right_stretch(&f)), &nine(&back));
    }

    #[test]
    fn deformation_gradient_equals_rotation_times_stretch(f in deformation()) {
        let (r, u, v) = (polar_rotation(&f), right_stretch(&f), left_stretch(&f));
        assert_same("F = R U", &flat(f.matrix()), &flat(&(r.matrix() * u.matrix())));
        assert_same("F = V R", &flat(f.matrix()), &flat(&(v.matrix() * r.matrix())));
        prop_assert!(Rotation::from_matrix(*r.matrix()).is_ok());
    }

    #[test]
    fn green_strain_equals_half_of_metric_less_one(h in displacement()) {
        let one = Matrix3::<DoubleDouble>::from_diagonal_element(DoubleDouble::lit(1.0));
        let f = one + doubled(h.matrix());
        let half = DoubleDouble::lit(0.5);
        let green = (f.transpose() * f - one).map(|x| half * x);
        let almansi = AlmansiStrain::of(&DisplacementGradient::new(doubled(h.matrix())).expect("0 < det F"));
        assert_close("E", &nine(&GreenStrain::of(&h).0), &leading(green.as_slice()), Tol::ulps(2.0));
        // |F⁻¹| is up to 2 where entries of ∇u are 0.1.
        assert_close("e", &nine(&AlmansiStrain::of(&h).0), &leading(almansi.rows().as_flattened()), Tol::ulps(8.0));
        let minus_one = f * f.transpose() - one;
        assert_close("B − 1", &nine(&LeftCauchyGreen::minus_one(&h)), &leading(minus_one.as_slice()), Tol::ulps(2.0));
    }

    #[test]
    fn almansi_strain_equals_green_strain_of_the_inverse_with_the_sign_changed(h in displacement()) {
        let inverse = h.inverse().expect("regular");
        assert_close(
            "e(F) = −E(F⁻¹)", &nine(&AlmansiStrain::of(&h).0), &nine(&-GreenStrain::of(&inverse).0), Tol::ulps(16.0),
        );
    }

    #[test]
    fn seth_hill_strains_equal_the_named_ones(f in deformation(), h in displacement()) {
        let family = |f: &DeformationGradient, m: SethHill| nine(&seth_hill(f, m));
        assert_same("m = 2", &family(&f, SethHill::GREEN), &nine(&GreenStrain::of(&f).0));
        assert_same("m = 1", &family(&f, SethHill::BIOT), &nine(&biot(&f)));
        assert_same("m = 0", &family(&f, SethHill::HENCKY), &nine(&hencky(&f)));
        let inverse = analysis(&f).inverse_right_stretch();
        assert_same("m = −1", &family(&f, SethHill::new(-1.0).expect("finite")), &nine(&(Symmetric::identity() - inverse)));
        let spatial = |m: SethHill| nine(&spatial_seth_hill(&f, m));
        assert_same("m = −2", &spatial(SethHill::ALMANSI), &nine(&AlmansiStrain::of(&f).0));
        assert_same("m = 0 in space", &spatial(SethHill::HENCKY), &nine(&spatial_hencky(&f)));
        // From ∇u each keeps its own digits.
        let small = |m: SethHill| nine(&seth_hill(&h, m));
        assert_close("m = 2, ∇u", &small(SethHill::GREEN), &nine(&GreenStrain::of(&h).0), Tol::ulps(16.0));
        assert_close("m = 1, ∇u", &small(SethHill::BIOT), &nine(&biot(&h)), Tol::ulps(16.0));
    }

    #[test]
    fn seth_hill_strains_tend_to_the_logarithm(h in displacement(), f in deformation(), m in -1e-3..1e-3_f64) {
        // (λᵐ − 1)/m = ln λ (1 + m ln λ/2 + (m ln λ)²/6 + …)
        let scale = SethHill::new(m).expect("finite");
        let check = |strain: Symmetric, logarithm: Symmetric| {
            let l = logarithm.matrix();
            let series = l + l * l * (0.5 * m) + l * l * l * (m * m / 6.0) + l * l * l * l * (m * m * m / 24.0);
            let rest = Tol::stated(1e-14, "|m ln λ|⁴/120 below 2e-15, and rounding");
            assert_close("m → 0", &nine(&strain), &flat(&series), rest);
        };
        check(seth_hill(&h, scale), hencky(&h));
        check(seth_hill(&f, scale), hencky(&f));
        let tiny = SethHill::new(m * 1e-297).expect("finite");
        // Logarithms of the stretches and halves of those of their squares, each within an ulp of the largest.
        assert_close(
            "m ≈ 0", &nine(&seth_hill(&f, tiny)), &nine(&hencky(&f)), Tol::ulps(4.0),
        );
    }

    #[test]
    fn trace_of_hencky_strain_equals_logarithm_of_the_jacobian(f in deformation(), h in displacement()) {
        assert_same("tr ln U, F", &[hencky(&f).trace()], &[f.ln_jacobian()]);
        let strain = hencky(&h);
        let scale = strain.components.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert_close_at_scale("tr ln U, ∇u", &[strain.trace()], &[h.ln_jacobian()], scale, Tol::ulps(16.0));
    }

    #[test]
    fn invariants_equal_those_in_doubled_precision(h in displacement()) {
        let precise = DisplacementGradient::new(doubled(h.matrix())).expect("0 < det F");
        let size = h.matrix().amax();
        let check = |what: &str, actual: f64, precise: DoubleDouble, scale: f64| {
            assert_close_at_scale(what, &[actual], &[precise.primal(0)], scale, Tol::ulps(32.0));
        };
        // Errors are those of the second-order terms, even where the first-order ones cancel.
        let second_order = size * size;
        check("J − 1", h.volume_change(), precise.volume_change(), second_order);
        check("I₁ − 3", invariants::first_minus_three(&h), invariants::first_minus_three(&precise), second_order);
        check("I₂ − 3", invariants::second_minus_three(&h), invariants::second_minus_three(&precise), second_order);
        check("I₃ − 1", invariants::third_minus_one(&h), invariants::third_minus_one(&precise), second_order);
        check("J", h.jacobian(), precise.jacobian(), 0.0);
    }

    #[test]
    fn isochoric_invariants_less_three_equal_those_in_doubled_precision(h in displacement()) {
        // In doubled precision by the definition, which loses what the strain squared lacks of one.
        let precise = DisplacementGradient::new(doubled(h.matrix())).expect("0 < det F");
        let (three, two_thirds) = (DoubleDouble::lit(3.0), DoubleDouble::lit(-2.0) / DoubleDouble::lit(3.0));
        let power = (two_thirds * precise.jacobian().ln()).exp();
        let expected = [
            power * invariants::first(&precise) - three,
            power * power * invariants::second(&precise) - three,
        ];
        let actual = [invariants::isochoric_first_minus_three(&h), invariants::isochoric_second_minus_three(&h)];
        let deviator = GreenStrain::of(&h).0;
        let deviator = deviator - Symmetric::identity() * (deviator.trace() / 3.0);
        let smallness = nine(&deviator).iter().fold(0.0_f64, |m, x| m.max(x.abs())) / h.matrix().amax();
        let rounding = 1e-27 / h.matrix().amax().powi(2);
        let tolerance = Tol::ulps(64.0).times(1.0 / smallness.min(1.0)).value() + rounding / smallness.powi(2);
        let stated = Tol::stated(tolerance, "64 ulp |∇u|/|dev E|, and 1e-27 of the reference");
        assert_close("Ī₁ − 3", &actual[..1], &leading(&expected[..1]), stated);
        assert_close("Ī₂ − 3", &actual[1..], &leading(&expected[1..]), stated);
        assert_close("Ī₁", &[invariants::isochoric_first(&h)], &[3.0 + actual[0]], Tol::ulps(2.0));
        assert_close("Ī₂", &[invariants::isochoric_second(&h)], &[3.0 + actual[1]], Tol::ulps(2.0));
    }

    #[test]
    fn isochoric_invariants_of_a_dilated_body_equal_its_own(f in deformation(), s in 0.1..10.0_f64) {
        let dilated = DeformationGradient::new(f.matrix() * s).expect("0 < det F");
        assert_close(
            "Ī₁", &[invariants::isochoric_first(&dilated)], &[invariants::isochoric_first(&f)], ROUNDING,
        );
        assert_close(
            "Ī₂", &[invariants::isochoric_second(&dilated)], &[invariants::isochoric_second(&f)], ROUNDING,
        );
    }

    #[test]
    fn invariants_of_a_deformation_equal_those_of_its_metrics(f in deformation()) {
        let expected = [invariants::first(&f), invariants::second(&f), invariants::third(&f)];
        assert_close("C", &RightCauchyGreen::of(&f).principal_invariants(), &expected, ROUNDING);
        assert_close("B", &invariants::principal_invariants(&LeftCauchyGreen::of(&f).0), &expected, ROUNDING);
    }

    #[test]
    fn composition_equals_product_and_inverse_undoes_it(f in deformation(), g in deformation(), h in displacement(), k in displacement()) {
        let product = g.compose(&f).expect("0 < det F");
        assert_same("F₂ F₁", &flat(product.matrix()), &flat(&(g.matrix() * f.matrix())));
        assert_close("J₂ J₁", &[product.jacobian()], &[g.jacobian() * f.jacobian()], ROUNDING);
        let undone = f.inverse().expect("regular").compose(&f).expect("0 < det F");
        assert_same("F⁻¹ F", &flat(undone.matrix()), &flat(&Matrix3::identity()));
        // (F₂ F₁) F₁⁻¹ in terms of ∇u, relative to ∇u.
        let both = k.compose(&h).expect("0 < det F");
        let back = both.compose(&h.inverse().expect("regular")).expect("0 < det F");
        let scale = h.matrix().amax().max(k.matrix().amax());
        assert_close_at_scale("∇u₂", &flat(back.matrix()), &flat(k.matrix()), scale, Tol::ulps(32.0));
    }

    #[test]
    fn volume_of_deformed_area_times_line_equals_deformed_volume(f in deformation(), n in strategies::unit_vector(), x in strategies::unit_vector()) {
        let (n, x) = (Vector3::from(n), Vector3::from(x));
        assert_same("n da · dx = J N dA · dX", &[f.area_element(n).dot(&f.line_element(x))], &[f.volume_element(n.dot(&x))]);
        let metric = RightCauchyGreen::of(&f).matrix();
        assert_same("|dx|² = dX · C dX", &[f.line_element(x).norm_squared()], &[(metric * x).dot(&x)]);
    }

    #[test]
    fn reference_position_of_a_deformed_position_equals_the_start(f in deformation(), c in strategies::vector(3, -5.0..5.0), x in strategies::vector(3, -5.0..5.0)) {
        let (c, x) = (Vector3::from_column_slice(&c), Vector3::from_column_slice(&x));
        let motion = HomogeneousDeformation::new(f, c).expect("finite");
        assert_close_at_scale(
            "X", motion.reference_position(motion.position(x)).as_slice(), x.as_slice(), 5.0, ROUNDING,
        );
        assert_close_at_scale(
            "u = x − X", motion.displacement(x).as_slice(), (motion.position(x) - x).as_slice(), 10.0, ROUNDING,
        );
    }

    #[test]
    fn rigid_motion_leaves_lengths_unchanged(q in rotation()) {
        let motion = DeformationGradient::new(q).expect("0 < det F");
        // Q as rounded is orthogonal to some ulp only: ½ (Qᵀ Q − 1), which is ln U too but for its square.
        let wide = doubled(&q);
        let one = Matrix3::<DoubleDouble>::from_diagonal_element(DoubleDouble::lit(1.0));
        let left = leading((wide.transpose() * wide - one).map(|x| DoubleDouble::lit(0.5) * x).as_slice());
        assert_close_at_scale("½ (Qᵀ Q − 1)", &left, &[0.0; 9], 1.0, Tol::ulps(8.0));
        assert_close_at_scale("E", &nine(&GreenStrain::of(&motion).0), &left, 1.0, Tol::ulps(2.0));
        assert_close_at_scale("ln U", &nine(&hencky(&motion)), &left, 1.0, Tol::ulps(4.0));
        let doubled_left: Vec<f64> = left.iter().map(|x| 2.0 * x).collect();
        let change = nine(&RightCauchyGreen::minus_one(&motion));
        assert_close_at_scale("C − 1", &change, &doubled_left, 1.0, Tol::ulps(4.0));
    }

    #[test]
    fn pure_stretch_from_axes_has_those_stretches_and_axes(q in rotation(), logarithms in strategies::vector(3, -0.7..0.7)) {
        let mut stretches: [f64; 3] = core::array::from_fn(|i| logarithms[i].exp());
        let f = DeformationGradient::from_principal_stretches(stretches, &q).expect("0 < λ");
        let logarithm = q * Matrix3::from_diagonal(&Vector3::from_column_slice(&logarithms)) * q.transpose();
        assert_same("ln U", &nine(&hencky(&f)), &flat(&logarithm));
        let elongations = stretches.map(|x| x - 1.0);
        let h = DisplacementGradient::from_principal_elongations(elongations, &q).expect("0 < λ");
        assert_same("∇u", &flat(&(h.matrix() + Matrix3::identity())), &flat(f.matrix()));
        stretches.sort_by(|a, b| b.total_cmp(a));
        assert_same("λ", &analysis(&f).principal_stretches(), &stretches);
    }

    #[test]
    fn linear_strain_equals_derivative_of_every_strain_at_rest(direction in direction()) {
        let rest = DisplacementGradient::zero();
        let linear = nine(&Symmetric::symmetric_part(piola_numerics::linear::matrix3::rows_of(&direction)));
        let scale = |m| SethHill::new(m).expect("finite");
        for (what, derivative) in [
            ("E", GreenStrain::derivative(&rest, &direction)),
            ("e", AlmansiStrain::derivative(&rest, &direction)),
            ("U", RightStretch::derivative(&rest, &direction)),
            ("V", LeftStretch::derivative(&rest, &direction)),
            ("U - 1", BiotStrain::derivative(&rest, &direction)),
            ("ln U", HenckyStrain::derivative(&rest, &direction)),
            ("ln V", SpatialHenckyStrain::derivative(&rest, &direction)),
            ("Seth-Hill", SethHillStrain::derivative(&rest, scale(-0.7), &direction)),
            ("spatial Seth-Hill", SpatialSethHillStrain::derivative(&rest, scale(5.0), &direction)),
        ] {
            assert_close(what, &nine(&derivative), &linear, Tol::ulps(8.0));
        }
        let small = DisplacementGradient::new(direction * 1e-3).expect("0 < det F");
        assert_close("ε", &nine(&LinearStrain::of(&small).0), &linear.iter().map(|x| 1e-3 * x).collect::<Vec<_>>(), Tol::ulps(2.0));
    }
}
