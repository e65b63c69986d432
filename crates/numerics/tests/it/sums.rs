//! Compensated sums against sums of whole numbers, which are exact.

use piola_numerics::sums::{CompensatedSum, compensated_add, compensated_dot, compensated_sum, two_product, two_sum};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::strategies::{finite, vector};
use piola_testkit::{Tol, assert_close};
use proptest::prelude::*;

/// A float as a whole number of 2⁻⁶⁰.
fn exact(x: f64) -> i128 {
    let scaled = x * 2.0_f64.powi(60);
    assert!(scaled.fract().abs() <= 0.0 && scaled.abs() < 2.0_f64.powi(126), "{x:e} is not such a number");
    #[expect(clippy::cast_possible_truncation, reason = "the number was just found to be whole and small enough")]
    let whole = scaled as i128;
    whole
}

/// Numbers of very different size that are whole multiples of 2⁻⁶⁰.
fn multiples() -> impl Strategy<Value = f64> {
    (-(1_i64 << 52)..1_i64 << 52, -60..8_i32).prop_map(|(mantissa, exponent)| mantissa as f64 * 2.0_f64.powi(exponent))
}

proptest! {
    #[test]
    fn sum_and_error_equal_both_terms(a in multiples(), b in multiples()) {
        let (sum, error) = two_sum(a, b);
        prop_assert_eq!(sum.to_bits(), (a + b).to_bits());
        prop_assert_eq!(exact(sum) + exact(error), exact(a) + exact(b));
    }

    #[test]
    fn product_and_error_equal_both_factors(a in -(1_i64 << 53)..1_i64 << 53, b in -(1_i64 << 53)..1_i64 << 53) {
        let (product, error) = two_product(a as f64, b as f64);
        #[expect(clippy::cast_possible_truncation, reason = "both are whole numbers")]
        let both = product as i128 + error as i128;
        prop_assert_eq!(both, i128::from(a) * i128::from(b));
    }

    #[test]
    fn product_and_error_in_single_precision_equal_the_product_in_double(a in finite(-8.0..8.0), b in finite(-8.0..8.0)) {
        let (a, b) = (f32::lit(a), f32::lit(b));
        let (product, error) = two_product(a, b);
        // Errors below 2⁻¹⁴⁹ do not exist in f32; factors above 2⁻⁴⁰ have none.
        prop_assume!(2.0_f32.powi(-40) < a.abs() && 2.0_f32.powi(-40) < b.abs());
        prop_assert_eq!((f64::from(product) + f64::from(error)).to_bits(), (f64::from(a) * f64::from(b)).to_bits());
    }

    #[test]
    fn compensated_sum_equals_exact_sum(terms in proptest::collection::vec(multiples(), 1..200)) {
        let total: i128 = terms.iter().map(|&x| exact(x)).sum();
        let size: f64 = terms.iter().map(|x| x.abs()).sum();
        let n = terms.len() as f64;
        let error = (exact(compensated_sum(&terms)) - total).unsigned_abs() as f64 * 2.0_f64.powi(-60);
        let sum = total as f64 * 2.0_f64.powi(-60);
        prop_assert!(error <= f64::EPSILON * sum.abs() + n * n * f64::EPSILON * f64::EPSILON * size);
    }

    #[test]
    fn compensated_sum_equals_that_in_reverse(mut terms in proptest::collection::vec(finite(-1.0..1.0), 1..500)) {
        let forwards = compensated_sum(&terms);
        terms.reverse();
        let size: f64 = terms.iter().map(|x| x.abs()).sum();
        let n = terms.len() as f64;
        let bound = f64::EPSILON * forwards.abs() + 2.0 * n * n * f64::EPSILON * f64::EPSILON * size;
        prop_assert!((forwards - compensated_sum(&terms)).abs() <= bound);
    }

    #[test]
    fn terms_and_their_opposites_sum_to_one(terms in proptest::collection::vec(multiples(), 1..100)) {
        let mut sum: CompensatedSum<f64> = terms.iter().copied().collect();
        sum.add(1.0);
        sum.extend(terms.iter().map(|x| -x));
        let size: f64 = terms.iter().map(|x| x.abs()).sum();
        // Twice the precision of the largest terms.
        let scale = (size * f64::EPSILON).max(1.0);
        let n = terms.len() as f64;
        assert_close("1", &[sum.value()], &[1.0], Tol::ulps(1.0).times(4.0 * n * n * scale));
    }

    #[test]
    fn compensated_dot_equals_exact_dot(
        a in proptest::collection::vec(-(1_i64 << 40)..1_i64 << 40, 20),
        b in proptest::collection::vec(-(1_i64 << 40)..1_i64 << 40, 20),
    ) {
        let total: i128 = a.iter().zip(&b).map(|(&a, &b)| i128::from(a) * i128::from(b)).sum();
        let floats = |v: &[i64]| v.iter().map(|&x| x as f64).collect::<Vec<_>>();
        let dot = compensated_dot(&floats(&a), &floats(&b)).unwrap();
        // The products have 80 bits, twice the precision 106: only the last rounding is left.
        assert_close("a·b", &[dot], &[total as f64], Tol::ulps(1.0));
    }

    #[test]
    fn state_after_many_increments_equals_state_plus_their_sum(y in vector(3, -1.0..1.0), increment in finite(-1e-9..1e-9)) {
        let (mut state, mut carry) = (y.clone(), vec![0.0; 3]);
        for _ in 0..1000 {
            compensated_add(&mut state, &mut carry, &[increment; 3]).unwrap();
        }
        let expected: Vec<f64> = y.iter().map(|y| y + 1000.0 * increment).collect();
        // 1000 · increment is rounded once itself, and so is the sum.
        assert_close("y + Σ dy", &state, &expected, Tol::ulps(1.0));
    }
}

#[test]
fn overflow_gives_the_plain_sum() {
    assert!(compensated_sum(&[f64::MAX, f64::MAX]).is_infinite());
    assert!(compensated_sum(&[1.0, f64::INFINITY, 2.0]).is_infinite());
    assert!(compensated_sum(&[1.0, f64::NAN]).is_nan());
}

#[test]
fn derivatives_and_lanes_of_a_sum_are_compensated() {
    let terms = [1.0, 1e100, 1.0, -1e100];
    let duals = terms.map(|x| Dual::new(2.0 * x, x));
    assert_close("Σ", &[compensated_sum(&duals).value, compensated_sum(&duals).tangent], &[4.0, 2.0], Tol::ulps(0.0));
    let lanes = terms.map(|x| Lanes::<f64, 2>::from([x, -x]));
    let sum = compensated_sum(&lanes);
    assert_close("Σ", &[sum.primal(0), sum.primal(1)], &[2.0, -2.0], Tol::ulps(0.0));
}

#[test]
fn sums_of_unequal_lengths_are_refused() {
    assert!(compensated_dot(&[1.0], &[1.0, 2.0]).is_err());
    let (mut y, mut carry) = ([1.0, 2.0], [0.0; 2]);
    assert!(compensated_add(&mut y, &mut carry, &[1.0]).is_err());
    assert!(compensated_add(&mut y, &mut carry[..1], &[1.0, 1.0]).is_err());
    assert_close("y", &y, &[1.0, 2.0], Tol::ulps(0.0));
}
