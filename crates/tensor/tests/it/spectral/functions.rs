//! Functions of one variable that are given by their value: their divided differences come from power series.

use piola_numerics::{Jet, Real};
use piola_tensor::spectral::{IsotropicFunction, Logarithm};
use piola_testkit::{DoubleDouble, Tol, assert_close};

/// Compares the divided differences of a function about x with derivatives by the chain rule and with quotients.
fn check(name: &str, f: &impl IsotropicFunction) {
    let x = 0.45;
    let jet = f.value(Jet::<f64, 0>::time(x));
    let at_one_place = [f.divided_difference(x, x), 2.0 * f.second_divided_difference(x, x, x)];
    let expected = [jet.rate, jet.second_rate];
    assert_close(&format!("{name}′, {name}″"), &at_one_place, &expected, Tol::ulps(32.0));
    // Neighbours near enough for the power series; the quotients in 31 digits.
    let [a, b, c] = [x - 0.0625, x + 0.03125, x + 0.0625];
    let [u, v, w] = [a, b, c].map(|x| f.value(DoubleDouble::lit(x)));
    let over = |difference: DoubleDouble, gap: f64| difference / DoubleDouble::lit(gap);
    let (below, above) = (over(v - u, b - a), over(w - v, c - b));
    let second = over(above - below, c - a).primal(0);
    let found = [f.divided_difference(a, b), f.divided_difference(c, b)];
    assert_close(&format!("{name}[a, b]"), &found, &[below.primal(0), above.primal(0)], Tol::ulps(32.0));
    let scale = jet.rate.abs().max(jet.value.abs());
    let error = (f.second_divided_difference(a, b, c) - second).abs();
    assert!(error <= Tol::ulps(64.0).value() * scale.max(second.abs()), "{name}[a, b, c]: {error:e}");
}

macro_rules! check {
    ($(|$x:ident| $value:expr;)*) => {
        $({
            struct Given;
            impl IsotropicFunction for Given {
                fn value<T: Real>(&self, $x: T) -> T {
                    $value
                }
            }
            check(stringify!($value), &Given);
        })*
    };
}

#[test]
fn divided_differences_of_a_given_function_equal_its_derivatives_and_quotients() {
    check! {
        |x| x * x * x;
        |x| x.recip();
        |x| x.sqrt();
        |x| x.cbrt();
        |x| x.powi(5);
        |x| x.powi(-3);
        |x| x.powf(T::lit(1.75));
        |x| x.powf(x);
        |x| x.exp();
        |x| x.exp_m1();
        |x| x.ln();
        |x| x.ln_1p();
        |x| x.sin();
        |x| x.cos();
        |x| x.tan();
        |x| x.asin();
        |x| x.acos();
        |x| x.atan();
        |x| x.atan2(T::one() - x);
        |x| x.sinh();
        |x| x.cosh();
        |x| x.tanh();
        |x| (x * x).exp();
        |x| (x * x).sin();
        |x| (x * x).cosh();
        |x| (x * x).tanh();
        |x| (x * x).powf(T::lit(0.75));
        |x| (x - T::one()).abs().sqrt();
        |x| x.copysign(x - T::one());
    }
}

#[test]
fn logarithms_of_roots_are_half_those_of_their_squares() {
    for (s, half) in [(1e-20_f64, 5e-21), (0.5, 0.5 * 1.5_f64.ln()), (3.0, 2.0_f64.ln()), (-0.75, 0.5_f64.ln())] {
        let root = (1.0 + s).sqrt();
        let excess = s / (1.0 + root);
        let found = [
            Logarithm.value_of_root_beside_one(excess, s),
            Logarithm.value_beside_one(excess),
            if s.abs() < 0.1 { half } else { Logarithm.value_of_root(root, 1.0 + s) },
        ];
        assert_close("½ ln(1 + s)", &found, &[half; 3], Tol::ulps(4.0));
    }
}
