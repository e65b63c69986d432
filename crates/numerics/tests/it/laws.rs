//! Identities of differentiation, on random points and for any formula.

use piola_numerics::derivatives::{self, ScalarFunction, Workspace};
use piola_numerics::{Dual, Gradient, Jet, Lanes, Real};
use piola_testkit::strategies::{finite, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::formulas::{Coupled, CoupledGradient};

/// Two formulas whose values stay near one.
fn f<T: Real>(x: T) -> T {
    x.sin() + T::lit(2.0)
}

fn g<T: Real>(x: T) -> T {
    (x * T::lit(0.5)).exp()
}

/// A number with its first two derivatives along a curve.
type Curve = Jet<f64, 0>;

/// A function of the scalar trait, over dual numbers.
type Function = fn(Dual<f64>) -> Dual<f64>;

proptest! {
    #[test]
    fn derivative_of_product_equals_leibniz_rule(x in finite(-3.0..3.0)) {
        let (a, b, ab) = (f(Curve::time(x)), g(Curve::time(x)), f(Curve::time(x)) * g(Curve::time(x)));
        let expected = [
            a.rate * b.value + a.value * b.rate,
            a.second_rate * b.value + 2.0 * a.rate * b.rate + a.value * b.second_rate,
        ];
        assert_close_at_scale("(f g)′, (f g)″", &[ab.rate, ab.second_rate], &expected, ab.value, Tol::ulps(4.0));
    }

    #[test]
    fn derivative_of_quotient_times_denominator_equals_derivative_of_numerator(x in finite(-3.0..3.0)) {
        let (a, b) = (f(Curve::time(x)), g(Curve::time(x)));
        let back = a / b * b;
        let actual = [back.value, back.rate, back.second_rate];
        assert_close("(f/g) g", &actual, &[a.value, a.rate, a.second_rate], Tol::ulps(16.0));
    }

    #[test]
    fn partial_derivatives_of_products_and_quotients_equal_those_by_hand(x in finite(-3.0..3.0), y in finite(0.5..3.0)) {
        let (a, b) = (Jet::<f64, 2>::coordinate(x, 0.0, 0), Jet::<f64, 2>::coordinate(y, 0.0, 1));
        assert_close("∇(x y)", &(a * b).partials, &[y, x], Tol::ulps(1.0));
        assert_close("∇(x/y)", &(a / b).partials, &[1.0 / y, -x / (y * y)], Tol::ulps(4.0));
    }

    #[test]
    fn derivative_of_composition_equals_chain_rule(x in finite(-3.0..3.0)) {
        let inner = g(Curve::time(x));
        let outer = f(Curve::time(inner.value));
        let both = f(inner);
        let expected = [
            outer.rate * inner.rate,
            outer.second_rate * inner.rate * inner.rate + outer.rate * inner.second_rate,
        ];
        assert_close_at_scale("(f∘g)′, (f∘g)″", &[both.rate, both.second_rate], &expected, 1.0, Tol::ulps(8.0));
    }

    #[test]
    fn derivatives_of_inverse_functions_are_reciprocal(x in finite(0.05..0.95)) {
        let pairs: [(Function, Function); 11] = [
            (Real::exp, Real::ln),
            (Real::exp_m1, Real::ln_1p),
            (Real::exp_m1, |x| x.ln_1p_given(x + Dual::lit(1.0))),
            (|x| (-x).exp_m1(), |x| -x.ln_1p_given(x + Dual::lit(1.0))),
            (Real::sin, Real::asin),
            (Real::cos, Real::acos),
            (Real::tan, Real::atan),
            (Real::sqrt, |x| x * x),
            (Real::cbrt, |x| x.powi(3)),
            (Real::recip_cbrt, |x| x.powi(-3)),
            (|x| x.powf(Dual::lit(1.5)), |x| x.powf(Dual::lit(1.0 / 1.5))),
        ];
        for (forth, back) in pairs {
            let there_and_back = back(forth(Dual::variable(x)));
            // Near 0 and 1 some of the functions are flat: |f/(x f′)| is at most 1/(x (1 − x)).
            let tolerance = Tol::ulps(8.0).times(1.0 / (x * (1.0 - x)));
            assert_close("f⁻¹(f(x))", &[there_and_back.value, there_and_back.tangent], &[x, 1.0], tolerance);
        }
    }

    #[test]
    fn squares_of_sine_and_cosine_sum_to_one_with_no_derivative(x in finite(-100.0..100.0)) {
        let (s, c) = Curve::time(x).sin_cos();
        let one = s * s + c * c;
        assert_close("sin² + cos²", &[one.value, one.rate, one.second_rate], &[1.0, 0.0, 0.0], Tol::ulps(4.0));
    }

    #[test]
    fn power_equals_exponential_of_logarithm(x in finite(0.1..10.0), y in finite(-3.0..3.0)) {
        let (base, exponent) = (Gradient::<f64, 2>::variable(x, 0), Gradient::<f64, 2>::variable(y, 1));
        let (power, expected) = (base.powf(exponent), (exponent * base.ln()).exp());
        assert_close("xʸ", &[power.value], &[expected.value], Tol::ulps(16.0));
        assert_close("∇xʸ", &power.partials, &expected.partials, Tol::ulps(16.0));
    }

    #[test]
    fn gradient_equals_that_by_hand(x in vector(7, -1.0..1.0)) {
        let mut expected = [0.0; 7];
        derivatives::VectorFunction::call(&CoupledGradient, &x, &mut expected);
        let gradient = derivatives::gradient(&Coupled, &x).unwrap();
        assert_close("∇f", gradient.as_slice(), &expected, Tol::ulps(16.0));
        let mut wide = [0.0; 7];
        let value = derivatives::gradient_into(&mut Workspace::<f64, 8>::new(7), &Coupled, &x, &mut wide).unwrap();
        assert_close("∇f by eights", &wide, gradient.as_slice(), Tol::ulps(2.0));
        assert_eq!(value.to_bits(), ScalarFunction::call::<f64>(&Coupled, &x).to_bits());
    }

    #[test]
    fn hessian_equals_jacobian_of_gradient_and_its_transpose(x in vector(6, -1.0..1.0)) {
        let hessian = derivatives::hessian(&Coupled, &x).unwrap();
        let jacobian = derivatives::jacobian(&CoupledGradient, &x).unwrap();
        assert_close("∇²f", hessian.as_slice(), jacobian.as_slice(), Tol::ulps(16.0));
        assert_close("Schwarz", jacobian.transpose().as_slice(), jacobian.as_slice(), Tol::ulps(16.0));
        assert_eq!(hessian.transpose(), hessian);
    }

    #[test]
    fn products_with_the_hessian_equal_the_hessian_times_vectors(
        x in vector(6, -1.0..1.0),
        u in vector(6, -1.0..1.0),
        v in vector(6, -1.0..1.0),
    ) {
        let workspace = &mut Workspace::<f64>::with_values(6, 6);
        let hessian = derivatives::hessian(&Coupled, &x).unwrap();
        let gradient = derivatives::gradient(&Coupled, &x).unwrap();
        let v_column = nalgebra::DVector::from_column_slice(&v);
        let u_column = nalgebra::DVector::from_column_slice(&u);
        let expected = &hessian * &v_column;
        let scale = hessian.amax();
        let tolerance = Tol::ulps(32.0);
        let (mut product, mut value) = ([0.0; 6], [0.0; 6]);
        let slope =
            derivatives::hessian_vector_product_into(workspace, &Coupled, &x, &v, &mut product).unwrap();
        assert_close_at_scale("(∇²f)v", &product, expected.as_slice(), scale, tolerance);
        assert_close_at_scale("v·∇f", &[slope], &[gradient.dot(&v_column)], gradient.amax(), tolerance);
        derivatives::jacobian_vector_product_into(workspace, &CoupledGradient, &x, &v, &mut value, &mut product)
            .unwrap();
        assert_close_at_scale("(∇f)v", &product, expected.as_slice(), scale, tolerance);
        let mixed = derivatives::mixed(workspace, &Coupled, &x, &u, &v).unwrap();
        assert_close_at_scale("u·(∇²f)v", &[mixed], &[u_column.dot(&expected)], scale, tolerance);
        let swapped = derivatives::mixed(workspace, &Coupled, &x, &v, &u).unwrap();
        assert_close_at_scale("u·(∇²f)v = v·(∇²f)u", &[mixed], &[swapped], scale, tolerance);
        let (_, along, curvature) = derivatives::directional(workspace, &Coupled, &x, &v).unwrap();
        assert_close_at_scale("v·∇f", &[along], &[slope], gradient.amax(), tolerance);
        assert_close_at_scale("v·(∇²f)v", &[curvature], &[v_column.dot(&expected)], scale, tolerance);
    }

    #[test]
    fn gradient_over_lanes_equals_gradient_of_each_point(points in proptest::collection::vec(vector(5, -1.0..1.0), 4)) {
        let x: [Lanes<f64, 4>; 5] =
            core::array::from_fn(|i| Lanes::from(core::array::from_fn::<f64, 4, _>(|lane| points[lane][i])));
        let gradients = derivatives::gradient(&Coupled, &x).unwrap();
        for (lane, point) in points.iter().enumerate() {
            let lane_values: Vec<f64> = gradients.iter().map(|g| g.primal(lane)).collect();
            let expected = derivatives::gradient(&Coupled, point).unwrap();
            assert_close("∇f", &lane_values, expected.as_slice(), Tol::ulps(16.0));
        }
    }
}
