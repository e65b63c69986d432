//! Adaptive integration: exact for polynomials, honest about its errors, and clear about why it ended.

use core::convert::Infallible;

use piola_numerics::quadrature::{
    Accuracy, Difference, Ending, ErrorRule, GaussKronrod, Growing, Integral, Kinks, LargestDifference, Panel,
    Quadpack, integrate,
};
use piola_testkit::{Tol, assert_close, assert_each_close};

const FIFTEEN: &GaussKronrod = &GaussKronrod::POINTS_15;
const TWENTY_ONE: &GaussKronrod = &GaussKronrod::POINTS_21;

/// One function over one range, to a share of its value.
fn one<R: ErrorRule<1>>(
    points: &GaussKronrod,
    rule: &R,
    share: f64,
    (from, to): (f64, f64),
    f: impl Fn(f64) -> f64,
) -> Integral<1> {
    let allowed = |values: &[f64; 1], sizes: &[f64; 1]| [share * values[0].abs() + 16.0 * f64::EPSILON * sizes[0]];
    let mut memory = Growing::up_to(500);
    let method = (points, rule);
    let found = integrate(&mut memory, [(from, to)], method, &allowed, |_, x| Ok::<_, Infallible>([f(x)]));
    found.expect("infallible")
}

#[test]
fn one_panel_of_a_polynomial_equals_its_antiderivative() {
    for (points, degree, coarse_degree) in [(FIFTEEN, 22, 13), (TWENTY_ONE, 31, 19)] {
        for power in 0..=degree {
            let exact = 2.0_f64.powi(power + 1) / f64::from(power + 1) - 0.5_f64.powi(power + 1) / f64::from(power + 1);
            let found = one(points, &Difference, f64::INFINITY, (0.5, 2.0), |x| x.powi(power));
            assert_eq!((found.panels, found.evaluations), (1, 2 * points.nodes.len() + 1));
            assert_close("∫ xⁿ", &found.values, &[exact], Tol::ulps(8.0));
            if power <= coarse_degree {
                assert_close("Gauss's rule", &[found.errors[0] / exact], &[0.0], Tol::ulps(16.0));
            }
        }
        // One degree more, even and centred, is one too many for either rule.
        for (power, fine) in [(coarse_degree + 1, false), (degree + 1 + degree % 2, true)] {
            let exact = 2.0 / f64::from(power + 1);
            let found = one(points, &Difference, f64::INFINITY, (-1.0, 1.0), |x| x.powi(power));
            let missed = if fine { (found.values[0] - exact).abs() } else { found.errors[0] };
            assert!(1e3 * f64::EPSILON * exact < missed || fine && 4.0 * f64::EPSILON * exact < missed, "{power}");
        }
    }
}

#[test]
fn polynomial_through_the_nodes_is_continued_to_the_end() {
    for points in [FIFTEEN, TWENTY_ONE] {
        let count = points.nodes.len();
        let ascending = points.nodes.iter().map(|x| -x).chain([0.0]).chain(points.nodes.iter().rev().copied());
        for power in 0..=i32::try_from(2 * count).expect("small") {
            let continued: f64 = ascending.clone().zip(points.extrapolation).map(|(x, w)| w * x.powi(power)).sum();
            let sizes: f64 = ascending.clone().zip(points.extrapolation).map(|(x, w)| (w * x.powi(power)).abs()).sum();
            assert_close("at the end", &[continued / sizes], &[1.0 / sizes], Tol::ulps(32.0));
        }
    }
}

/// Functions, ranges and integrals by their antiderivatives, to sixteen digits by mpmath.
#[expect(clippy::type_complexity, reason = "a table of functions")]
fn hard() -> Vec<(&'static str, fn(f64) -> f64, (f64, f64), f64)> {
    vec![
        ("e^x", f64::exp, (0.0, 1.0), 1.718_281_828_459_045),
        ("sqrt", f64::sqrt, (0.0, 1.0), 0.666_666_666_666_666_7),
        ("Runge", |x| 1.0 / (1.0 + 25.0 * x * x), (-1.0, 1.0), 0.549_360_306_778_006_3),
        ("ln", f64::ln, (0.0, 2.0), -0.613_705_638_880_109_4),
        ("cos 50x", |x| (50.0 * x).cos(), (0.0, 1.0), -0.005_247_497_074_078_575),
        ("peak", |x| 1e-2 / ((x - 0.3) * (x - 0.3) + 1e-4), (0.0, 1.0), 3.093_986_915_124_149_5),
    ]
}

#[test]
fn errors_stated_bound_the_errors_made() {
    for (name, f, range, exact) in hard() {
        for share in [1e-4, 1e-8, 1e-12] {
            let found = [
                one(FIFTEEN, &Difference, share, range, f),
                one(TWENTY_ONE, &Difference, share, range, f),
                one(TWENTY_ONE, &Quadpack, share, range, f),
                one(FIFTEEN, &Kinks, share, range, |x| if x <= 0.0 && name == "ln" { 0.0 } else { f(x) }),
            ];
            for found in found {
                assert_eq!(found.ending, Ending::Accurate, "{name} to {share}: {found:?}");
                let made = (found.values[0] - exact).abs();
                assert!(made <= found.errors[0] + 8.0 * f64::EPSILON * found.sizes[0], "{name}: {made:e} {found:?}");
            }
        }
    }
}

#[test]
fn error_of_quadpack_is_nearer_to_the_truth_than_the_difference() {
    let exact = 1.0_f64.exp_m1();
    let [plain, quadpack] = [
        one(FIFTEEN, &Difference, 1e-3, (0.0, 1.0), f64::exp).errors[0],
        one(FIFTEEN, &Quadpack, 1e-3, (0.0, 1.0), f64::exp).errors[0],
    ];
    // |K − G| is rounding here: Gauss's seven points suffice. QUADPACK adds eight ulp of the size.
    assert!(plain < 4.0 * f64::EPSILON * exact && quadpack < 10.0 * f64::EPSILON * exact, "{plain:e} {quadpack:e}");
    let runge = |x: f64| 1.0 / (1.0 + 25.0 * x * x);
    let [plain, quadpack] = [
        one(FIFTEEN, &Difference, 1.0, (0.0, 0.125), runge).errors[0],
        one(FIFTEEN, &Quadpack, 1.0, (0.0, 0.125), runge).errors[0],
    ];
    assert!(quadpack < 2e-2 * plain, "{plain:e} {quadpack:e}");
}

#[test]
fn kinks_and_jumps_between_an_end_and_the_next_node_are_seen() {
    // Nodes nearest to an end are 0.0043 of the range from it: neither rule sees what happens there.
    for place in [0.001, 0.002, 0.37, 0.999] {
        let kink = |x: f64| if x < place { 1.0 } else { 1.0 + 100.0 * (x - place) };
        let jump = |x: f64| if x < place { 5.0 } else { 1.0 };
        for (f, exact) in [
            (&kink as &dyn Fn(f64) -> f64, 1.0 + 50.0 * (1.0 - place) * (1.0 - place)),
            (&jump, 5.0 * place + (1.0 - place)),
        ] {
            let found = one(FIFTEEN, &Kinks, 1e-9, (0.0, 1.0), f);
            assert_eq!(found.ending, Ending::Accurate, "{place}");
            let made = (found.values[0] - exact).abs();
            assert!(made <= found.errors[0] + 8.0 * f64::EPSILON * exact, "{place}: {made:e}, {found:?}");
            assert!(3 < found.panels, "{place}: the kink was not looked for");
        }
    }
}

#[test]
fn panels_are_narrowest_where_the_function_is_hardest() {
    let mut memory = [Panel::EMPTY; 200];
    let allowed = |_: &[f64; 1], _: &[f64; 1]| [1e-12];
    let method = (FIFTEEN, &Difference);
    let found = integrate(&mut memory, [(0.0, 1.0)], method, &allowed, |_, x: f64| {
        Ok::<_, Infallible>([(x - 0.25).abs().sqrt()])
    });
    let found = found.expect("infallible");
    let narrowest = memory[..found.panels].iter().min_by(|a, b| (a.to - a.from).total_cmp(&(b.to - b.from)));
    let narrowest = narrowest.expect("panels");
    assert!((narrowest.from - 0.25).abs() < 1e-6 || (narrowest.to - 0.25).abs() < 1e-6, "{narrowest:?}");
    let widest = memory[..found.panels].iter().map(|panel| panel.to - panel.from).fold(0.0, f64::max);
    assert!(0.2 < widest && found.panels < 100, "{widest}");
    let lengths: f64 = memory[..found.panels].iter().map(|panel| panel.to - panel.from).sum();
    assert_close("the panels fill the range", &[lengths], &[1.0], Tol::ulps(1.0));
}

#[test]
fn functions_of_one_call_equal_their_integrals_alone() {
    let allowed = |values: &[f64; 3], _: &[f64; 3]| values.map(|value| 1e-10 * value.abs());
    let mut memory = Growing::up_to(100);
    let all = |x: f64| [x.exp(), 1e6 * x.sqrt(), 1e-6 * (3.0 * x).cos()];
    let found =
        integrate(&mut memory, [(0.0, 1.0)], (FIFTEEN, &Difference), &allowed, |_, x| Ok::<_, Infallible>(all(x)));
    let found = found.expect("infallible");
    assert_eq!(found.ending, Ending::Accurate);
    let exact = [1.718_281_828_459_045, 1e6 / 1.5, 1e-6 * 0.047_040_002_686_622_4];
    assert_each_close("each to its own size", &found.values, &exact, Tol::stated(1e-10, "the accuracy asked for"));
    // The largest difference belongs to all: the smallest function is then integrated to the errors of the largest.
    let found = integrate(&mut memory, [(0.0, 1.0)], (FIFTEEN, &LargestDifference), &allowed, |_, x| {
        Ok::<_, Infallible>(all(x))
    });
    let errors = found.expect("infallible").errors.map(f64::to_bits);
    assert!(errors[0] == errors[1] && errors[1] == errors[2]);
}

#[test]
fn integral_backwards_is_the_negative_and_parts_add_up() {
    let f = |x: f64| x.exp();
    let (forwards, backwards) =
        (one(TWENTY_ONE, &Quadpack, 1e-12, (0.0, 2.0), f), one(TWENTY_ONE, &Quadpack, 1e-12, (2.0, 0.0), f));
    assert_eq!(forwards.values[0].to_bits(), (-backwards.values[0]).to_bits());
    assert_eq!((forwards.sizes, forwards.errors), (backwards.sizes, backwards.errors));
    let mut memory = [Panel::EMPTY; 8];
    let allowed = |values: &[f64; 1], _: &[f64; 1]| [1e-12 * values[0].abs()];
    let mut seen = [false; 2];
    let parts = [(0.0, 1.0), (0.0, 1.0)];
    let found = integrate(&mut memory, parts, (TWENTY_ONE, &Quadpack), &allowed, |part, x: f64| {
        seen[part] = true;
        Ok::<_, Infallible>([if part == 0 { x.exp() } else { (1.0 + x).exp() }])
    });
    assert_close("parts", &found.expect("infallible").values, &forwards.values, Tol::ulps(4.0));
    assert_eq!(seen, [true; 2]);
}

#[test]
fn functions_that_are_not_finite_are_named_with_their_place() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut memory = [Panel::EMPTY; 8];
        let anything = |_: &[f64; 2], _: &[f64; 2]| [f64::INFINITY; 2];
        let parts = [(0.0, 1.0), (1.0, 2.0)];
        let found = integrate(&mut memory, parts, (FIFTEEN, &Difference), &anything, |_, x: f64| {
            Ok::<_, Infallible>([x, if x < 1.9 { x } else { bad }])
        });
        let Ending::NotFinite { part: 1, x, component: 1, value } = found.expect("infallible").ending else {
            panic!("not named")
        };
        assert!(1.9 <= x && x < 2.0 && value.to_bits() == bad.to_bits(), "{x} {value}");
    }
    // Finite values whose sum is not.
    let found = one(FIFTEEN, &Difference, 1e-9, (0.0, 1e10), |_| 1e300);
    let Ending::NotFinite { part: 0, x, component: 0, value } = found.ending else { panic!("{found:?}") };
    assert!(x.to_bits() == 5e9_f64.to_bits() && value.is_infinite());
}

/// Nothing is worth halving.
struct Idle;
impl Accuracy<1> for Idle {
    fn allowed(&self, _values: &[f64; 1], _sizes: &[f64; 1]) -> [f64; 1] {
        [0.0]
    }
    fn is_worth_halving(&self, _panel: &Panel<1>) -> bool {
        false
    }
}

#[test]
fn endings_say_why_no_panel_was_halved() {
    let steep = |x: f64| x.powf(-0.9);
    let exactly = |_: &[f64; 1], _: &[f64; 1]| [0.0];
    let call = |memory: &mut [Panel<1>; 6], parts: &[(f64, f64)]| {
        let method = (FIFTEEN, &Difference);
        let parts = parts.iter().copied();
        integrate(memory, parts, method, &exactly, |_, x| Ok::<_, Infallible>([steep(x)])).expect("infallible")
    };
    let mut memory = [Panel::EMPTY; 6];
    let found = call(&mut memory, &[(0.0, 1.0)]);
    assert_eq!((found.ending, found.panels, found.evaluations), (Ending::Full, 6, 15 * 11));
    let found = call(&mut memory, &[(0.5, 1.0); 7]);
    assert_eq!((found.ending, found.errors[0].is_infinite()), (Ending::Full, true));
    // Between neighbours there is no number.
    let parts = [(1.0, 1.0_f64.next_up())];
    let found = integrate(&mut memory, parts, (FIFTEEN, &Kinks), &exactly, |_, x| {
        Ok::<_, Infallible>([if x <= 1.0 { 0.0 } else { 1e20 }])
    });
    assert_eq!(found.map(|found| (found.ending, found.panels)), Ok((Ending::Exhausted, 2)));
    let parts = [(0.0, 1.0)];
    let found = integrate(&mut memory, parts, (FIFTEEN, &Difference), &Idle, |_, x| Ok::<_, Infallible>([steep(x)]));
    assert_eq!(found.map(|found| (found.ending, found.panels)), Ok((Ending::Exhausted, 1)));
    // What the function refuses is handed on.
    let refused =
        integrate(
            &mut memory,
            parts,
            (FIFTEEN, &Difference),
            &Idle,
            |_, x| {
                if x < 0.1 { Err("too small") } else { Ok([x]) }
            },
        );
    assert_eq!(refused.map(|_| ()), Err("too small"));
}
