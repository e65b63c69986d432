//! Elementary functions in lanes: against reference values, against the standard library, at special
//! values, and bit for bit between widths and sets of instructions.

use piola_numerics::{Element, Kernel, Lanes, Level, Real, dispatch_at};
use piola_testkit::{DoubleDouble, golden};

/// What the documentation promises, in units in the last place of the exact value.
const STATED_ULPS: f64 = 2.0;
/// The stated error plus that of the standard library's functions, below one.
const ULPS_FROM_STANDARD: f64 = STATED_ULPS + 1.0;

/// All functions of one argument, then those of two.
const UNARY: [&str; 15] = [
    "exp",
    "exp_m1",
    "ln",
    "ln_1p",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "sinh",
    "cosh",
    "tanh",
    "cbrt",
    "recip_cbrt",
];
const BINARY: [&str; 3] = ["powf", "atan2", "ln_1p_given"];

/// The function `name` of x, or of x and y.
#[cfg_attr(not(debug_assertions), inline(always))]
fn apply<T: Real>(name: &str, x: T, y: T) -> T {
    match name {
        "exp" => x.exp(),
        "exp_m1" => x.exp_m1(),
        "ln" => x.ln(),
        "ln_1p" => x.ln_1p(),
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.tan(),
        "asin" => x.asin(),
        "acos" => x.acos(),
        "atan" => x.atan(),
        "sinh" => x.sinh(),
        "cosh" => x.cosh(),
        "tanh" => x.tanh(),
        "cbrt" => x.cbrt(),
        "recip_cbrt" => x.recip_cbrt(),
        "powf" => x.powf(y),
        "atan2" => x.atan2(y),
        "ln_1p_given" => x.ln_1p_given(y),
        _ => unreachable!("no function {name}"),
    }
}

/// `apply`, or xⁿ for "powi".
fn apply_golden<T: Real>(name: &str, x: T, y: T) -> T {
    if name == "powi" { x.powi(whole(y.primal(0))) } else { apply(name, x, y) }
}

fn whole(n: f64) -> i32 {
    (-100..=100).find(|i| f64::from(*i).to_bits() == n.to_bits()).expect("a small whole number")
}

/// The distance between neighbouring floats of `digits` binary digits at x, no less than `least`.
fn unit(x: f64, digits: i32, least: f64) -> f64 {
    let binade = f64::from_bits(x.abs().to_bits() & 0x7ff0_0000_0000_0000);
    (binade * (1.0 - f64::from(digits)).exp2()).max(least)
}

/// (name, arguments, exact value as a double and the rest) of every reference point.
fn golden_points() -> Vec<(String, f64, f64, f64, f64)> {
    let mut points = Vec::new();
    for case in &golden::load("elementary").cases {
        let name = golden::text(&case["name"]);
        for point in golden::matrix(&case["points"]) {
            let n = point.len();
            points.push((name.to_owned(), point[0], if n == 4 { point[1] } else { 0.0 }, point[n - 2], point[n - 1]));
            // Of the sum only where it has all digits.
            if name == "ln_1p" && (point[0].abs() <= 0.5 || ((1.0 + point[0]) - 1.0).to_bits() == point[0].to_bits()) {
                points.push(("ln_1p_given".to_owned(), point[0], 1.0 + point[0], point[n - 2], point[n - 1]));
            }
        }
    }
    points
}

#[test]
fn lanes_of_doubles_equal_the_exact_values_within_two_ulp() {
    for (name, x, y, value, rest) in golden_points() {
        let actual = apply_golden(&name, Lanes([x; 4]), Lanes([y; 4])).0;
        for lane in actual {
            let error = ((lane - value) - rest).abs() / unit(value, 53, f64::from_bits(1));
            assert!(error <= STATED_ULPS, "{name}({x:e}, {y:e}) = {lane:e}, not {value:e}: {error} ulp");
        }
    }
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "the points taken are exact in single precision")]
fn lanes_of_singles_equal_the_exact_values_within_two_ulp() {
    let mut count = 0;
    for (name, x, y, value, rest) in golden_points() {
        let exact = f64::from(x as f32).to_bits() == x.to_bits() && f64::from(y as f32).to_bits() == y.to_bits();
        if !exact || f64::from(f32::MAX) < value.abs() {
            continue;
        }
        count += 1;
        let lane = f64::from(apply_golden(&name, Lanes([x as f32; 8]), Lanes([y as f32; 8])).0[5]);
        let error = ((lane - value) - rest).abs() / unit(value, 24, f64::from(f32::from_bits(1)));
        assert!(error <= STATED_ULPS, "{name}({x:e}, {y:e}) = {lane:e}, not {value:e}: {error} ulp");
    }
    assert!(900 < count, "only {count} points are exact in single precision");
}

/// A reproducible sequence of numbers in [0, 1).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap_or(0)) / 4_294_967_296.0
    }
    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }
    /// ± 2^(between the exponents).
    fn spread(&mut self, from: f64, to: f64) -> f64 {
        let size = self.between(from, to).exp2();
        if self.next() < 0.5 { -size } else { size }
    }
}

/// Arguments of every size inside the function's domain.
fn sweep(name: &str, sequence: &mut Sequence) -> (f64, f64) {
    let near = sequence.next() < 0.5;
    match name {
        "exp" | "exp_m1" if near => (sequence.between(-700.0, 700.0), 0.0),
        "sinh" | "cosh" | "tanh" if near => (sequence.between(-30.0, 30.0), 0.0),
        "exp" | "exp_m1" | "sinh" | "cosh" | "tanh" => (sequence.spread(-40.0, 2.0), 0.0),
        "ln" if near => (sequence.between(0.5, 2.0), 0.0),
        "ln" => (sequence.spread(-1000.0, 1000.0).abs(), 0.0),
        "ln_1p" if near => (sequence.between(-0.999, 2.0), 0.0),
        "ln_1p" => (sequence.spread(-60.0, 600.0).abs(), 0.0),
        "sin" | "cos" | "tan" if near => (sequence.between(-20.0, 20.0), 0.0),
        "sin" | "cos" | "tan" => (sequence.spread(-40.0, 40.0), 0.0), // beyond the reduction in lanes too
        "asin" | "acos" if near => (sequence.between(-1.0, 1.0), 0.0),
        "asin" | "acos" => (sequence.spread(-40.0, 0.0), 0.0),
        "recip_cbrt" if near => (sequence.spread(-1070.0, 1023.0), 0.0),
        "atan" | "cbrt" | "recip_cbrt" => (sequence.spread(-100.0, 100.0), 0.0),
        "powf" if near => (sequence.between(0.0, 4.0), sequence.between(-100.0, 100.0)),
        "powf" => (sequence.spread(-200.0, 200.0).abs(), sequence.between(-4.0, 4.0)),
        "ln_1p_given" if near => {
            let x = sequence.between(-0.999, 2.0);
            (x, 1.0 + x)
        }
        "ln_1p_given" => {
            // A sum of which x has lost all digits.
            let sum = sequence.spread(-1000.0, -60.0).abs();
            (sum - 1.0, sum)
        }
        "atan2" if near => (sequence.between(-1.0, 1.0), sequence.between(-1.0, 1.0)),
        "atan2" => (sequence.spread(-100.0, 100.0), sequence.spread(-100.0, 100.0)),
        _ => unreachable!("no function {name}"),
    }
}

#[test]
fn lanes_equal_the_standard_library_to_the_sum_of_their_errors() {
    let mut sequence = Sequence(1);
    for name in UNARY.into_iter().chain(BINARY) {
        for _ in 0..2000 {
            let pairs: [(f64, f64); 4] = std::array::from_fn(|_| sweep(name, &mut sequence));
            let lanes = apply(name, Lanes(pairs.map(|p| p.0)), Lanes(pairs.map(|p| p.1))).0;
            for ((x, y), lane) in pairs.into_iter().zip(lanes) {
                let scalar = apply(name, x, y);
                let error = (lane - scalar).abs() / unit(scalar, 53, f64::from_bits(1));
                assert!(error <= ULPS_FROM_STANDARD, "{name}({x:e}, {y:e}) = {lane:e}, not {scalar:e}: {error} ulp");
            }
        }
    }
}

#[test]
fn reciprocal_cube_roots_in_lanes_equal_those_of_thirty_digits_within_two_ulp() {
    let mut sequence = Sequence(5);
    for _ in 0..10_000 {
        let x = sequence.spread(-300.0, 300.0);
        let exact = DoubleDouble::lit(x).recip_cbrt();
        let [lane, ..] = Lanes([x; 4]).recip_cbrt().0;
        let error = (DoubleDouble::lit(lane) - exact).primal(0).abs() / unit(lane, 53, f64::from_bits(1));
        assert!(error <= STATED_ULPS, "{x:e}^(−1/3) = {lane:e}: {error} ulp");
    }
}

#[test]
fn tangents_and_hyperbolic_functions_in_lanes_are_as_close_to_thirty_digits_as_the_table_says() {
    // The table has one digit after the point.
    const ROUNDED: f64 = 0.05;
    let mut sequence = Sequence(6);
    for (name, ulps) in [("tan", 1.3), ("sinh", 1.5), ("cosh", 0.7), ("tanh", 1.3)] {
        for k in 0..3000 {
            // Where e^−x is what the last digit of e^x leaves of it, or of 1.
            let x =
                if name == "tan" || k % 2 == 0 { sequence.between(-20.0, 20.0) } else { sequence.between(18.0, 19.5) };
            let exact = apply(name, DoubleDouble::lit(x), DoubleDouble::lit(0.0));
            let [lane, ..] = apply(name, Lanes([x; 4]), Lanes([0.0; 4])).0;
            let error =
                (DoubleDouble::lit(lane) - exact).primal(0).abs() / unit(exact.primal(0), 53, f64::from_bits(1));
            assert!(error <= ulps + ROUNDED, "{name} {x} = {lane:e}: {error} ulp");
        }
    }
}

#[test]
fn hyperbolic_tangents_are_below_one_where_they_are_by_more_than_a_unit() {
    // 1 − tanh x = 2/(e^2x + 1) is more than 2⁻⁵³ for x < 27 ln 2 = 18.71….
    for k in 0..=600 {
        let x = 18.1 + f64::from(k) / 1000.0;
        let [lane, ..] = Lanes([x; 4]).tanh().0;
        assert!(lane < 1.0, "tanh {x} = {lane}");
    }
}

/// Zeros, subnormals, edges of domains and of reductions, infinities and NaN, of both signs.
fn special_values() -> Vec<f64> {
    let sizes = [
        0.0,
        5e-324,
        1e-310,
        f64::MIN_POSITIVE,
        1e-300,
        1e-20,
        0.25,
        0.4375,
        0.5,
        std::f64::consts::FRAC_PI_4,
        1.0,
        1.0 + f64::EPSILON,
        1.5,
        2.0,
        3.0,
        22.5,
        709.7,
        709.8,
        710.6,
        745.2,
        750.0,
        26_353_589.0,
        26_353_590.0,
        1e15,
        9_007_199_254_740_991.0,
        1e22,
        1e300,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    sizes.into_iter().flat_map(|x| [x, -x]).collect()
}

#[test]
fn special_values_are_the_standard_librarys() {
    let agree = |name: &str, x: f64, y: f64, lane: f64, scalar: f64| {
        let same = lane.to_bits() == scalar.to_bits() || (lane.is_nan() && scalar.is_nan());
        let ordinary = scalar.is_finite() && 0.0 < scalar.abs();
        let close = ordinary && (lane - scalar).abs() <= ULPS_FROM_STANDARD * unit(scalar, 53, f64::from_bits(1));
        assert!(same || close, "{name}({x:e}, {y:e}) = {lane:e}, not {scalar:e}");
    };
    for x in special_values() {
        for name in UNARY {
            agree(name, x, 0.0, apply(name, Lanes([x, 1.0]), Lanes([0.0; 2])).0[0], apply(name, x, 0.0));
        }
        for y in special_values() {
            for name in BINARY {
                agree(name, x, y, apply(name, Lanes([1.0, x]), Lanes([1.0, y])).0[1], apply(name, x, y));
            }
        }
    }
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "arguments of the single-precision run")]
fn special_values_in_single_precision_are_the_standard_librarys() {
    let agree = |name: &str, x: f32, y: f32, lane: f32, scalar: f32| {
        let same = lane.to_bits() == scalar.to_bits() || (lane.is_nan() && scalar.is_nan());
        let least = f64::from(f32::from_bits(1));
        let allowed = ULPS_FROM_STANDARD * unit(f64::from(scalar), 24, least);
        let ordinary = scalar.is_finite() && 0.0 < scalar.abs();
        let close = ordinary && f64::from((lane - scalar).abs()) <= allowed;
        assert!(same || close, "{name}({x:e}, {y:e}) = {lane:e}, not {scalar:e}");
    };
    let values =
        || special_values().into_iter().map(|x| x as f32).chain([88.8, 89.1, -87.4, -103.5, -104.5, 3e-39, 1e38]);
    for x in values() {
        for name in UNARY {
            agree(name, x, 0.0, apply(name, Lanes([x, 1.0]), Lanes([0.0; 2])).0[0], apply(name, x, 0.0));
        }
        for y in values() {
            for name in BINARY {
                agree(name, x, y, apply(name, Lanes([1.0, x]), Lanes([1.0, y])).0[1], apply(name, x, y));
            }
        }
    }
}

/// One function of many pairs, N at a time.
struct Many<'a, const N: usize> {
    name: &'a str,
    pairs: &'a [(f64, f64)],
}

impl<const N: usize> Kernel for Many<'_, N> {
    type Output = Vec<u64>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Vec<u64> {
        let mut bits = Vec::with_capacity(self.pairs.len());
        for chunk in self.pairs.chunks_exact(N) {
            let (mut x, mut y) = (Lanes::<f64, N>::lit(0.0), Lanes::lit(0.0));
            for (i, (a, b)) in chunk.iter().enumerate() {
                (x.0[i], y.0[i]) = (*a, *b);
            }
            bits.extend(apply(self.name, x, y).0.map(f64::to_bits));
        }
        bits
    }
}

#[test]
fn results_are_bit_identical_for_every_width_and_level() {
    let mut sequence = Sequence(2);
    let special = special_values();
    for name in UNARY.into_iter().chain(BINARY) {
        let mut pairs: Vec<_> = (0..200).map(|_| sweep(name, &mut sequence)).collect();
        pairs.extend(special.iter().flat_map(|x| [(*x, 0.75), (0.75, *x)]));
        let reference = dispatch_at(Level::Base, Many::<1> { name, pairs: &pairs });
        for level in Level::available() {
            for bits in [
                dispatch_at(level, Many::<1> { name, pairs: &pairs }),
                dispatch_at(level, Many::<2> { name, pairs: &pairs }),
                dispatch_at(level, Many::<4> { name, pairs: &pairs }),
                dispatch_at(level, Many::<8> { name, pairs: &pairs }),
            ] {
                for (i, (a, b)) in bits.iter().zip(&reference).enumerate() {
                    // NaN has many patterns; which one comes out is left to the processor.
                    let both_nan = f64::from_bits(*a).is_nan() && f64::from_bits(*b).is_nan();
                    assert!(a == b || both_nan, "{name}{:?} at {level:?}", pairs[i]);
                }
            }
        }
    }
}

/// xⁿ is defined for all whole n, also where xʸ would not be.
#[test]
fn whole_powers_equal_products() {
    fn check<T: Element, const N: usize>()
    where
        Lanes<T, N>: Real,
    {
        let x = Lanes::<T, N>::lit(-1.5);
        for (n, expected) in [(0, 1.0), (1, -1.5), (2, 2.25), (3, -3.375), (5, -7.59375), (-1, -1.0 / 1.5)] {
            assert_eq!(x.powi(n), Lanes::lit(expected), "n = {n}");
        }
    }
    check::<f64, 4>();
    check::<f32, 8>();
}
