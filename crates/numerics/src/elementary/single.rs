//! The functions for lanes of `f32`: computed in doubles, to about 2⁻³⁰.
//!
//! Twenty-nine spare bits replace every correction: polynomials are about half as long as for doubles,
//! nothing is held in two parts (but π/2), no intermediate result overflows or is subnormal. The result is
//! right to 0.51 ulp after rounding to single precision. Arguments are singles; the equations are those of
//! the sister files.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E, PI};

use super::power::{CUBE_ROOT, start_of_recip_cbrt, with_conventions};
use super::trigonometric::{HALF_PI, flip};
use super::{
    FRACTION, ROUND, both, choose, cubic, either, logarithm, nearest, polynomial_5, polynomial_6, power_of_two,
};

/// (eʳ − 1 − r)/r² on |r| ≤ ½ ln 2: near-minimax of degree 5, error 2⁻³² after multiplication by r².
const EXPONENTIAL: [f64; 6] = [
    0.500_000_001_346_581,
    0.166_666_666_816_232_32,
    0.041_666_464_925_285_904,
    0.008_333_310_925_480_9,
    0.001_393_364_999_630_925_1,
    0.000_198_909_908_246_736_54,
];

/// (2 artanh(s)/s − 2)/z on m ∈ [√½, √2]: near-minimax of degree 4, error 2⁻⁴² after multiplication by z.
/// Long enough for xʸ, whose exponent may be 100.
const LOGARITHM: [f64; 5] = [
    0.666_666_666_673_758_1,
    0.399_999_987_963_595_65,
    0.285_717_547_355_818,
    0.221_913_881_547_209_76,
    0.193_628_999_726_493_5,
];

/// (sin r/r − 1)/z on |r| ≤ π/4: near-minimax of degree 3, error 2⁻³⁵ after multiplication by z.
const SINE: [f64; 4] =
    [-0.166_666_666_638_530_44, 0.008_333_331_873_837_089, -0.000_198_400_862_637_554_43, 2.724_986_465_513_958_5e-6];

/// (cos r − 1 + z/2)/z² on |r| ≤ π/4: near-minimax of degree 3, error 2⁻⁴⁰ after multiplication by z².
const COSINE: [f64; 4] =
    [0.041_666_666_664_319_33, -0.001_388_888_767_128_810_8, 2.480_059_998_353_171e-5, -2.730_090_816_799_653_7e-7];

/// (arcsin x/x − 1)/z on |x| ≤ ½: near-minimax of degree 6, error 2⁻³³ after multiplication by z.
const ARCSINE: [f64; 7] = [
    0.166_666_666_860_856_43,
    0.074_999_924_044_018_38,
    0.044_647_663_888_134_85,
    0.030_269_138_728_589_183,
    0.023_611_817_008_891_752,
    0.010_574_415_516_912_909,
    0.030_974_540_371_355_073,
];

/// (arctan t/t − 1)/z on |t| ≤ tan π/8: near-minimax of degree 5, error 2⁻³³ after multiplication by z.
const ARCTANGENT: [f64; 6] = [
    -0.333_333_332_791_942_6,
    0.199_999_772_377_739_5,
    -0.142_841_500_656_340_1,
    0.110_713_441_179_007_68,
    -0.086_245_202_734_562_75,
    0.050_477_363_420_277_72,
];

/// tan π/8 and tan 3π/8.
const TAN_PI_8: f64 = 0.414_213_562_373_095_03;
const TAN_3_PI_8: f64 = 2.414_213_562_373_095;

/// (eʳ − 1, 2ᵏ) of x = k ln 2 + r, |x| ≤ 700.
#[cfg_attr(not(debug_assertions), inline(always))]
fn parts(x: f64) -> (f64, f64) {
    let shifted = x * LOG2_E + ROUND;
    let r = x - (shifted - ROUND) * LN_2;
    let p = r + r * r * polynomial_5(r, EXPONENTIAL);
    (p, f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52))
}

/// x kept within what singles can show of eˣ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn bounded(x: f64) -> f64 {
    choose(x < -110.0, -110.0, choose(110.0 < x, 110.0, x))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn exp(x: f64) -> f64 {
    let (p, power) = parts(bounded(x));
    power + power * p
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn exp_m1(x: f64) -> f64 {
    let (p, power) = parts(bounded(x));
    choose(x == 0.0, x, power * p + (power - 1.0))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sinh(x: f64) -> f64 {
    let (p, power) = parts(bounded(x.abs()));
    let t = power * p + (power - 1.0);
    (0.5 * (t + t / (t + 1.0))).copysign(x)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cosh(x: f64) -> f64 {
    let (p, power) = parts(bounded(x));
    let e = power + power * p;
    0.5 * (e + 1.0 / e)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn tanh(x: f64) -> f64 {
    let (p, power) = parts(2.0 * bounded(x.abs()));
    let t = power * p + (power - 1.0);
    (t / (t + 2.0)).copysign(x)
}

/// ln u of a normal double 0 < u < ∞.
#[cfg_attr(not(debug_assertions), inline(always))]
fn ln_of_positive(u: f64) -> f64 {
    let (k, m) = logarithm::split_normal(u);
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let z2 = z * z;
    let c = LOGARITHM;
    let series = cubic(z, z2, [c[0], c[1], c[2], c[3]]) + c[4] * (z2 * z2);
    k * LN_2 + (2.0 * s + s * z * series)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ln(x: f64) -> f64 {
    let finite = choose(x < f64::INFINITY, ln_of_positive(x), x);
    choose(0.0 < x, finite, choose(x == 0.0, f64::NEG_INFINITY, f64::NAN))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ln_1p_given(x: f64, sum: f64) -> f64 {
    let near = x.abs() <= 0.5;
    let u = choose(near, 1.0 + x, sum);
    let lost = choose(near, x - (u - 1.0), 0.0);
    let finite = choose(u < f64::INFINITY, ln_of_positive(u) + lost, u);
    choose(x == 0.0, x, choose(0.0 < u, finite, choose(u == 0.0, f64::NEG_INFINITY, f64::NAN)))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ln_1p(x: f64) -> f64 {
    // What the sum loses of a small x is added as it is: where that matters, the sum is nearly 1.
    let u = 1.0 + x;
    let lost = choose(x < 1.0, x - (u - 1.0), 0.0);
    let finite = choose(x < f64::INFINITY, ln_of_positive(u) + lost, x);
    let inside = choose(x == 0.0, x, finite);
    choose(-1.0 < x, inside, choose(u == 0.0, f64::NEG_INFINITY, f64::NAN))
}

/// (n in the lowest bits, sin r, cos r).
#[cfg_attr(not(debug_assertions), inline(always))]
fn angle_parts(x: f64) -> (u64, f64, f64) {
    let shifted = x * FRAC_2_PI + ROUND;
    let n = shifted - ROUND;
    let r = ((x - n * HALF_PI[0]) - n * HALF_PI[1]) - n * HALF_PI[2];
    let z = r * r;
    let z2 = z * z;
    (shifted.to_bits(), r + r * z * cubic(z, z2, SINE), (1.0 - 0.5 * z) + z2 * cubic(z, z2, COSINE))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    let (n, sine, cosine) = angle_parts(x);
    let odd = n & 1 == 1;
    let (s, c) = (choose(odd, cosine, sine), choose(odd, sine, cosine));
    (choose(x == 0.0, x, flip(s, n, 1)), flip(c, n.wrapping_add(1), 1))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn tan(x: f64) -> f64 {
    let (n, sine, cosine) = angle_parts(x);
    let odd = n & 1 == 1;
    let quotient = choose(odd, cosine, sine) / choose(odd, sine, cosine);
    choose(x == 0.0, x, flip(quotient, n, 0))
}

/// (|x| ≤ ½, arcsin of |x| or of √((1 − |x|)/2)).
#[cfg_attr(not(debug_assertions), inline(always))]
fn arcsine_parts(x: f64) -> (bool, f64) {
    let magnitude = x.abs();
    let small = magnitude <= 0.5;
    let half = 0.5 * (1.0 - magnitude);
    let z = choose(small, x * x, half);
    let y = choose(small, magnitude, half.sqrt());
    (small, y + y * z * polynomial_6(z, ARCSINE))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn asin(x: f64) -> f64 {
    let (small, angle) = arcsine_parts(x);
    choose(small, angle, FRAC_PI_2 - 2.0 * angle).copysign(x)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn acos(x: f64) -> f64 {
    let (small, angle) = arcsine_parts(x);
    choose(small, FRAC_PI_2 - angle.copysign(x), choose(x < 0.0, PI - 2.0 * angle, 2.0 * angle))
}

/// The angle of (x, y), 0 ≤ x, 0 ≤ y.
#[cfg_attr(not(debug_assertions), inline(always))]
fn angle_of_positive(y: f64, x: f64) -> f64 {
    let (low, high) = (y < TAN_PI_8 * x, y <= TAN_3_PI_8 * x);
    let numerator = choose(low, y, choose(high, y - x, -x));
    let denominator = choose(low, x, choose(high, x + y, y));
    let base = choose(low, 0.0, choose(high, FRAC_PI_4, FRAC_PI_2));
    let t = numerator / denominator;
    let z = t * t;
    base + (t + t * z * polynomial_5(z, ARCTANGENT))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn atan(x: f64) -> f64 {
    angle_of_positive(x.abs(), 1.0).copysign(x)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    let (a, b) = (x.abs(), y.abs());
    let both_infinite = both(a == f64::INFINITY, b == f64::INFINITY);
    let both_zero = both(a == 0.0, b == 0.0);
    let (a, b) = (choose(either(both_infinite, both_zero), 1.0, a), choose(both_infinite, 1.0, b));
    let angle = angle_of_positive(b, a);
    choose(x.is_sign_negative(), PI - angle, angle).copysign(y)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn powf(x: f64, y: f64) -> f64 {
    // Beyond 10³⁰ every |x| ≠ 1 gives 0 or ∞ already.
    let bounded = choose(y.abs() < 1e30, y, 1e30_f64.copysign(y));
    let exponent = bounded * ln_of_positive(x.abs());
    with_conventions(x, y, exp(choose(exponent.abs() < 200.0, exponent, 200.0_f64.copysign(exponent))))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cbrt(x: f64) -> f64 {
    let magnitude = x.abs();
    let bits = magnitude.to_bits();
    let m = f64::from_bits((bits & FRACTION) | 0x3ff0_0000_0000_0000);
    let exponent = f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 1023.0);
    let q = nearest((exponent - 1.0) * (1.0 / 3.0));
    let j = exponent - 3.0 * q;
    let (one, two) = (both(0.5 < j, j < 1.5), 1.5 < j);
    let u = m * choose(one, 2.0, choose(two, 4.0, 1.0));
    let g =
        polynomial_5(m, CUBE_ROOT) * choose(one, 1.259_921_049_894_873_2, choose(two, 1.587_401_051_968_199_6, 1.0));
    // One step of Newton: the relative error 2⁻¹⁹ becomes its square.
    let improved = g - (g * g * g - u) / (3.0 * g * g);
    let result = improved * power_of_two(q);
    choose(both(0.0 < magnitude, magnitude < f64::INFINITY), result, magnitude).copysign(x)
}

/// 1/∛x, of singles: even the smallest is an ordinary double.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn recip_cbrt(x: f64) -> f64 {
    let magnitude = x.abs();
    let y = start_of_recip_cbrt(magnitude);
    let h = 1.0 - (magnitude * y) * (y * y);
    let signed = y.copysign(x);
    let edge = choose(magnitude == 0.0, f64::INFINITY, 0.0).copysign(x);
    choose(either(magnitude == 0.0, magnitude == f64::INFINITY), edge, signed + signed * (h * (1.0 / 3.0)))
}
