//! The test kit refuses what it must: a tolerance that lets NaN pass would make every other test idle.

use std::panic::{AssertUnwindSafe, catch_unwind};

use piola_numerics::Real;
use piola_testkit::strategies::{positive_definite, rotation, rotation_matrix, unit_vector};
use piola_testkit::{
    CountingAllocator, DoubleDouble, Tol, allocations_in, assert_close, assert_close_at_scale, assert_each_close,
    assert_each_close_at_scales, assert_order, condition_number, golden, relative_error, ulps_between,
};
use proptest::prelude::*;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// Whether a check fails.
fn fails(check: impl FnOnce()) -> bool {
    catch_unwind(AssertUnwindSafe(check)).is_err()
}

#[test]
fn numbers_apart_are_not_close() {
    assert_close("equal", &[1.0, 2.0], &[1.0, 2.0], Tol::ulps(0.0));
    assert_close("zero", &[f64::EPSILON], &[0.0], Tol::ulps(1.0));
    assert_close_at_scale("cancelled", &[1e-13], &[0.0], 1e3, Tol::ulps(1.0));
    assert_close("infinite", &[f64::INFINITY], &[f64::INFINITY], Tol::ulps(0.0));
    assert!(fails(|| assert_close("one ulp", &[1.0 + f64::EPSILON], &[1.0], Tol::ulps(0.5))));
    assert!(fails(|| assert_close("lengths", &[1.0], &[1.0, 2.0], Tol::ulps(1.0))));
    assert!(fails(|| assert_close("order", &[0.1], &[0.0], Tol::order(0.1, 2))));
}

#[test]
fn components_are_compared_each_with_its_own_size() {
    let (near, far) = ([1e9, 1.0, 0.0], [1e9, 1.0 + 1e-9, 0.0]);
    assert_close("by the largest", &near, &far, Tol::ulps(8.0));
    assert!(fails(|| assert_each_close("each", &near, &far, Tol::ulps(8.0))));
    assert_each_close("each", &near, &far, Tol::stated(1.1e-9, "the difference, with its rounding"));
    assert!(fails(|| assert_each_close("zero", &[1e-300], &[0.0], Tol::ulps(64.0))));
    assert_each_close_at_scales("zero", &[1e-16], &[0.0], &[1.0], Tol::ulps(1.0));
    assert!(fails(|| assert_each_close_at_scales("scales", &[1.0], &[1.0], &[1.0, 2.0], Tol::ulps(1.0))));
    assert!(fails(|| assert_each_close("lengths", &[1.0], &[1.0, 2.0], Tol::ulps(1.0))));
    let wide = Tol::stated(f64::MAX, "anything goes");
    assert!(fails(|| assert_each_close("NaN", &[f64::NAN], &[1.0], wide)));
    assert!(fails(|| assert_each_close("infinite", &[1.0], &[f64::INFINITY], wide)));
    assert_each_close("equal infinities", &[f64::INFINITY], &[f64::INFINITY], Tol::ulps(0.0));
}

#[test]
fn nan_and_infinity_are_close_to_nothing() {
    let wide = Tol::stated(f64::MAX, "anything goes");
    for (a, e) in [
        (f64::NAN, 1.0),
        (1.0, f64::NAN),
        (f64::NAN, f64::NAN),
        (f64::INFINITY, 1.0),
        (1.0, f64::INFINITY),
        (f64::INFINITY, -f64::INFINITY),
    ] {
        assert!(fails(|| assert_close("not finite", &[0.5, a], &[0.5, e], wide)), "{a} and {e}");
    }
    assert!(relative_error(&[f64::NAN], &[1.0]).is_infinite());
    assert!(ulps_between(f64::NAN, 1.0).is_infinite() && ulps_between(f64::INFINITY, f64::MAX).is_infinite());
}

#[test]
fn floats_between_are_counted_across_zero() {
    let smallest = f64::from_bits(1);
    let counted = [ulps_between(-smallest, smallest), ulps_between(0.0, -0.0), ulps_between(2.0, 1.0)];
    assert_close("floats between", &counted, &[2.0, 0.0, 2.0_f64.powi(52)], Tol::ulps(0.0));
}

#[test]
fn tolerances_say_why() {
    assert_eq!(Tol::ulps(4.0).times(10.0).to_string(), "8.882e-15 (4 ulp of f64, times 1.000e1)");
    assert_eq!(Tol::stated(1e-9, "measured").or(Tol::ulps(1.0)).to_string(), "1.000e-9 (measured)");
}

#[test]
fn order_of_a_method_is_the_slope_of_its_errors() {
    let steps = [0.1, 0.05, 0.025];
    let errors = steps.map(|h: f64| 3.0 * h.powi(4));
    assert_order("fourth", &steps, &errors, 4.0, 0.01);
    assert!(fails(|| assert_order("third", &steps, &errors, 3.0, 0.5)));
    assert!(fails(|| assert_order("exact", &steps, &[0.0; 3], 4.0, 0.5)));
}

#[test]
fn condition_number_of_a_product_is_its_degree() {
    let kappa = condition_number(|x| vec![x[0] * x[0] * x[1]], &[3.0, -2.0]);
    assert_close("κ", &[kappa], &[3.0], Tol::stated(1e-9, "differences with a step of 2⁻²⁰"));
}

#[test]
fn allocations_are_counted_on_this_thread_only() {
    let (none, _) = allocations_in(|| 1.0_f64.sin());
    let (one, _) = allocations_in(|| std::hint::black_box(vec![0.0; 8]));
    assert_eq!((none, one), (0, 1));
}

#[test]
fn reference_data_without_a_file_is_refused() {
    assert!(fails(|| drop(golden::load("no such file"))));
    assert!(fails(|| drop(golden::vector(&golden::load("derivatives").meta))));
}

#[test]
fn doubled_precision_keeps_thirty_digits() {
    type Function = fn(&[DoubleDouble]) -> DoubleDouble;
    let functions: [(&str, Function); 15] = [
        ("exp", |x| x[0].exp()),
        ("exp_m1", |x| x[0].exp_m1()),
        ("ln", |x| x[0].ln()),
        ("ln_1p", |x| x[0].ln_1p()),
        ("sin", |x| x[0].sin()),
        ("cos", |x| x[0].cos()),
        ("tan", |x| x[0].tan()),
        ("asin", |x| x[0].asin()),
        ("acos", |x| x[0].acos()),
        ("atan", |x| x[0].atan()),
        ("atan2", |x| x[0].atan2(x[1])),
        ("sinh", |x| x[0].sinh()),
        ("cosh", |x| x[0].cosh()),
        ("tanh", |x| x[0].tanh()),
        ("cbrt", |x| x[0].cbrt()),
    ];
    let reference = golden::load("elementary");
    for (name, function) in functions {
        let case = reference.cases.iter().find(|case| golden::text(&case["name"]) == name);
        let points = golden::matrix(&case.expect("every function has a case")["points"]);
        let (mut worst, mut compared) = (0.0_f64, 0);
        for point in &points {
            let [arguments @ .., value, rest] = &point[..] else { panic!("a point has a value") };
            // Beyond, the second double of a pair runs out of exponents, or the argument out of digits.
            if !(1e-200..1e200).contains(&value.abs()) || arguments.iter().any(|x| 1e6 < x.abs() || x.abs() < 1e-200) {
                continue;
            }
            let arguments: Vec<_> = arguments.iter().map(|&x| DoubleDouble::lit(x)).collect();
            let missing = function(&arguments).rounding_of(*value);
            worst = worst.max((missing - rest).abs() / value.abs());
            compared += 1;
        }
        assert!(40 < compared, "{name}: only {compared} points");
        assert_close(name, &[worst], &[0.0], Tol::stated(1e-28, "argument reduction and scaling of the exponential"));
    }
}

proptest! {
    #[test]
    fn directions_and_rotations_have_unit_length(n in unit_vector(), q in rotation()) {
        assert_close("n·n", &[n.iter().map(|x| x * x).sum()], &[1.0], Tol::ulps(4.0));
        assert_close("q·q", &[q.iter().map(|x| x * x).sum()], &[1.0], Tol::ulps(4.0));
        for row in rotation_matrix(q) {
            assert_close("rows of the rotation", &[row.iter().map(|x| x * x).sum()], &[1.0], Tol::ulps(8.0));
        }
    }

    #[test]
    fn positive_definite_forms_are_positive(a in positive_definite(0.5..2.0), n in unit_vector()) {
        let form: f64 = (0..3).map(|i| (0..3).map(|j| n[i] * a[i][j] * n[j]).sum::<f64>()).sum();
        prop_assert!(0.5 - Tol::ulps(16.0).value() <= form && form <= 2.0 + Tol::ulps(16.0).value());
        for (i, row) in a.iter().enumerate() {
            let column = a.map(|other| other[i]);
            prop_assert_eq!(row.map(f64::to_bits), column.map(f64::to_bits), "row and column {}", i);
        }
    }
}
