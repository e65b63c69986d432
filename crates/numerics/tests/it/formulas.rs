//! Formulas that together use every elementary function, each written once.

use piola_numerics::Real;
use piola_numerics::derivatives::{ScalarFunction, UnivariateFunction, VectorFunction};

/// Something done with every formula of one variable.
pub(crate) trait Visitor {
    fn visit(&mut self, name: &'static str, f: &impl UnivariateFunction);
}

macro_rules! formulas {
    ($($name:ident = |$x:ident| $value:expr;)*) => {
        /// Shows every formula to a visitor, by the name it has in the reference data.
        pub(crate) fn visit_all(visitor: &mut impl Visitor) {
            $({
                struct Formula;
                impl UnivariateFunction for Formula {
                    fn call<T: Real>(&self, $x: T) -> T {
                        $value
                    }
                }
                visitor.visit(stringify!($name), &Formula);
            })*
        }
    };
}

formulas! {
    square_root = |x| x.sqrt();
    cube_root = |x| x.cbrt();
    fifth_power = |x| x.powi(5);
    inverse_cube = |x| x.powi(-3);
    fractional_power = |x| x.powf(T::lit(1.75));
    self_power = |x| x.powf(x);
    exponential = |x| x.exp();
    exponential_minus_one = |x| x.exp_m1();
    logarithm = |x| x.ln();
    logarithm_of_one_plus = |x| x.ln_1p();
    sine = |x| x.sin();
    cosine = |x| x.cos();
    tangent = |x| x.tan();
    arcsine = |x| x.asin();
    arccosine = |x| x.acos();
    arctangent = |x| x.atan();
    angle_of_a_point = |x| x.atan2(T::lit(1.0) - T::lit(2.0) * x * x);
    angle_on_a_circle = |x| {
        let (s, c) = x.sin_cos();
        (T::lit(2.0) * s).atan2(T::lit(2.0) * c)
    };
    hyperbolic_sine = |x| x.sinh();
    hyperbolic_cosine = |x| x.cosh();
    hyperbolic_tangent = |x| x.tanh();
    modulus = |x| x.abs();
    signed_modulus = |x| x.exp().copysign(x);
    reciprocal = |x| x.recip();
    quotient = |x| (x * x - T::lit(3.0)) / (x + T::lit(2.0));
    damped_oscillation = |x| (-x * T::lit(0.25)).exp() * (T::lit(3.0) * x).sin();
    gaussian_of_root = |x| (-(T::lit(1.0) + x * x).sqrt()).exp() * x.cos();
    lennard_jones = |x| {
        let attraction = x.powi(-6);
        T::lit(4.0) * (attraction * attraction - attraction)
    };
    pendulum_height = |x| T::lit(1.0) - x.sin().cos();
}

/// How many operations round one after the other in a formula: each costs it some ulp.
pub(crate) fn operations(name: &str) -> f64 {
    match name {
        "self_power" | "angle_of_a_point" | "angle_on_a_circle" | "signed_modulus" => 2.0,
        "quotient" | "damped_oscillation" | "gaussian_of_root" | "lennard_jones" | "pendulum_height" => 4.0,
        _ => 1.0,
    }
}

/// A potential of n variables with every pair coupled: Σ cos(xᵢ − xⱼ) eˣⁱ + Σ xᵢ² xⱼ.
pub(crate) struct Coupled;

impl ScalarFunction for Coupled {
    fn call<T: Real>(&self, x: &[T]) -> T {
        let mut sum = T::zero();
        for (i, &a) in x.iter().enumerate() {
            for &b in &x[..i] {
                sum += (a - b).cos() * a.exp() + a * a * b;
            }
        }
        sum
    }
}

/// The gradient of [`Coupled`], written out by hand.
pub(crate) struct CoupledGradient;

impl VectorFunction for CoupledGradient {
    fn values(&self, variables: usize) -> usize {
        variables
    }
    fn call<T: Real>(&self, x: &[T], out: &mut [T]) {
        out.fill(T::zero());
        for i in 0..x.len() {
            for j in 0..i {
                let (a, b) = (x[i], x[j]);
                let (s, c) = (a - b).sin_cos();
                out[i] += (c - s) * a.exp() + T::lit(2.0) * a * b;
                out[j] += s * a.exp() + a * a;
            }
        }
    }
}
