//! Values and derivatives against reference data of 17 digits.

use piola_numerics::derivatives::{UnivariateFunction, first_derivative, second_derivative};
use piola_numerics::{Dual, Gradient, Real};
use piola_testkit::golden::{self, Golden, number, text, vector};
use piola_testkit::{Tol, assert_close};

use crate::formulas::{Visitor, operations, visit_all};

struct Compare {
    golden: Golden,
    used: usize,
}

impl Visitor for Compare {
    fn visit(&mut self, name: &'static str, f: &impl UnivariateFunction) {
        for case in self.golden.cases.iter().filter(|case| text(&case["name"]) == name) {
            self.used += 1;
            let x = number(&case["x"]);
            let expected = [number(&case["value"]), number(&case["first"]), number(&case["second"])];
            let condition = vector(&case["condition"]);
            let tolerance = |k: usize| Tol::ulps(4.0).times(operations(name) * condition[k]);
            let check = |how: &str, actual: &[f64]| {
                for (k, (a, e)) in actual.iter().zip(&expected).enumerate() {
                    assert_close(&format!("{name}({x:e}), derivative {k}, by {how}"), &[*a], &[*e], tolerance(k));
                }
            };
            let (value, first) = first_derivative(f, x).unwrap();
            check("Dual", &[value, first]);
            let (value, first, second) = second_derivative(f, x).unwrap();
            check("Jet", &[value, first, second]);
            let nested = f.call(Dual::variable(Dual::variable(x)));
            check("Dual<Dual>", &[nested.value.value, nested.tangent.value, nested.tangent.tangent]);
            check("Dual<Dual>", &[nested.value.value, nested.value.tangent]);
            let gradient = f.call(Gradient::<f64, 3>::variable(x, 1));
            check("Gradient", &[gradient.value, gradient.partials[1]]);
            assert_eq!((gradient.partials[0].abs(), gradient.partials[2].abs()), (0.0, 0.0), "{name}: idle directions");
            let nested = f.call(Gradient::<_, 2>::variable(Gradient::<f64, 2>::variable(x, 0), 1));
            check(
                "Gradient<Gradient>",
                &[nested.value.value, nested.partials[1].value, nested.partials[1].partials[0]],
            );
            // The value is that of the plain scalar to the last bit: derivatives do not disturb it.
            assert_eq!(value.to_bits(), f.call(x).to_bits(), "{name}({x:e}): value of Jet and f64");
            assert_eq!(nested.value.value.to_bits(), f.call(x).primal(0).to_bits(), "{name}({x:e}): value of Gradient");
        }
    }
}

#[test]
fn derivatives_equal_reference_data() {
    let mut compare = Compare { golden: golden::load("derivatives"), used: 0 };
    visit_all(&mut compare);
    assert_eq!(compare.used, compare.golden.cases.len(), "a case names no formula");
}
