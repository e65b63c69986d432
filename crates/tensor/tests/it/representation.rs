//! Isotropic functions in powers of their argument: the three cases of eigenvalues, and functions that are not isotropic.

use piola_tensor::spectral::{EigenvalueCase, Exponential, representation, tensor_function};
use piola_tensor::{Symmetric, TensorError};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

/// Q diag(values) Qᵀ.
fn turned(values: [f64; 3], quaternion: [f64; 4]) -> Symmetric {
    let rows = strategies::rotation_matrix(quaternion);
    let q = nalgebra::Matrix3::from_fn(|i, j| rows[i][j]);
    let product = q * nalgebra::Matrix3::from_diagonal(&values.into()) * q.transpose();
    Symmetric::symmetric_part(core::array::from_fn(|i| core::array::from_fn(|j| product[(i, j)])))
}

const GAP: f64 = 1e-9;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn polynomials_of_cayley_and_hamilton_are_the_coefficients_of_a_cube_and_an_inverse(
        low in 0.4..1.0_f64, steps in strategies::vector(2, 0.2..1.5), quaternion in strategies::rotation(),
    ) {
        let (a, b, c) = (low, low + steps[0], low + steps[0] + steps[1]);
        let (first, second, third) = (a + b + c, a * b + b * c + a * c, a * b * c);
        let argument = turned([a, b, c], quaternion);
        // A³ + 2 A⁻¹ with A³ = I A² − II A + III and A⁻¹ = (A² − I A + II)/III.
        let value = turned([a, b, c].map(|x| x * x * x + 2.0 / x), quaternion);
        let expected = [third + 2.0 * second / third, -second - 2.0 * first / third, first + 2.0 / third];
        let found = representation(&argument, &value, GAP).expect("finite");
        prop_assert_eq!(found.case, EigenvalueCase::Three);
        let condition = value.norm() * c * c / (steps[0] * steps[1]);
        assert_close_at_scale("γ", &found.coefficients, &expected, condition, Tol::ulps(64.0));
        prop_assert!(found.residual < 64.0 * f64::EPSILON * condition / value.norm());
    }

    #[test]
    fn two_equal_eigenvalues_need_the_first_power_and_three_the_unit_tensor_alone(
        low in 0.4..1.0_f64, step in 0.2..1.5_f64, upper: bool, quaternion in strategies::rotation(),
    ) {
        let high = low + step;
        let values = if upper { [high, low, low] } else { [low, high, high] };
        let argument = turned(values, quaternion);
        let found = representation(&argument, &tensor_function(&Exponential, &argument), GAP).expect("finite");
        prop_assert_eq!(found.case, EigenvalueCase::Two);
        // The straight line through exp at both values.
        let slope = (high.exp() - low.exp()) / step;
        let expected = [low.exp() - slope * low, slope, 0.0];
        assert_close_at_scale("γ", &found.coefficients, &expected, high.exp() / step, Tol::ulps(64.0));
        prop_assert!(found.residual < 64.0 * f64::EPSILON * high / step);

        let sphere = turned([low; 3], quaternion);
        let found = representation(&sphere, &tensor_function(&Exponential, &sphere), GAP).expect("finite");
        prop_assert_eq!(found.case, EigenvalueCase::One);
        assert_close("γ₀", &found.coefficients[..1], &[low.exp()], Tol::ulps(16.0));
        assert_eq!(&found.coefficients[1..], &[0.0, 0.0]);
    }
}

#[test]
fn functions_that_prefer_a_direction_are_refuted_in_every_case() {
    let preferred = Symmetric::dyad([0.6, 0.8, 0.0]);
    for values in [[1.0, 2.0, 3.0], [1.0, 1.0, 3.0], [2.0, 2.0, 2.0]] {
        let argument = Symmetric::diagonal(values);
        let isotropic = representation(&argument, &argument.square(), GAP).expect("finite");
        assert!(isotropic.residual < 4.0 * f64::EPSILON, "{isotropic:?}");
        let skewed = representation(&argument, &(argument.square() + preferred), GAP).expect("finite");
        assert!(0.05 < skewed.residual, "{skewed:?}");
    }
}

#[test]
fn zero_tensors_have_a_representation_and_numbers_that_are_none_are_refused() {
    let found = representation(&Symmetric::zero(), &Symmetric::zero(), GAP).expect("finite");
    assert_eq!((found.case, found.coefficients, found.residual), (EigenvalueCase::One, [0.0; 3], 0.0));
    let nan = Symmetric::new(1.0, f64::NAN, 0.0, 0.0, 0.0, 0.0);
    let refused = representation(&nan, &Symmetric::zero(), GAP);
    assert!(matches!(refused, Err(TensorError::NotFinite { quantity: "argument", index: 1, .. })));
    let refused = representation(&Symmetric::zero(), &nan, GAP);
    assert!(matches!(refused, Err(TensorError::NotFinite { quantity: "value", .. })));
    assert!(representation(&Symmetric::zero(), &Symmetric::zero(), f64::NAN).is_err());
    assert!(representation(&Symmetric::zero(), &Symmetric::zero(), -1.0).is_err());
}
