//! One formula gives the same answer over every scalar.

use piola_numerics::derivatives::UnivariateFunction;
use piola_numerics::{Dual, Gradient, Jet, Lanes, Real};
use piola_testkit::golden::{self, Golden, number, text, vector};
use piola_testkit::{Tol, assert_close};

use crate::formulas::{Visitor, operations, visit_all};

/// Evaluates every formula over `T` and compares all lanes with the reference values.
struct SameAnswer<T> {
    golden: Golden,
    what: &'static str,
    tolerance: Tol,
    scalar: fn(f64) -> T,
}

impl<T: Real> Visitor for SameAnswer<T> {
    fn visit(&mut self, name: &'static str, f: &impl UnivariateFunction) {
        for case in self.golden.cases.iter().filter(|case| text(&case["name"]) == name) {
            let x = number(&case["x"]);
            let value = f.call((self.scalar)(x));
            let tolerance = self.tolerance.times(operations(name) * vector(&case["condition"])[0]);
            for lane in 0..T::LANES {
                let what = format!("{name}({x:e}) over {}, lane {lane}", self.what);
                assert_close(&what, &[value.primal(lane)], &[number(&case["value"])], tolerance);
            }
        }
    }
}

fn check<T: Real>(what: &'static str, tolerance: Tol, scalar: fn(f64) -> T) {
    visit_all(&mut SameAnswer { golden: golden::load("derivatives"), what, tolerance, scalar });
}

#[test]
fn value_over_f64_equals_reference() {
    check::<f64>("f64", Tol::ulps(4.0), |x| x);
}

#[test]
fn value_over_f32_equals_reference_to_its_precision() {
    check::<f32>("f32", Tol::ulps32(4.0), f32::lit);
    check::<Dual<f32>>("Dual<f32>", Tol::ulps32(4.0), |x| Dual::variable(f32::lit(x)));
}

#[test]
fn value_over_differentiable_numbers_equals_reference() {
    let tolerance = Tol::ulps(4.0);
    check("Dual", tolerance, Dual::<f64>::variable);
    check("Gradient", tolerance, |x| Gradient::<f64, 4>::variable(x, 2));
    check("Jet", tolerance, |x| Jet::<f64, 2>::coordinate(x, 1.5, 0));
    check("Dual<Dual>", tolerance, |x| Dual::variable(Dual::variable(x)));
    check("Jet of Dual", tolerance, |x| Jet::<_, 2>::coordinate(Dual::variable(x), Dual::constant(1.0), 1));
    check("Gradient of Jet", tolerance, |x| Gradient::<_, 2>::variable(Jet::<f64, 1>::time(x), 1));
}

#[test]
fn value_over_lanes_equals_reference() {
    // The elementary functions of lanes err by two ulp where those of f64 err by one.
    let tolerance = Tol::ulps(8.0);
    check("Lanes<f64, 4>", tolerance, Lanes::<f64, 4>::lit);
    check("Lanes<f64, 8>", tolerance, Lanes::<f64, 8>::lit);
    check("Dual<Lanes>", tolerance, |x| Dual::variable(Lanes::<f64, 4>::lit(x)));
    check("Jet of Lanes", tolerance, |x| Jet::<Lanes<f64, 2>, 1>::coordinate(Lanes::lit(x), Lanes::lit(1.0), 0));
    check("Lanes<f32, 8>", Tol::ulps32(8.0), Lanes::<f32, 8>::lit);
}

/// First and second derivatives over lanes.
struct DerivativesOverLanes(Golden);

impl Visitor for DerivativesOverLanes {
    fn visit(&mut self, name: &'static str, f: &impl UnivariateFunction) {
        for case in self.0.cases.iter().filter(|case| text(&case["name"]) == name) {
            let x = number(&case["x"]);
            let jet = f.call(Jet::<Lanes<f64, 4>, 0>::time(Lanes::lit(x)));
            let condition = vector(&case["condition"]);
            for (k, (actual, expected)) in
                [(jet.value, "value"), (jet.rate, "first"), (jet.second_rate, "second")].into_iter().enumerate()
            {
                assert_close(
                    &format!("{name}({x:e}), derivative {k} over lanes"),
                    &[actual.primal(3)],
                    &[number(&case[expected])],
                    Tol::ulps(8.0).times(operations(name) * condition[k]),
                );
            }
        }
    }
}

#[test]
fn derivatives_over_lanes_equal_reference() {
    visit_all(&mut DerivativesOverLanes(golden::load("derivatives")));
}
