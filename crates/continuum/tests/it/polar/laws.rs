//! Identities of polar decompositions, 10 000 cases each.

use nalgebra::Matrix3;
use piola_testkit::spectral::{Rows, with_stretches};
use piola_testkit::strategies::{random_cases, rotation, rotation_matrix, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{analysis, flat, matrix, orthogonality, size, symmetric};

fn rows(m: &Matrix3<f64>) -> Rows<f64> {
    core::array::from_fn(|i| core::array::from_fn(|j| m[(i, j)]))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn polar_factors_equal_those_the_gradient_was_made_of(r in rotation(), q in rotation(), logs in vector(3, -1.15..1.15)) {
        let stretches: [f64; 3] = core::array::from_fn(|k| logs[k].exp());
        let (r, q) = (matrix(rotation_matrix(r)), rotation_matrix(q));
        let u = symmetric(with_stretches(&q, stretches, &q));
        let stretch = analysis(rows(&(r * u.matrix())));
        let condition = size(&stretches) / stretches.iter().copied().fold(f64::MAX, f64::min);
        let tol = Tol::ulps(8.0).times(condition);
        assert_close("R", &stretch.rotation().concat(), &rows(&r).concat(), tol);
        assert_close("U", &flat(&stretch.right_stretch()), &flat(&u), Tol::ulps(16.0));
        let v = rows(&(r * u.matrix() * r.transpose()));
        assert_close("V", &flat(&stretch.left_stretch()), &v.concat(), Tol::ulps(32.0));
        let determinant = matrix(stretch.rotation()).determinant();
        assert_close("det R", &[determinant], &[1.0], Tol::ulps(16.0));
        prop_assert!(orthogonality(stretch.rotation()) <= 8.0 * f64::EPSILON);
        let inverse = matrix(stretch.inverse_right_stretch().rows()) * u.matrix();
        assert_close("U⁻¹ U", &rows(&inverse).concat(), &rows(&Matrix3::identity()).concat(), tol);
    }

    #[test]
    fn axes_turned_by_the_rotation_equal_spatial_axes(r in rotation(), q in rotation(), logs in vector(3, -1.0..1.0)) {
        let stretches = core::array::from_fn(|k| logs[k].exp());
        let stretch = analysis(with_stretches(&rotation_matrix(r), stretches, &rotation_matrix(q)));
        let turned = matrix(stretch.material_axes()) * matrix(stretch.rotation()).transpose();
        assert_close("R q", &stretch.spatial_axes().concat(), &rows(&turned).concat(), Tol::ulps(16.0));
        let [a, b, c] = stretch.principal_stretches();
        prop_assert!(c <= b && b <= a);
        let greens = stretch.principal_green_strains();
        assert_close_at_scale("E", &greens, &[a, b, c].map(|x| (x * x - 1.0) / 2.0), a * a, Tol::ulps(4.0));
        prop_assert!(0.0 < matrix(stretch.material_axes()).determinant());
    }
}
