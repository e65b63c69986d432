//! Derivatives of isotropic functions, at coalescence and away from it.

use piola_numerics::{Dual, Real};
use piola_tensor::Symmetric;
use piola_tensor::spectral::{
    Exponential, IsotropicFunction, Logarithm, Power, SquareRoot, derivative, derivative_array, second_derivative,
    tensor_function,
};
use piola_testkit::spectral::{Random, Rows, eigenpairs, with_stretches};
use piola_testkit::{DoubleDouble, Tol, assert_close};

use super::cases::{flat, symmetric};

/// √x from its value alone: its divided differences are the provided ones.
struct PlainRoot;
impl IsotropicFunction for PlainRoot {
    fn value<T: Real>(&self, x: T) -> T {
        x.sqrt()
    }
}

const COALESCENCE: Tol = Tol::stated(1e-11, "derivatives at coalescence");

const TRIPLES: [[f64; 3]; 8] = [
    [1.5, 1.5, 1.5],
    [2.0, 2.0, 0.5],
    [2.0, 0.5, 0.5],
    [1.5 + 1e-10, 1.5, 0.7],
    [1.5 + 1e-13, 1.5, 1.5 - 1e-13],
    [1.5 + 1e-6, 1.5, 1.5 - 3e-7],
    [2.0, 1.9, 0.3],
    [3.0, 1.0, 0.2],
];

fn function(a: &Rows<DoubleDouble>, f: impl Fn(DoubleDouble) -> DoubleDouble) -> Rows<DoubleDouble> {
    let (values, vectors) = eigenpairs(*a);
    let values = values.map(f);
    let entry = |i: usize, j: usize| {
        values[0] * vectors[0][i] * vectors[0][j]
            + values[1] * vectors[1][i] * vectors[1][j]
            + values[2] * vectors[2][i] * vectors[2][j]
    };
    core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)))
}

/// First and second derivative along h by central differences in 31 digits.
fn differences(a: &Symmetric, h: &Symmetric, f: impl Fn(DoubleDouble) -> DoubleDouble + Copy) -> [Vec<f64>; 2] {
    let step = 2.0_f64.powi(-24);
    let (a, h) = (a.rows(), h.rows());
    let at = |s: f64| {
        let line: Rows<DoubleDouble> = core::array::from_fn(|i| {
            core::array::from_fn(|j| DoubleDouble::lit(a[i][j]) + DoubleDouble::lit(h[i][j]) * DoubleDouble::lit(s))
        });
        function(&line, f)
    };
    let (ahead, here, behind) = (at(step), at(0.0), at(-step));
    let (double, square) = (DoubleDouble::lit(2.0 * step), DoubleDouble::lit(step * step));
    let list = |entry: &dyn Fn(usize, usize) -> DoubleDouble| (0..9).map(|p| entry(p / 3, p % 3).primal(0)).collect();
    let two = DoubleDouble::lit(2.0);
    [
        list(&|i, j| (ahead[i][j] - behind[i][j]) / double),
        list(&|i, j| (ahead[i][j] - two * here[i][j] + behind[i][j]) / square),
    ]
}

fn check(name: &str, f: &impl IsotropicFunction, plain: impl Fn(DoubleDouble) -> DoubleDouble + Copy) {
    let mut random = Random::new(21);
    for stretches in TRIPLES {
        for _ in 0..20 {
            let q = random.rotation();
            let a = symmetric(with_stretches(&q, stretches, &q));
            let h = symmetric(random.matrix());
            let [first, second] = differences(&a, &h, plain);
            assert_close(name, &flat(&derivative(f, &a, &h)), &first, COALESCENCE);
            assert_close(name, &flat(&second_derivative(f, &a, &h, &h)), &second, COALESCENCE);
            let array = derivative_array(f, &a);
            let weights = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0];
            let applied = array.map(|row| (0..6).map(|k| row[k] * weights[k] * h.components[k]).sum::<f64>());
            assert_close(name, &flat(&Symmetric { components: applied }), &first, COALESCENCE);
            // Differentiable scalars bring the same.
            let line = Symmetric {
                components: core::array::from_fn(|i| {
                    let h = h.components[i];
                    Dual::new(Dual::new(a.components[i], h), Dual::new(h, 0.0))
                }),
            };
            let value = tensor_function(f, &line);
            let part =
                |p: fn(&Dual<Dual<f64>>) -> f64| flat(&Symmetric { components: value.components.map(|x| p(&x)) });
            assert_close(name, &part(|x| x.value.tangent), &first, COALESCENCE);
            assert_close(name, &part(|x| x.tangent.tangent), &second, COALESCENCE);
        }
    }
}

#[test]
fn derivatives_of_the_square_root_equal_differences_in_doubled_precision() {
    check("√", &SquareRoot, Real::sqrt);
}

#[test]
fn derivatives_of_the_logarithm_equal_differences_in_doubled_precision() {
    check("ln", &Logarithm, Real::ln);
}

#[test]
fn derivatives_of_the_exponential_equal_differences_in_doubled_precision() {
    check("exp", &Exponential, Real::exp);
}

#[test]
fn derivatives_of_a_power_equal_differences_in_doubled_precision() {
    check("x^−2.5", &Power(-2.5), |x| (DoubleDouble::lit(-2.5) * x.ln()).exp());
}

#[test]
fn derivatives_of_a_function_given_by_its_value_equal_differences_in_doubled_precision() {
    check("plain √", &PlainRoot, Real::sqrt);
}

#[test]
fn second_derivatives_scale_with_the_size_of_the_tensor() {
    // Powers of 10 that double precision does not hold exactly, far beyond where the power series of ln and x^p in the
    // distances themselves would leave its range.
    let mut random = Random::new(24);
    for exponent in (-60..=60).step_by(5) {
        let size = 10.0_f64.powi(exponent);
        for gap in [0.0, 1e-9, 0.1, 1.0] {
            let stretches = [1.0, 1.0 + gap, 1.0 + 2.0 * gap];
            let (h, k) = (symmetric(random.matrix()), symmetric(random.matrix()));
            let (one, a) = (Symmetric::diagonal(stretches), Symmetric::diagonal(stretches) * size);
            let ordinary = second_derivative(&Logarithm, &one, &h, &k);
            let found = second_derivative(&Logarithm, &a, &h, &k) * size * size;
            let what = format!("1e{exponent}, gap {gap}");
            let tolerance = Tol::stated(1e-13, "rounding of the powers of ten");
            assert_close(&what, &found.components, &ordinary.components, tolerance);
            let ordinary = second_derivative(&Power(-0.5), &one, &h, &k);
            let found = second_derivative(&Power(-0.5), &a, &h, &k) * size * size * size.sqrt();
            assert_close(&what, &found.components, &ordinary.components, tolerance);
        }
    }
}
