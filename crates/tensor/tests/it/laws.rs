//! Identities of tensors, of projectors, of rotations, of Voigt's and Mandel's maps.

use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::{
    cofactor, difference, double_contraction, identity, product, product_transposed, scaled, sum, trace, transpose,
    transposed_product,
};
use piola_tensor::voigt::{
    Abaqus, BroNielsen, Classical, ComplianceMatrix, MandelMatrix, MandelVector, Piola, StiffnessMatrix, StrainVector,
    StressVector,
};
use piola_tensor::{FourthOrder, MajorSymmetric, MinorSymmetric, PairSymmetric, Skew, principal_invariants};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{all, by_eight_loops, deformation, flat, major, minor, nine, rotation, rows, skew, symmetric};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn symmetric_and_skew_parts_add_up_to_the_tensor(a in rows()) {
        let (s, w) = (Symmetric::symmetric_part(a), Skew::skew_part(a));
        assert_close("A", (s.matrix() + w.matrix()).as_slice(), from_rows(a).as_slice(), Tol::ulps(2.0));
        prop_assert_eq!(Symmetric::from_matrix(&s.matrix()), Ok(s));
        prop_assert_eq!(Skew::from_matrix(&w.matrix()), Ok(w));
        prop_assert!((s.matrix().dot(&w.matrix())).abs() <= Tol::ulps(8.0).value());
    }

    #[test]
    fn products_of_symmetric_tensors_equal_those_of_matrices(a in symmetric(), b in symmetric(), f in rows(), w in skew()) {
        let (m, n, g) = (a.matrix(), b.matrix(), from_rows(f));
        let close = |what: &str, tensor: Symmetric, matrix: nalgebra::Matrix3<f64>| {
            assert_close_at_scale(what, &nine(&tensor), matrix.transpose().as_slice(), 1.0, Tol::ulps(32.0));
        };
        close("A²", a.square(), m * m);
        close("AB + BA", a.anticommutator(&b), m * n + n * m);
        close("FAFᵀ", a.congruence(f), g * m * g.transpose());
        close("FᵀAF", a.transposed_congruence(f), g.transpose() * m * g);
        close("WA − AW", w.turning(&a), w.matrix() * m - m * w.matrix());
        close("dev", a.deviator() + a.spherical_part(), m);
        let commutator = Skew::commutator(&a, &b).matrix();
        assert_close_at_scale("AB − BA", commutator.as_slice(), (m * n - n * m).as_slice(), 1.0, Tol::ulps(32.0));
        prop_assert!((a.norm() - m.norm()).abs() <= Tol::ulps(8.0).value() * m.norm());
    }

    #[test]
    fn operations_on_rows_equal_those_on_matrices(a in rows(), b in rows(), s in -2.0..2.0_f64) {
        let (m, n) = (from_rows(a), from_rows(b));
        let close = |what: &str, found: [[f64; 3]; 3], expected: nalgebra::Matrix3<f64>| {
            assert_close_at_scale(what, from_rows(found).as_slice(), expected.as_slice(), 1.0, Tol::ulps(8.0));
        };
        close("s A", scaled(a, s), m * s);
        close("A + B", sum(a, b), m + n);
        close("A − B", difference(a, b), m - n);
        close("A B", product(a, b), m * n);
        close("Aᵀ B", transposed_product(a, b), m.transpose() * n);
        close("A (Cof A)ᵀ", product_transposed(a, cofactor(a)), nalgebra::Matrix3::identity() * m.determinant());
        let scalars = [trace(a), double_contraction(a, b)];
        assert_close_at_scale("tr A, A : B", &scalars, &[m.trace(), m.dot(&n)], 9.0, Tol::ulps(4.0));
    }

    #[test]
    fn tensors_satisfy_the_equation_of_cayley_and_hamilton_with_their_principal_invariants(a in symmetric()) {
        let m = a.matrix();
        let [first, second, third] = principal_invariants(&a);
        let powers = m * m * m - m * m * first + m * second;
        let expected = nalgebra::Matrix3::identity() * third;
        assert_close_at_scale("A³ − I A² + II A = III 1", powers.as_slice(), expected.as_slice(), 1.0, Tol::ulps(64.0));
    }

    #[test]
    fn inverse_times_the_tensor_is_the_identity(a in symmetric()) {
        // Only singular tensors have none.
        let inverse = a.inverse();
        prop_assume!(inverse.is_ok());
        let inverse = inverse.expect("not refused");
        let condition = inverse.norm() * a.norm();
        let one = inverse.product(&a);
        assert_close_at_scale("A⁻¹A", one.as_flattened(), identity::<f64>().as_flattened(), 1.0, Tol::ulps(32.0).times(condition));
    }

    #[test]
    fn rotation_is_a_group_action(c in major(), d in minor(), p in rotation(), q in rotation()) {
        let both = |r: nalgebra::Matrix3<f64>| rows_of(&r);
        let (p_rows, q_rows, pq) = (both(p), both(q), both(p * q));
        let tolerance = Tol::ulps(64.0);
        assert_close("major", &all(&c.congruence(q_rows).congruence(p_rows)), &all(&c.congruence(pq)), tolerance);
        assert_close("minor", &all(&d.congruence(q_rows).congruence(p_rows)), &all(&d.congruence(pq)), tolerance);
        let back = c.rotated(&q).expect("a rotation").rotated(&q.transpose()).expect("a rotation");
        assert_close("back", &all(&back), &all(&c), tolerance);
        prop_assert!((c.rotated(&q).expect("a rotation").norm() - c.norm()).abs() <= Tol::ulps(64.0).value() * c.norm());
        let general = d.general().transformed(q_rows, q_rows);
        assert_close("general", &flat(&general), &all(&d.congruence(q_rows)), tolerance);
    }

    #[test]
    fn congruence_of_fourth_order_equals_the_map_of_second_order(c in minor(), a in symmetric(), f in deformation()) {
        // (F⁴C) : A = F (C : FᵀAF) Fᵀ.
        let pushed = c.congruence(f).contract(&a);
        let expected = c.contract(&a.transposed_congruence(f)).congruence(f);
        assert_close_at_scale("F⁴C : A", &nine(&pushed), &nine(&expected), 16.0 * c.norm() * a.norm(), Tol::ulps(16.0));
    }

    #[test]
    fn contractions_by_pairs_equal_those_by_four_indices(c in minor(), d in minor(), a in symmetric(), b in symmetric()) {
        let (g, h) = (c.general(), d.general());
        let scale = c.norm() * a.norm();
        assert_close_at_scale("C : A", &nine(&c.contract(&a)), g.contract(a.rows()).as_flattened(), scale, Tol::ulps(8.0));
        assert_close_at_scale("A : C", &nine(&c.contract_left(&a)), g.contract_left(a.rows()).as_flattened(), scale, Tol::ulps(8.0));
        let composed = flat(&g.double_contraction(&h));
        assert_close_at_scale("C : D", &all(&c.double_contraction(&d)), &composed, c.norm() * d.norm(), Tol::ulps(8.0));
        let form = c.quadratic_form(&a, &b);
        prop_assert!((form - b.double_contraction(&c.contract_left(&a))).abs() <= Tol::ulps(16.0).value() * scale * b.norm());
        prop_assert_eq!(g.minor_symmetric(), Ok(c));
    }

    #[test]
    fn dyads_map_as_their_products(a in rows(), b in rows(), c in rows(), s in symmetric(), t in symmetric(), u in symmetric()) {
        let close = |what: &str, x: [[f64; 3]; 3], y: [[f64; 3]; 3]| {
            assert_close_at_scale(what, x.as_flattened(), y.as_flattened(), 3.0, Tol::ulps(16.0));
        };
        close("A C Bᵀ", FourthOrder::upper_dyad(a, b).contract(c), product_transposed(product(a, c), b));
        close("A Cᵀ Bᵀ", FourthOrder::lower_dyad(a, b).contract(c), product_transposed(product(a, transpose(c)), b));
        close("S U S", MajorSymmetric::square_dyad(&s).contract(&u).rows(), u.congruence(s.rows()).rows());
        let mean = MajorSymmetric::symmetric_square_dyad(&s, &t).contract(&u).rows();
        close("½ (S U T + T U S)", mean, Symmetric::symmetric_part(product(product(s.rows(), u.rows()), t.rows())).rows());
        let dyad = MajorSymmetric::dyad(&s).contract(&u);
        close("S S : U", dyad.rows(), (s * s.double_contraction(&u)).rows());
        let dyad = MajorSymmetric::symmetric_dyad(&s, &t).contract(&u);
        let expected = (s * t.double_contraction(&u) + t * s.double_contraction(&u)) * 0.5;
        close("sym S T : U", dyad.rows(), expected.rows());
    }

    #[test]
    fn voigt_round_trips_are_exact(a in symmetric(), c in minor()) {
        macro_rules! order {
            ($order:ty) => {
                prop_assert_eq!(StressVector::<f64, $order>::of(&a).tensor(), a);
                prop_assert_eq!(StrainVector::<f64, $order>::of(&a).tensor(), a);
                prop_assert_eq!(StiffnessMatrix::<f64, $order>::of(&c).tensor(), c);
                prop_assert_eq!(ComplianceMatrix::<f64, $order>::of(&c).tensor(), c);
                let there = StrainVector::<f64, Piola>::of(&a).reordered::<$order>();
                prop_assert_eq!(there, StrainVector::<f64, $order>::of(&a));
                prop_assert_eq!(there.reordered::<Piola>(), StrainVector::of(&a));
                let there = ComplianceMatrix::<f64, Abaqus>::of(&c).reordered::<$order>();
                prop_assert_eq!(there, ComplianceMatrix::<f64, $order>::of(&c));
                let mandel = MandelVector::<f64, $order>::of(&a).tensor();
                assert_close("Mandel", &nine(&mandel), &nine(&a), Tol::ulps(2.0));
                let mandel = MandelMatrix::<f64, $order>::of(&c).tensor();
                assert_close("Mandel", &all(&mandel), &all(&c), Tol::ulps(2.0));
            };
        }
        order!(Piola);
        order!(Abaqus);
        order!(BroNielsen);
        order!(Classical);
    }

    #[test]
    fn voigt_products_equal_contractions_of_tensors(c in minor(), a in symmetric(), b in symmetric()) {
        let expected = c.contract(&a);
        let scale = c.norm() * a.norm();
        let stress = StiffnessMatrix::<f64, Abaqus>::of(&c) * StrainVector::of(&a);
        assert_close_at_scale("C ε", &nine(&stress.tensor()), &nine(&expected), scale, Tol::ulps(8.0));
        let strain = ComplianceMatrix::<f64, Classical>::of(&c) * StressVector::of(&a);
        assert_close_at_scale("S σ", &nine(&strain.tensor()), &nine(&expected), scale, Tol::ulps(8.0));
        let mandel = MandelMatrix::<f64>::of(&c) * MandelVector::of(&a);
        assert_close_at_scale("Mandel", &nine(&mandel.tensor()), &nine(&expected), scale, Tol::ulps(8.0));
        let power = StressVector::<f64, Classical>::of(&b).dot(&StrainVector::of(&a));
        prop_assert!((power - a.double_contraction(&b)).abs() <= Tol::ulps(8.0).value() * a.norm() * b.norm());
    }

    #[test]
    fn mandel_map_is_an_isometry(a in symmetric(), b in symmetric(), c in minor(), d in minor()) {
        let (u, v) = (MandelVector::<f64, Abaqus>::of(&a), MandelVector::of(&b));
        prop_assert!((u.norm() - a.norm()).abs() <= Tol::ulps(4.0).value() * a.norm());
        prop_assert!((u.dot(&v) - a.double_contraction(&b)).abs() <= Tol::ulps(4.0).value() * a.norm() * b.norm());
        let (m, n) = (MandelMatrix::<f64, Abaqus>::of(&c).matrix(), MandelMatrix::<f64, Abaqus>::of(&d).matrix());
        prop_assert!((m.norm() - c.norm()).abs() <= Tol::ulps(8.0).value() * c.norm());
        let composed = MandelMatrix::<f64, Abaqus>::of(&c.double_contraction(&d)).matrix();
        assert_close_at_scale("C : D", composed.as_slice(), (m * n).as_slice(), c.norm() * d.norm(), Tol::ulps(8.0));
    }

    #[test]
    fn compliance_of_the_stiffness_is_its_inverse(c in major()) {
        // A positive definite tangent: the map A ↦ A plus a little of anything.
        let c = MajorSymmetric::identity() + c * 0.05;
        let stiffness = StiffnessMatrix::<f64, Abaqus>::of(&c);
        let compliance = stiffness.compliance().expect("regular");
        let one = stiffness.matrix() * compliance.matrix();
        assert_close_at_scale("C S", one.as_slice(), nalgebra::Matrix6::<f64>::identity().as_slice(), 1.0, Tol::ulps(16.0));
        let back = compliance.stiffness().expect("regular").tensor();
        assert_close("(C⁻¹)⁻¹", &all(&back), &all(&c), Tol::ulps(16.0));
        assert_close("C⁻¹", &all(&c.inverse().expect("regular")), &all(&compliance.tensor()), Tol::ulps(16.0));
    }

}

proptest! {
    // 6561 products of four factors each are slow: fewer cases.
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn congruences_in_two_stages_equal_eight_loops(c in minor(), s in major(), f in rows()) {
        let tolerance = Tol::ulps(64.0);
        let scale = 9.0;
        assert_close_at_scale("minor", &all(&c.congruence(f)), &flat(&by_eight_loops(f, &c.general())), scale, tolerance);
        assert_close_at_scale("major", &all(&s.congruence(f)), &flat(&by_eight_loops(f, &s.general())), scale, tolerance);
        let general = c.general();
        assert_close_at_scale("general", &flat(&general.transformed(f, f)), &flat(&by_eight_loops(f, &general)), scale, tolerance);
    }
}

#[test]
fn projectors_are_idempotent_and_orthogonal_and_add_up() {
    let (one, spherical, deviatoric) =
        (MajorSymmetric::<f64>::identity(), MajorSymmetric::spherical(), MajorSymmetric::deviatoric());
    let close = |what: &str, a: Vec<f64>, b: Vec<f64>| assert_close_at_scale(what, &a, &b, 1.0, Tol::ulps(2.0));
    close("sum", all(&(spherical + deviatoric)), all(&one));
    close("P P", all(&spherical.double_contraction(&spherical)), all(&spherical));
    close("D D", all(&deviatoric.double_contraction(&deviatoric)), all(&deviatoric));
    close("P D", all(&spherical.double_contraction(&deviatoric)), all(&MinorSymmetric::zero()));
    let (symmetric, skew) = (FourthOrder::<f64>::symmetrizer(), FourthOrder::skew_projector());
    close("1", flat(&(symmetric + skew)), flat(&FourthOrder::identity()));
    close("S W", flat(&symmetric.double_contraction(&skew)), flat(&FourthOrder::zero()));
    close("W W", flat(&skew.double_contraction(&skew)), flat(&skew));
    close("S", flat(&symmetric), all(&one));
    close("⅓ 1 ⊗ 1", flat(&FourthOrder::spherical()), all(&spherical));
    // Dimensions 1 and 5 are the squares of the norms.
    assert_close("|P|²", &[spherical.norm().powi(2), deviatoric.norm().powi(2)], &[1.0, 5.0], Tol::ulps(4.0));
}
