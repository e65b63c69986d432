//! The exponential of a tensor, its derivative, and the logarithm.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;
use piola_continuum::rates::{
    exponential, exponential_derivative, exponential_minus_identity, exponential_rows, logarithm,
    rotation_minus_identity,
};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{determinant, from_rows, rows_of};
use piola_tensor::Skew;
use piola_testkit::strategies::{random_cases, rotation, rotation_matrix, vector};
use piola_testkit::{DoubleDouble, Tol};
use proptest::prelude::*;

use super::super::cases::assert_same;

fn matrices(size: f64) -> impl Strategy<Value = Matrix3<f64>> {
    vector(9, -size..size).prop_map(|x| Matrix3::from_row_slice(&x))
}

fn exp(a: &Matrix3<f64>) -> Matrix3<f64> {
    exponential(a).expect("finite")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn exponential_times_that_of_the_opposite_equals_identity(a in matrices(2.0)) {
        let (e, inverse) = (exp(&a), exp(&-a));
        let tol = Tol::ulps(64.0).times(e.norm() * inverse.norm());
        assert_same("exp A exp −A = 1", &(e * inverse), &Matrix3::identity(), 1.0, tol);
        let determinant = determinant(rows_of(&e));
        let scale = e.norm().powi(3);
        piola_testkit::assert_close_at_scale("det exp A = exp tr A", &[determinant], &[a.trace().exp()], scale, Tol::ulps(64.0));
        let less = exponential_minus_identity(&a).expect("finite");
        assert_same("(exp A − 1) + 1", &(less + Matrix3::identity()), &e, 1.0, Tol::ulps(4.0));
    }

    #[test]
    fn exponential_equals_itself_in_twice_the_precision(a in matrices(3.0), shrink in 0..12_i32) {
        let a = a * 10.0_f64.powi(-shrink);
        let wide = exponential_rows(rows_of(&a.map(DoubleDouble::lit)));
        let e = exp(&a);
        let rounding = from_rows(wide).zip_map(&e, DoubleDouble::rounding_of);
        // The condition number by Frobenius' norm of the derivative, at least |A|.
        let condition = (0..9).map(|k| {
            let mut direction = Matrix3::zeros();
            direction[k] = 1.0;
            exponential_derivative(&a, &direction).expect("finite").1.norm_squared()
        }).sum::<f64>().sqrt() * a.norm() / e.norm();
        let tol = Tol::ulps(8.0).times(condition.max(1.0));
        assert_same("rounding of exp A", &rounding, &Matrix3::zeros(), e.norm(), tol);
        let less = exponential_minus_identity(&a).expect("finite");
        let wide = piola_continuum::rates::exponential_minus_identity_rows(rows_of(&a.map(DoubleDouble::lit)));
        let rounding = from_rows(wide).zip_map(&less, DoubleDouble::rounding_of);
        let tol = Tol::ulps(8.0).times((condition * e.norm() / less.norm()).max(1.0));
        assert_same("rounding of exp A − 1", &rounding, &Matrix3::zeros(), less.norm(), tol);
    }

    #[test]
    fn exponential_in_another_frame_equals_turned_exponential(a in matrices(2.0), q in rotation()) {
        let q = Matrix3::from_row_slice(rotation_matrix(q).as_flattened());
        let turned = exp(&(q * a * q.transpose()));
        let e = exp(&a);
        let tol = Tol::ulps_because(128.0, "some eight squarings, and two rotations").times(exp(&a.abs()).norm() / e.norm());
        assert_same("exp QAQᵀ = Q exp A Qᵀ", &turned, &(q * e * q.transpose()), 1.0, tol);
    }

    #[test]
    fn derivative_of_exponential_equals_that_of_differentiable_numbers(a in matrices(2.0), e in matrices(1.0)) {
        let (value, derivative) = exponential_derivative(&a, &e).expect("finite");
        let both = a.zip_map(&e, Dual64::new);
        let expected = exponential(&both).expect("finite").map(|x| x.eps);
        let scale = exp(&a.abs()).norm();
        assert_same("exp A", &value, &exp(&a), scale, Tol::ulps(64.0));
        assert_same("D exp A [E]", &derivative, &expected, scale, Tol::ulps(64.0));
        // Along A itself it is A exp A; and the trace of exp A has the derivative tr(exp A E).
        let (_, along) = exponential_derivative(&a, &a).expect("finite");
        assert_same("D exp A [A] = A exp A", &along, &(a * value), scale * 6.0, Tol::ulps(64.0));
        let traces = ([derivative.trace()], [(value * e).trace()]);
        piola_testkit::assert_close_at_scale("tr D exp A [E]", &traces.0, &traces.1, scale, Tol::ulps(64.0));
    }

    #[test]
    fn logarithm_of_exponential_equals_its_argument(a in matrices(0.6), shrink in 0..14_i32) {
        let a = a * 10.0_f64.powi(-shrink);
        let back = logarithm(&exponential_minus_identity(&a).expect("finite")).expect("no negative eigenvalue");
        let condition = exp(&a.abs()).norm() * exp(&(a.abs() * 1.0)).norm();
        assert_same("ln exp A = A", &back, &a, 0.0, Tol::ulps(16.0).times(condition));
    }

    #[test]
    fn exponential_of_logarithm_equals_its_argument(f in matrices(0.5)) {
        // Within |F − 1| ≤ 1.5 an eigenvalue may still be negative: then it is refused and not wrong.
        let log = logarithm(&f);
        prop_assume!(log.is_ok());
        let log = log.expect("not refused");
        let back = exponential_minus_identity(&log).expect("finite");
        let condition = (log.norm() * 2.0).exp() * exp(&-log).norm().powi(2);
        assert_same("exp ln F = F", &back, &f, 1.0, Tol::ulps(64.0).times(condition));
    }

    #[test]
    fn exponential_of_a_skew_tensor_equals_rotation(axis in vector(3, -40.0..40.0), shrink in 0..10_i32) {
        let w = Vector3::from_column_slice(&axis) * 10.0_f64.powi(-shrink);
        let skew = from_rows(Skew::new(w.x, w.y, w.z).rows());
        let r = exp(&skew);
        assert_same("RᵀR = 1", &(r.transpose() * r), &Matrix3::identity(), 1.0, Tol::ulps(8.0));
        let turned = r * w;
        piola_testkit::assert_close_at_scale("R ω = ω", turned.as_slice(), w.as_slice(), 0.0, Tol::ulps(8.0));
        // A perturbation of one part in 2⁵² takes the general way.
        let angle = w.norm();
        let close = Tol::ulps(64.0).times(1.0 + angle * angle);
        let mut general = skew;
        general[(0, 0)] = f64::EPSILON * angle;
        assert_same("exp of nearly skew", &exp(&general), &r, 1.0, close);
        let less = from_rows(rotation_minus_identity(rows_of(&skew)));
        assert_same("R − 1", &exponential_minus_identity(&skew).expect("finite"), &less, 0.0, Tol::ulps(0.0));
    }
}

#[test]
fn exponential_of_a_large_entry_opposite_a_small_one_is_hyperbolic() {
    // Of the plane (i, j) with A_ij = 1 and A_ji = 4² the square is 4² 1: exp A = cosh 4 1 + sinh 4/4 A.
    for (i, j) in [(0, 1), (1, 0), (1, 2), (2, 1), (0, 2), (2, 0)] {
        let (mut a, mut expected) = (Matrix3::zeros(), Matrix3::identity());
        a[(i, j)] = 1.0;
        a[(j, i)] = 16.0;
        expected[(i, i)] = 4.0_f64.cosh();
        expected[(j, j)] = 4.0_f64.cosh();
        expected += a * (0.25 * 4.0_f64.sinh());
        assert_same(&format!("exp A, {i} {j}"), &exp(&a), &expected, 1.0, Tol::ulps(32.0));
    }
}
