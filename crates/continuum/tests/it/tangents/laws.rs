//! Push-forward and pull-back.

use piola_continuum::deformation::transport;
use piola_continuum::stress::tangents::MaterialTangent;
use piola_continuum::{Deformation, SecondPiola};
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::{Minor, MinorSymmetric};
use piola_testkit::strategies::{self, random_cases};
use piola_testkit::{Tol, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{all, deformation, nine, rows, skew, symmetric};

const ROUND_TRIP: Tol = Tol::ulps_because(2048.0, "F and its inverse twice each, stretches from 1/2 to 2");

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn push_forwards_and_pull_backs_undo_one_another(d in deformation(), a in symmetric(), w in skew(), g in rows()) {
        let v = w.axial_vector();
        let close = |what: &str, x: &[f64], y: &[f64]| assert_close_at_scale(what, x, y, 1.0, ROUND_TRIP);
        close("vector", transport::pull_vector(&d, &transport::push_vector(&d, &v)).as_slice(), v.as_slice());
        close("covector", transport::pull_covector(&d, &transport::push_covector(&d, &v)).as_slice(), v.as_slice());
        let there = transport::push_contravariant(&d, &a);
        close("contravariant", &nine(&transport::pull_contravariant(&d, &there)), &nine(&a));
        let covariant = transport::push_covariant(&d, &a);
        close("covariant", &nine(&transport::pull_covariant(&d, &covariant)), &nine(&a));
        let g = from_rows(g);
        close("mixed", transport::pull_mixed(&d, &transport::push_mixed(&d, &g)).as_slice(), g.as_slice());
        // Products of unlike tensors do not change.
        close("A : A", &[there.double_contraction(&covariant)], &[a.double_contraction(&a)]);
        let product = transport::push_vector(&d, &v).dot(&transport::push_covector(&d, &v));
        close("v · v", &[product], &[v.dot(&v)]);
    }
    /// ∂P/∂F of a ∂S/∂E without major symmetry, pushed forward directly, is F F F F ∂S/∂E over J.
    #[test]
    fn spatial_tangents_of_first_piola_are_push_forwards_of_the_material_tangent(
        d in deformation(), s in symmetric(), c in strategies::vector(36, -1.0..1.0)
    ) {
        let components = core::array::from_fn(|row| core::array::from_fn(|column| c[6 * row + column]));
        let material = MaterialTangent::<f64, Minor>(MinorSymmetric { components });
        let stress = SecondPiola(s);
        let cauchy = stress.kirchhoff(&d).cauchy(&d);
        let found = material.first_piola(&stress, &d).spatial(&cauchy, &d);
        let expected = material.truesdell(&d);
        // |F| ≤ 2: the largest entries of F F F F C/J.
        let scale = 16.0 * d.jacobian().recip().max(1.0);
        assert_close_at_scale("c/J", &all(&found.0), &all(&expected.0), scale, ROUND_TRIP);
        let found = found.jaumann(&cauchy);
        assert_close_at_scale("Jaumann", &all(&found.0), &all(&expected.jaumann(&cauchy).0), scale, ROUND_TRIP);
    }
}
