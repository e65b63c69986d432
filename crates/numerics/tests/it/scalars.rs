//! One formula gives the same answer over every scalar.

use piola_numerics::derivatives::UnivariateFunction;
use piola_numerics::{Dual, Gradient, Hessian, Jet, Lanes, Real};
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

/// The second derivatives of two dual numbers, each once.
struct SameSecondDerivatives;

impl Visitor for SameSecondDerivatives {
    fn visit(&mut self, name: &'static str, f: &impl UnivariateFunction) {
        let golden = golden::load("derivatives");
        for case in golden.cases.iter().filter(|case| text(&case["name"]) == name) {
            let x = number(&case["x"]);
            // f(u), u = x + (y − ½)/2 + (y − ½)(z − 2), at y = ½ and z = 2: u,y = ½ and u,yz = 1, so that every term of the chain rule counts.
            let y = Hessian::<f64, 3, 6>::variable(0.5, 1) - Hessian::lit(0.5);
            let z = Hessian::<f64, 3, 6>::variable(2.0, 2) - Hessian::lit(2.0);
            let found = f.call(Hessian::constant(x) + y * Hessian::lit(0.5) + y * z);
            let nested = f.call(Dual::new(Dual::variable(x), Dual::lit(1.0)));
            let (slope, curvature) = (nested.value.tangent, nested.tangent.tangent);
            let tolerance = Tol::ulps(8.0);
            assert_close(&format!("{name}({x:e})"), &[found.value()], &[nested.value.value], tolerance);
            assert_close(&format!("{name}′({x:e})"), &found.partials(), &[0.0, 0.5 * slope, 0.0], tolerance);
            let expected = [0.0, 0.0, 0.0, 0.25 * curvature, slope, 0.0];
            assert_close(&format!("{name}″({x:e})"), &found.second_partials(), &expected, tolerance);
            assert!(!found.depends_on(0) && !found.is_curved_in(0, 1));
        }
    }
}

#[test]
fn second_derivatives_of_a_hessian_equal_those_of_nested_dual_numbers() {
    visit_all(&mut SameSecondDerivatives);
}

/// The first sixteen entries are written out, those beyond are a loop.
#[test]
fn gradients_of_any_length_equal_closed_forms() {
    fn check<const N: usize>() {
        let mut sum = Gradient::<f64, N>::constant(0.0);
        for k in 0..N {
            let x = Gradient::variable(k as f64 + 1.0, k);
            sum += x * x;
        }
        let expected: [f64; N] = core::array::from_fn(|k| 2.0 * (k as f64 + 1.0));
        assert_eq!(sum.partials.map(f64::to_bits), expected.map(f64::to_bits));
    }
    check::<0>();
    check::<1>();
    check::<15>();
    check::<16>();
    check::<17>();
    check::<19>();
}

#[test]
fn products_and_quotients_of_hessians_equal_closed_forms() {
    let x = Hessian::<f64, 2, 3>::variable(3.0, 0);
    let y = Hessian::<f64, 2, 3>::variable(4.0, 1);
    let product = x * x * y;
    assert_eq!((product.partials(), product.second_partials()), ([24.0, 9.0], [8.0, 6.0, 0.0]));
    let quotient = x / (y * y); // x/y²: 1/16, −2 · 3/64; 0, −2/64, 6 · 3/256
    assert_eq!((quotient.partials(), quotient.second_partials()), ([0.0625, -0.093_75], [0.0, -0.031_25, 0.070_312_5]));
    assert_eq!(quotient.second_partial(1, 0).to_bits(), quotient.second_partial(0, 1).to_bits());
    let power = y.powf(Hessian::lit(0.5));
    assert_eq!((power.partials(), power.second_partials()), ([0.0, 0.25], [0.0, 0.0, -0.031_25]));
    // A constant has no derivatives that would have to be computed, and equal numbers are equal.
    assert!(!Hessian::<f64, 2, 3>::lit(2.0).depends_on(0));
    assert_eq!(x - x, Hessian::lit(0.0));
}

/// Near angles are reduced side by side. One far angle sends all eight to the standard library.
#[test]
fn sines_and_cosines_of_eight_angles_equal_those_of_each() {
    let near = [-0.0, -0.3, 1.5, 3.2, -7.1, 250.0, 1e4, 2.6e7];
    let far = [0.0, -0.3, 1.5, 3.2, -7.1, 250.0, 1e4, -1e9];
    // 2 ulp are stated, and the standard library's values have one.
    let tol = Tol::ulps(3.0);
    for angles in [near, far] {
        let (sines, cosines) = f64::sin_cos_of_eight(angles);
        let (expected_sines, expected_cosines) = (angles.map(f64::sin), angles.map(f64::cos));
        for k in 0..8 {
            assert_close("sine", &[sines[k]], &[expected_sines[k]], tol);
            assert_close("cosine", &[cosines[k]], &[expected_cosines[k]], tol);
        }
        let duals = <Dual<f64>>::sin_cos_of_eight(angles.map(Dual::variable));
        for k in 0..8 {
            assert_close("slope of the sine", &[duals.0[k].tangent], &[expected_cosines[k]], tol);
            assert_close("slope of the cosine", &[duals.1[k].tangent], &[-expected_sines[k]], tol);
        }
    }
    assert!(f64::sin_cos_of_eight(near).0[0].is_sign_negative());
    // In single precision: the angles are f32, and 2 ulp of f32 are 2.4e-7 of a value near one.
    #[expect(clippy::cast_possible_truncation, reason = "the nearest f32 is the angle")]
    let single = near.map(|angle| angle as f32);
    let (sines, cosines) = f32::sin_cos_of_eight(single);
    for k in 0..8 {
        let (sine, cosine) = f64::from(single[k]).sin_cos();
        assert!((f64::from(sines[k]) - sine).abs() <= 2.4e-7 * sine.abs(), "{k}");
        assert!((f64::from(cosines[k]) - cosine).abs() <= 2.4e-7 * cosine.abs(), "{k}");
    }
    // What is not a number stays alone.
    let mut angles = near;
    angles[3] = f64::NAN;
    let (sines, cosines) = f64::sin_cos_of_eight(angles);
    for k in 0..8 {
        assert_eq!((sines[k].is_nan(), cosines[k].is_nan()), (k == 3, k == 3), "{k}");
    }
}
