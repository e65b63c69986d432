//! Places where a plausible implementation is wrong: zeros, branch cuts, NaN, dependent rows.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use nalgebra::{Matrix3, dmatrix, dvector};
use piola_numerics::derivatives::{self, ScalarFunction, UnivariateFunction, VectorFunction, Workspace};
use piola_numerics::linear::{ldlt, lu, matrix3};
use piola_numerics::{Dual, Gradient, Jet, NumericsError, Real};
use piola_testkit::{Tol, assert_close};

/// Value, first and second derivative of a formula through a jet.
fn three<F: Fn(Jet<f64, 0>) -> Jet<f64, 0>>(f: F, x: f64) -> [f64; 3] {
    let jet = f(Jet::time(x));
    [jet.value, jet.rate, jet.second_rate]
}

/// The same through nested dual numbers.
fn nested<F: Fn(Dual<Dual<f64>>) -> Dual<Dual<f64>>>(f: F, x: f64) -> [f64; 3] {
    let number = f(Dual::variable(Dual::variable(x)));
    [number.value.value, number.value.tangent, number.tangent.tangent]
}

fn exactly(what: &str, actual: [f64; 3], expected: [f64; 3]) {
    assert_close(what, &actual, &expected, Tol::ulps(0.0));
}

#[test]
fn whole_powers_at_zero_are_those_of_the_polynomial() {
    let expected = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0], [0.0, 0.0, 0.0]];
    for (n, expected) in (0..4).zip(expected) {
        exactly("xⁿ by Jet", three(|x| x.powi(n), 0.0), expected);
        exactly("xⁿ by nesting", nested(|x| x.powi(n), 0.0), expected);
        let exponent = f64::from(n);
        exactly("xʸ by Jet", three(|x| x.powf(Jet::lit(exponent)), 0.0), expected);
        exactly("xʸ by nesting", nested(|x| x.powf(Dual::lit(exponent)), 0.0), expected);
    }
}

#[test]
fn whole_power_of_extreme_exponent_does_not_overflow() {
    assert!(Dual::variable(1.0).powi(i32::MIN).tangent < 0.0);
    assert!(0.0 < Dual::variable(1.0).powi(i32::MAX).tangent);
}

#[test]
fn power_at_zero_with_a_fractional_exponent_is_finite_or_infinite_but_not_nan() {
    let at_zero = |y: f64| Dual::variable(0.0).powf(Dual::lit(y));
    assert_eq!(at_zero(1.5), Dual::new(0.0, 0.0));
    assert_eq!(at_zero(0.5), Dual::new(0.0, f64::INFINITY));
}

#[test]
fn power_of_zero_does_not_depend_on_a_positive_exponent() {
    // ∂(xʸ)/∂y = xʸ ln x → 0 for x → 0 < y: a power-law fluid at rest, differentiated by its exponent.
    for y in [0.5, 1.0, 2.5] {
        assert_eq!(Dual::constant(0.0).powf(Dual::variable(y)), Dual::new(0.0, 0.0));
    }
    let x = Gradient::<f64, 2>::variable(0.0, 0);
    let y = Gradient::<f64, 2>::variable(2.5, 1);
    assert_close("∇(xʸ)", &x.powf(y).partials, &[0.0, 0.0], Tol::ulps(0.0));
    // At y ≤ 0 there is no such limit, and it is said.
    assert!(!Dual::<f64>::constant(0.0).powf(Dual::variable(0.0)).tangent.is_finite());
    assert!(!Dual::<f64>::constant(0.0).powf(Dual::variable(-1.0)).tangent.is_finite());
}

#[test]
fn power_of_a_negative_base_needs_no_logarithm_when_the_exponent_is_constant() {
    assert_eq!(Dual::variable(-2.0).powf(Dual::lit(3.0)), Dual::new(-8.0, 12.0));
    assert!(Dual::<f64>::variable(-2.0).powf(Dual::variable(3.0)).tangent.is_nan());
}

#[test]
fn root_at_zero_has_infinite_slope() {
    assert_eq!(Dual::variable(0.0).sqrt(), Dual::new(0.0, f64::INFINITY));
    assert_eq!(Dual::variable(0.0).cbrt(), Dual::new(0.0, f64::INFINITY));
}

#[test]
fn roots_of_nothing_are_refused_by_name() {
    struct Length;
    impl ScalarFunction for Length {
        fn call<T: Real>(&self, x: &[T]) -> T {
            (x[0] * x[0] + x[1] * x[1]).sqrt()
        }
    }
    let error = derivatives::gradient(&Length, &[0.0, 0.0]).unwrap_err();
    assert!(matches!(error, NumericsError::NotFinite { quantity: "gradient", index: 0, .. }), "{error}");
    assert_eq!(error.to_string(), "entry 0 of `gradient` is NaN, which is not a finite number");
}

#[test]
fn division_by_zero_is_not_silently_finite() {
    let (one, zero) = (Dual::<f64>::lit(1.0), Dual::variable(0.0));
    let quotient = one / zero;
    assert!(quotient.value.is_infinite() && !quotient.tangent.is_finite());
    let quotient = one / Dual::lit(0.0);
    assert!(quotient.value.is_infinite() && !quotient.tangent.is_finite());
    let quotient = Dual::variable(0.0) / Dual::variable(0.0);
    assert!(quotient.value.is_nan() && quotient.tangent.is_nan());
    let jet = Jet::<f64, 1>::lit(1.0) / Jet::coordinate(0.0, 1.0, 0);
    assert!(!jet.rate.is_finite() && !jet.second_rate.is_finite() && !jet.partials[0].is_finite());
    assert!(!zero.recip().tangent.is_finite() && !zero.ln().tangent.is_finite());
}

#[test]
fn quotient_of_duals_has_the_value_of_the_plain_quotient() {
    // 49 · (1/49) rounds below one: the value must not be formed with the reciprocal.
    let values = [
        (Dual::variable(49.0) / Dual::variable(49.0)).value,
        (Gradient::<f64, 2>::lit(49.0) / Gradient::lit(49.0)).value,
        (Jet::<f64, 2>::lit(49.0) / Jet::lit(49.0)).value,
    ];
    assert_close("49/49", &values, &[1.0; 3], Tol::ulps(0.0));
}

#[test]
fn angle_and_its_derivatives_are_right_in_all_quadrants_and_on_the_axes() {
    let points = [
        (1.0, 0.0, 0.0),
        (1.0, 1.0, FRAC_PI_4),
        (0.0, 1.0, FRAC_PI_2),
        (-1.0, 1.0, 3.0 * FRAC_PI_4),
        (-1.0, 0.0, PI),
        (-1.0, -0.0, -PI),
        (-1.0, -1.0, -3.0 * FRAC_PI_4),
        (0.0, -1.0, -FRAC_PI_2),
        (1.0, -1.0, -FRAC_PI_4),
    ];
    for scale in [1.0, 3e-200, 7e200] {
        for (x, y, angle) in points {
            // θ_x = −y/r², θ_y = x/r², θ_xx = −θ_yy = 2xy/r⁴, θ_xy = (y² − x²)/r⁴, here for r of size one.
            let r2: f64 = x * x + y * y;
            let first = Gradient::<f64, 2>::variable(y * scale, 1).atan2(Gradient::variable(x * scale, 0));
            assert_close("θ", &[first.value], &[angle], Tol::ulps(1.0));
            assert_close("∇θ", &first.partials.map(|a| a * scale), &[-y / r2, x / r2], Tol::ulps(2.0));
            assert_eq!(first.value.is_sign_negative(), y.is_sign_negative(), "side of the cut");
            let hessian = |a: f64, b: f64| {
                let x = Dual::new(Dual::new(x, a), Dual::constant(1.0));
                let y = Dual::new(Dual::new(y, b), Dual::constant(0.0));
                y.atan2(x).tangent.tangent
            };
            let expected = [2.0 * x * y / (r2 * r2), (y * y - x * x) / (r2 * r2)];
            assert_close("∇²θ", &[hessian(1.0, 0.0), hessian(0.0, 1.0)], &expected, Tol::ulps(4.0));
            // Along x + t, y: θ̈ = θ_xx.
            let jet = Jet::<f64, 0>::lit(y).atan2(Jet::time(x));
            assert_close("θ̈", &[jet.second_rate], &expected[..1], Tol::ulps(4.0));
        }
    }
    assert!(Dual::<f64>::variable(0.0).atan2(Dual::constant(0.0)).tangent.is_nan(), "no angle at the origin");
}

#[test]
fn modulus_of_negative_zero_is_zero() {
    let x = Dual::<f64>::variable(-0.0).abs();
    assert!(x.value.is_sign_positive());
    assert_close("slope to the right", &[x.tangent], &[1.0], Tol::ulps(0.0));
    exactly("|x|", three(Real::abs, -2.0), [2.0, -1.0, 0.0]);
}

#[test]
fn copied_sign_sees_the_sign_of_zero() {
    assert_eq!(Dual::variable(2.0).copysign(Dual::lit(-0.0)), Dual::new(-2.0, -1.0));
    assert_eq!(Dual::variable(-2.0).copysign(Dual::lit(0.0)), Dual::new(2.0, -1.0));
}

#[test]
fn inverse_functions_at_the_end_of_their_domain_have_infinite_slope() {
    assert_eq!(Dual::variable(1.0).asin(), Dual::new(FRAC_PI_2, f64::INFINITY));
    assert_eq!(Dual::variable(1.0).acos(), Dual::new(0.0, -f64::INFINITY));
    assert!(Dual::<f64>::variable(1.5).asin().value.is_nan() && Dual::<f64>::variable(1.5).asin().tangent.is_nan());
}

#[test]
fn hyperbolic_tangent_saturates_without_nan() {
    exactly("tanh", three(Real::tanh, 400.0), [1.0, 0.0, 0.0]);
    exactly("tanh", three(Real::tanh, -800.0), [-1.0, 0.0, 0.0]);
}

#[test]
fn nan_is_neither_smaller_nor_larger_and_not_lost() {
    for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN)] {
        assert!(Real::min(a, b).is_nan() && Real::max(a, b).is_nan());
        assert!(Real::min(Dual::<f64>::lit(a), Dual::lit(b)).value.is_nan());
        assert!(Real::max(Dual::<f64>::lit(a), Dual::lit(b)).value.is_nan());
    }
    assert_eq!((Real::min(1.0, 2.0), Real::max(1.0, 2.0)), (1.0, 2.0));
    assert_eq!(Real::max(Dual::variable(1.0), Dual::lit(2.0)), Dual::lit(2.0));
}

#[test]
fn nan_comes_out_of_every_function_as_nan() {
    type Function = fn(Dual<f64>) -> Dual<f64>;
    let functions: [(&str, Function); 22] = [
        ("sqrt", Real::sqrt),
        ("cbrt", Real::cbrt),
        ("recip_cbrt", Real::recip_cbrt),
        ("exp", Real::exp),
        ("exp_m1", Real::exp_m1),
        ("ln", Real::ln),
        ("ln_1p", Real::ln_1p),
        ("ln_1p_given", |x| x.ln_1p_given(x + Dual::lit(1.0))),
        ("sin", Real::sin),
        ("cos", Real::cos),
        ("tan", Real::tan),
        ("asin", Real::asin),
        ("acos", Real::acos),
        ("atan", Real::atan),
        ("sinh", Real::sinh),
        ("cosh", Real::cosh),
        ("tanh", Real::tanh),
        ("recip", Real::recip),
        ("powi", |x| x.powi(3)),
        ("powf", |x| x.powf(Dual::lit(1.5))),
        ("powf", |x| Dual::lit(1.5).powf(x)),
        ("atan2", |x| x.atan2(Dual::lit(1.0))),
    ];
    for (name, f) in functions {
        let result = f(Dual::variable(f64::NAN));
        assert!(result.value.is_nan() && result.tangent.is_nan(), "{name}(NaN) is {result:?}");
    }
}

struct Sum;

impl ScalarFunction for Sum {
    fn call<T: Real>(&self, x: &[T]) -> T {
        x.iter().fold(T::zero(), |sum, &x| sum + x)
    }
}

impl VectorFunction for Sum {
    fn values(&self, _variables: usize) -> usize {
        1
    }
    fn call<T: Real>(&self, x: &[T], out: &mut [T]) {
        out[0] = ScalarFunction::call(self, x);
    }
}

impl UnivariateFunction for Sum {
    fn call<T: Real>(&self, x: T) -> T {
        x
    }
}

#[test]
fn input_that_is_not_finite_is_refused_by_name() {
    let refused = |quantity, index| NumericsError::NotFinite { quantity, index, value: f64::INFINITY };
    let (good, bad) = ([1.0, 2.0], [1.0, f64::INFINITY]);
    let mut workspace = Workspace::<f64>::with_values(2, 1);
    let mut out = [0.0; 4];
    assert_eq!(derivatives::first_derivative(&Sum, f64::INFINITY), Err(refused("x", 0)));
    assert_eq!(derivatives::second_derivative(&Sum, f64::INFINITY), Err(refused("x", 0)));
    assert_eq!(derivatives::gradient(&Sum, &bad), Err(refused("x", 1)));
    assert_eq!(derivatives::hessian(&Sum, &bad), Err(refused("x", 1)));
    assert_eq!(derivatives::jacobian(&Sum, &bad), Err(refused("x", 1)));
    assert_eq!(derivatives::directional(&Sum, &good, &bad, &mut workspace), Err(refused("direction", 1)));
    assert_eq!(derivatives::mixed(&Sum, &good, &good, &bad, &mut workspace), Err(refused("v", 1)));
    let result = derivatives::hessian_vector_product_into(&Sum, &good, &bad, &mut workspace, &mut out[..2]);
    assert_eq!(result, Err(refused("v", 1)));
    let matrix = Matrix3::repeat(f64::INFINITY);
    assert_eq!(matrix3::inverse(&matrix), Err(refused("matrix", 0)));
    assert_eq!(ldlt::Ldlt::new(&dmatrix![f64::INFINITY]).unwrap_err(), refused("matrix", 0));
    assert_eq!(lu::Lu::new(&dmatrix![f64::INFINITY]).unwrap_err(), refused("matrix", 0));
    let lu = lu::Lu::new(&dmatrix![1.0]).unwrap();
    assert_eq!(lu.solve(&dvector![f64::INFINITY]), Err(refused("right-hand side", 0)));
}

#[test]
fn vectors_of_the_wrong_length_are_refused_by_name() {
    let refused = |quantity, expected, actual| Err(NumericsError::WrongLength { quantity, expected, actual });
    let x = [1.0, 2.0];
    let mut workspace = Workspace::<f64>::new(2);
    assert_eq!(derivatives::gradient_into(&Sum, &[1.0], &mut workspace, &mut [0.0]), refused("x", 2, 1));
    assert_eq!(derivatives::gradient_into(&Sum, &x, &mut workspace, &mut [0.0]), refused("gradient", 2, 1));
    let result = derivatives::jacobian_into(&Sum, &x, &mut workspace, &mut [0.0], &mut [0.0; 2]);
    assert_eq!(result, Err(NumericsError::WrongLength { quantity: "workspace values", expected: 1, actual: 0 }));
    assert!(ldlt::Ldlt::new(&dmatrix![1.0, 2.0]).is_err(), "a matrix that is not square");
}

#[test]
fn formulas_of_no_variables_have_empty_derivatives() {
    assert_eq!(derivatives::gradient::<f64>(&Sum, &[]).unwrap().len(), 0);
    assert_eq!(derivatives::hessian::<f64>(&Sum, &[]).unwrap().len(), 0);
    assert_eq!(derivatives::jacobian::<f64>(&Sum, &[]).unwrap().shape(), (1, 0));
}
