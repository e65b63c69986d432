//! Identities of decompositions and functions of tensors, 10 000 cases each.

use nalgebra::Matrix3;
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::apply;
use piola_tensor::internal::spectral::{gram, unturned_frame};
use piola_tensor::spectral::{Exponential, Logarithm, Power, SquareRoot, decompose, tensor_function};
use piola_testkit::spectral::{Rows, with_stretches};
use piola_testkit::strategies::{finite, random_cases, rotation, rotation_matrix, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::cases::{flat, matrix, orthogonality, symmetric};

fn of(list: &[f64]) -> Symmetric {
    Symmetric { components: core::array::from_fn(|i| list[i]) }
}

fn rows(m: &Matrix3<f64>) -> Rows<f64> {
    core::array::from_fn(|i| core::array::from_fn(|j| m[(i, j)]))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

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
    fn images_of_a_principal_frame_are_those_of_its_axes(list in vector(6, -1.0..1.0), entries in vector(9, -1.0..1.0)) {
        let frame = unturned_frame(&of(&list));
        let f: Rows<f64> = core::array::from_fn(|i| core::array::from_fn(|j| entries[3 * i + j]));
        let (images, products) = frame.images(f);
        let expected = frame.axes().map(|axis| apply(f, axis));
        assert_close_at_scale("F q", images.as_flattened(), expected.as_flattened(), 1.0, Tol::ulps(8.0));
        assert_close_at_scale("F q · F q", &products, &gram(&expected), 1.0, Tol::ulps(16.0));
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
