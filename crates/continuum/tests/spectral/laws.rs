//! Identities of decompositions and functions of tensors, 10 000 cases each.

use nalgebra::Matrix3;
use piola_continuum::Symmetric;
use piola_continuum::spectral::{Exponential, Logarithm, Power, SquareRoot, decompose, tensor_function};
use piola_testkit::spectral::{Rows, with_stretches};
use piola_testkit::strategies::{finite, rotation, rotation_matrix, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{analysis, flat, matrix, orthogonality, size, symmetric};

fn of(list: &[f64]) -> Symmetric {
    Symmetric { components: core::array::from_fn(|i| list[i]) }
}

fn rows(m: &Matrix3<f64>) -> Rows<f64> {
    core::array::from_fn(|i| core::array::from_fn(|j| m[(i, j)]))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

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

    #[test]
    fn tensor_equals_the_sum_of_its_eigenvalues_times_dyads(list in vector(6, -1.0..1.0), exponent in finite(-100.0..100.0)) {
        let a = of(&list) * 10.0_f64.powf(exponent);
        let decomposition = decompose(&a);
        let sum = with_stretches(&transposed(&decomposition.vectors), decomposition.values, &transposed(&decomposition.vectors));
        assert_close("Σ λ v ⊗ v", &sum.concat(), &flat(&a), Tol::ulps(16.0));
        prop_assert!(orthogonality(decomposition.vectors) <= 6.0 * f64::EPSILON);
        prop_assert!(decomposition.values[2] <= decomposition.values[1]);
        prop_assert!(decomposition.values[1] <= decomposition.values[0]);
        prop_assert!(0.0 < matrix(decomposition.vectors).determinant());
    }

    #[test]
    fn exponential_of_logarithm_equals_the_tensor(q in rotation(), logs in vector(3, -1.5..1.5)) {
        let q = rotation_matrix(q);
        let a = symmetric(with_stretches(&q, core::array::from_fn(|k| logs[k].exp()), &q));
        let back = tensor_function(&Exponential, &tensor_function(&Logarithm, &a));
        assert_close("exp ln A", &flat(&back), &flat(&a), Tol::ulps(64.0));
    }

    #[test]
    fn square_of_square_root_equals_the_tensor(q in rotation(), logs in vector(3, -3.0..3.0)) {
        let q = rotation_matrix(q);
        let a = symmetric(with_stretches(&q, core::array::from_fn(|k| logs[k].exp()), &q));
        let root = tensor_function(&SquareRoot, &a).matrix();
        assert_close("√A √A", &rows(&(root * root)).concat(), &flat(&a), Tol::ulps(32.0));
        let power = tensor_function(&Power(0.5), &a).matrix();
        assert_close("A^½", &rows(&power).concat(), &rows(&root).concat(), Tol::ulps(32.0));
    }

    #[test]
    fn function_of_turned_tensor_equals_turned_function(q in rotation(), list in vector(6, -1.0..1.0)) {
        let (q, a) = (matrix(rotation_matrix(q)), of(&list));
        let turned = symmetric(rows(&(q * a.matrix() * q.transpose())));
        let function = q * tensor_function(&Exponential, &a).matrix() * q.transpose();
        let tol = Tol::ulps(32.0);
        assert_close("e^(Q A Qᵀ)", &flat(&tensor_function(&Exponential, &turned)), &rows(&function).concat(), tol);
    }
}

fn transposed(a: &Rows<f64>) -> Rows<f64> {
    core::array::from_fn(|i| core::array::from_fn(|j| a[j][i]))
}
