//! Derivatives against `num-dual`, which shares no code with ours.

use nalgebra::{Const, SMatrix, SVector};
use num_dual::{DualNum, DualSVec64, HyperDual64};
use piola_numerics::derivatives::{UnivariateFunction, gradient, hessian, second_derivative};
#[cfg(feature = "num-dual")]
use piola_numerics::{Real, derivatives::ScalarFunction};
use piola_testkit::golden::{self, Golden, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::formulas::{Coupled, Visitor, operations, visit_all};

/// The formulas again, over `num-dual`'s own trait.
fn peer<D: DualNum<Primitive = f64> + Copy>(name: &str, x: D) -> D {
    match name {
        "square_root" => x.sqrt(),
        "cube_root" => x.cbrt(),
        "fifth_power" => x.powi(5),
        "inverse_cube" => x.powi(-3),
        "fractional_power" => x.powf(1.75),
        "self_power" => x.powd(x),
        "exponential" => x.exp(),
        "exponential_minus_one" => x.exp_m1(),
        "logarithm" => x.ln(),
        "logarithm_of_one_plus" => x.ln_1p(),
        "sine" => x.sin(),
        "cosine" => x.cos(),
        "tangent" => x.tan(),
        "arcsine" => x.asin(),
        "arccosine" => x.acos(),
        "arctangent" => x.atan(),
        "angle_of_a_point" => x.atan2(-(x * x * 2.0 - 1.0)),
        "angle_on_a_circle" => (x.sin() * 2.0).atan2(x.cos() * 2.0),
        "hyperbolic_sine" => x.sinh(),
        "hyperbolic_cosine" => x.cosh(),
        "hyperbolic_tangent" => x.tanh(),
        "modulus" => x.abs(),
        "signed_modulus" => x.exp() * x.signum(),
        "reciprocal" => x.recip(),
        "quotient" => (x * x - 3.0) / (x + 2.0),
        "damped_oscillation" => (-x * 0.25).exp() * (x * 3.0).sin(),
        "gaussian_of_root" => (-(x * x + 1.0).sqrt()).exp() * x.cos(),
        "lennard_jones" => (x.powi(-6) * x.powi(-6) - x.powi(-6)) * 4.0,
        "pendulum_height" => -(x.sin().cos() - 1.0),
        other => panic!("{other} is not written for num-dual"),
    }
}

/// The size of the terms that cancel where `num-dual` differentiates less directly than it could.
fn scale_of_peer(name: &str, first: f64) -> f64 {
    match name {
        "hyperbolic_tangent" => 1.0,
        // The quotient y/x is up to 14 on the points of the reference data.
        "angle_on_a_circle" => 14.0 * first,
        _ => 0.0,
    }
}

struct Compare(Golden);

impl Visitor for Compare {
    fn visit(&mut self, name: &'static str, f: &impl UnivariateFunction) {
        for case in self.0.cases.iter().filter(|case| text(&case["name"]) == name) {
            let x = number(&case["x"]);
            let condition = vector(&case["condition"]);
            let (value, first, second) = second_derivative(f, x).unwrap();
            let (peer_value, peer_first, peer_second) = num_dual::second_derivative(|x| peer(name, x), x);
            for (k, (ours, theirs)) in
                [(value, peer_value), (first, peer_first), (second, peer_second)].into_iter().enumerate()
            {
                // `num-dual` forms powers from lower ones, asin from 1 − x² and tanh from sinh x/cosh x,
                // which costs it a few ulp of the larger terms.
                let what = format!("{name}({x:e}), derivative {k}");
                let scale = scale_of_peer(name, first);
                assert_close_at_scale(
                    &what,
                    &[ours],
                    &[theirs],
                    scale,
                    Tol::ulps(8.0).times(operations(name) * condition[k]),
                );
            }
        }
    }
}

#[test]
fn derivatives_equal_those_of_num_dual() {
    visit_all(&mut Compare(golden::load("derivatives")));
}

fn coupled<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
    let mut sum = D::zero();
    for (i, &a) in x.iter().enumerate() {
        for &b in &x[..i] {
            sum += (a - b).cos() * a.exp() + a * a * b;
        }
    }
    sum
}

#[test]
fn gradient_equals_that_of_num_dual() {
    let x = [0.3, -0.8, 0.7, 1.1, -0.2, 0.4];
    let numbers: [DualSVec64<6>; 6] = core::array::from_fn(|i| DualSVec64::from_re(x[i]).derivative(i));
    let expected: SVector<f64, 6> = coupled(&numbers).eps.unwrap_generic(Const::<6>, Const::<1>);
    assert_close("∇f", gradient(&Coupled, &x).unwrap().as_slice(), expected.as_slice(), Tol::ulps(8.0));
}

#[test]
fn hessian_equals_that_of_num_dual() {
    let x = [0.3, -0.8, 0.7, 1.1, -0.2, 0.4];
    let ours = hessian(&Coupled, &x).unwrap();
    let expected = SMatrix::<f64, 6, 6>::from_fn(|row, column| {
        let numbers: [HyperDual64; 6] = core::array::from_fn(|i| {
            let part = |k| if i == k { 1.0 } else { 0.0 };
            HyperDual64::new(x[i], part(row), part(column), 0.0)
        });
        coupled(&numbers).eps1eps2
    });
    assert_close("∇²f", ours.as_slice(), expected.as_slice(), Tol::ulps(8.0));
}

#[cfg(feature = "num-dual")]
struct CompareAsReal(Golden);

#[cfg(feature = "num-dual")]
impl Visitor for CompareAsReal {
    fn visit(&mut self, name: &'static str, f: &impl UnivariateFunction) {
        for case in self.0.cases.iter().filter(|case| text(&case["name"]) == name) {
            let x = number(&case["x"]);
            let condition = vector(&case["condition"]);
            let third = f.call(num_dual::Dual3_64::from_re(x).derivative());
            let hyper = f.call(HyperDual64::new(x, 1.0, 1.0, 0.0));
            let vector = f.call(DualSVec64::<2>::from_re(x).derivative(1));
            let vector = vector.eps.unwrap_generic(Const::<2>, Const::<1>)[1];
            let expected = [number(&case["value"]), number(&case["first"]), number(&case["second"])];
            for (k, actual) in
                [vec![third.re, hyper.re], vec![third.v1, hyper.eps1, vector], vec![third.v2, hyper.eps1eps2]]
                    .into_iter()
                    .enumerate()
            {
                for a in actual {
                    let what = format!("{name}({x:e}), derivative {k}");
                    let scale = scale_of_peer(name, expected[1]);
                    assert_close_at_scale(
                        &what,
                        &[a],
                        &[expected[k]],
                        scale,
                        Tol::ulps(8.0).times(operations(name) * condition[k]),
                    );
                }
            }
        }
    }
}

#[cfg(feature = "num-dual")]
#[test]
fn one_formula_over_num_dual_equals_reference() {
    visit_all(&mut CompareAsReal(golden::load("derivatives")));
}

#[cfg(feature = "num-dual")]
#[test]
fn num_dual_as_real_differentiates_the_angle_at_right_angles() {
    // θ = arctan2(y, x) at (0, 2): ∂θ/∂x = −1/2, where y/x does not exist.
    let x = num_dual::Dual64::new(0.0, 1.0);
    let angle = Real::atan2(num_dual::Dual64::from_re(2.0), x);
    assert_close("∂θ/∂x", &[angle.eps], &[-0.5], Tol::ulps(1.0));
    // A constant exponent needs no logarithm of the base.
    let power = Real::powf(num_dual::Dual64::new(0.0, 1.0), Real::lit(2.0));
    assert_close("(x²)′ at 0", &[power.re, power.eps], &[0.0, 0.0], Tol::ulps(1.0));
    let spring = Coupled.call(&[num_dual::Dual64::new(0.25, 1.0), Real::lit(0.5)]);
    let expected = gradient(&Coupled, &[0.25, 0.5]).unwrap();
    assert_close("∂f/∂x₀", &[spring.eps], &[expected[0]], Tol::ulps(4.0));
}
