//! xʸ, ∛x and 1/∛x.
//!
//! ```text
//! xʸ = e^(y ln x)      ln x = k ln 2 + ⅔ s (3 + z + z² R(z)),   s = (m − 1)/(m + 1),  z = s²
//! ```
//! with ln x and its product with y held as sums of two doubles: the exponent, up to 745, must be right to
//! 2⁻⁵⁵. The exact products by cutting factors follow the method of fdlibm's `e_pow.c` (Sun, 1993).
//!
//! ```text
//! x = 2^(3q + j) m:   g ≈ 2^(j/3) m^(1/3),   then one step of Halley   g ← g + g (u − g³)/(2g³ + u)
//! y ≈ 1/∛x:      h = 1 − x y³,   y ← y (1 − h)^(−1/3)   by polynomials in h, without a division
//! ```

use super::exponential::exp_of_sum;
use super::logarithm::split;
use super::{
    FRACTION, LN_2_LOWER, LN_2_UPPER, ROUND, both, choose, cubic, either, nearest, ordered_sum, polynomial_5,
    polynomial_6, power_of_two, upper,
};

/// 1.5 (2 artanh(s)/s − 2 − ⅔z)/z² as a function of z on m ∈ [√½, √2]: near-minimax of degree 6, error
/// 2⁻⁶² relative to ln m after multiplication by z²/3.
const LOGARITHM: [f64; 7] = [
    0.4 * 1.5,
    0.285_714_285_713_384_53 * 1.5,
    0.222_222_222_711_272_43 * 1.5,
    0.181_818_082_434_800_16 * 1.5,
    0.153_855_750_925_574_3 * 1.5,
    0.132_859_475_944_149_6 * 1.5,
    0.129_137_392_911_296_22 * 1.5,
];

/// ⅔ in two parts, the upper of 26 bits.
const TWO_THIRDS: (f64, f64) = (0.666_666_656_732_559_2, 9.934_107_462_565_104e-9);

/// m^(1/3) on 1 ≤ m ≤ 2: near-minimax of degree 5, relative error 2⁻¹⁹.
pub(super) const CUBE_ROOT: [f64; 6] = [
    0.475_146_936_238_902_53,
    0.831_743_144_247_930_9,
    -0.460_297_726_769_620_9,
    0.196_654_797_013_600_78,
    -0.048_318_320_681_661_14,
    0.005_072_953_325_277_491,
];

/// ln x for 0 < x < ∞ as an upper part of 26 bits and the rest.
#[cfg_attr(not(debug_assertions), inline(always))]
fn ln_in_two_parts(x: f64) -> (f64, f64) {
    let (k, m) = split(x);
    // s in two parts: what the upper part leaves of f is exact.
    let f = m - 1.0;
    let (d, d_error) = ordered_sum(2.0, f);
    let inverse = 1.0 / d;
    let s = f * inverse;
    let s_upper = upper(s);
    let d_upper = upper(d);
    let s_lower = inverse * ((f - s_upper * d_upper) - s_upper * ((d - d_upper) + d_error));
    // t = 3 + z + z² R(z) in two parts.
    let z = s * s;
    let square = s_upper * s_upper;
    let rest = z * z * polynomial_6(z, LOGARITHM) + s_lower * (s_upper + s);
    let t_upper = upper(3.0 + square + rest);
    let t_lower = rest - ((t_upper - 3.0) - square);
    // ⅔ s t.
    let product = s_upper * t_upper;
    let product_rest = s_lower * t_upper + t_lower * s;
    let p_upper = upper(product + product_rest);
    let p_lower = product_rest - (p_upper - product);
    let ln_m = TWO_THIRDS.0 * p_upper;
    let ln_m_rest = TWO_THIRDS.1 * p_upper + p_lower * (2.0 / 3.0);
    let (sum, error) = ordered_sum(k * LN_2_UPPER, ln_m);
    let lower = error + (ln_m_rest + k * LN_2_LOWER);
    let cut = upper(sum + lower);
    (cut, (sum - cut) + lower)
}

/// The nearest whole number of 0 ≤ x.
#[cfg_attr(not(debug_assertions), inline(always))]
fn nearest_of_positive(x: f64) -> f64 {
    choose(x < 4_503_599_627_370_496.0, (x + 4_503_599_627_370_496.0) - 4_503_599_627_370_496.0, x)
}

/// xʸ, with the conventions of C's `pow`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn powf(x: f64, y: f64) -> f64 {
    let magnitude = x.abs();
    let (l_upper, l_lower) = ln_in_two_parts(magnitude);
    // Beyond 2⁶⁶ every |x| ≠ 1 gives 0 or ∞ already.
    let huge = 73_786_976_294_838_206_464.0;
    let bounded = choose(y < -huge, -huge, choose(huge < y, huge, y));
    let y_upper = upper(bounded);
    let product = y_upper * l_upper;
    let (sum, error) = ordered_sum(product, (bounded - y_upper) * l_upper + bounded * l_lower);
    let positive = exp_of_sum(sum, choose(sum.abs() < 800.0, error, 0.0));
    with_conventions(x, y, positive)
}

/// xʸ, given |x|ʸ for ordinary |x|.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::float_cmp, reason = "whether y is a whole number, and whether x is 1, are exact questions")]
pub(super) fn with_conventions(x: f64, y: f64, positive: f64) -> f64 {
    let magnitude = x.abs();
    // |x| = 0 or ∞.
    let grows = (magnitude == 0.0) == (y < 0.0);
    let edge = choose(grows, f64::INFINITY, 0.0);
    let size = choose(either(magnitude == 0.0, magnitude == f64::INFINITY), edge, positive);
    // Negative x.
    let y_magnitude = y.abs();
    let whole = nearest_of_positive(y_magnitude) == y_magnitude;
    let even = nearest_of_positive(0.5 * y_magnitude) == 0.5 * y_magnitude;
    let signed = choose(both(x.is_sign_negative(), both(whole, !even)), -size, size);
    let defined = choose(both(both(x < 0.0, magnitude < f64::INFINITY), !whole), f64::NAN, signed);
    let number = choose(either(x.is_nan(), y.is_nan()), f64::NAN, defined);
    choose(either(y == 0.0, x == 1.0), 1.0, number)
}

/// ∛x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cbrt(x: f64) -> f64 {
    let magnitude = x.abs();
    let small = magnitude < f64::MIN_POSITIVE;
    let bits = choose(small, magnitude * 18_014_398_509_481_984.0, magnitude).to_bits();
    let m = f64::from_bits((bits & FRACTION) | 0x3ff0_0000_0000_0000);
    let biased = f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - 4_503_599_627_370_496.0;
    // 54 and 1023 are multiples of 3.
    let exponent = biased - choose(small, 1077.0, 1023.0);
    let q = nearest((exponent - 1.0) * (1.0 / 3.0));
    let j = exponent - 3.0 * q;
    let (one, two) = (both(0.5 < j, j < 1.5), 1.5 < j);
    let u = m * choose(one, 2.0, choose(two, 4.0, 1.0));
    let root = choose(one, 1.259_921_049_894_873_2, choose(two, 1.587_401_051_968_199_6, 1.0));
    // g has 26 bits, so that its square is exact.
    let g = upper(polynomial_5(m, CUBE_ROOT) * root);
    let quotient = u / (g * g);
    let improved = g + g * (quotient - g) / (2.0 * g + quotient);
    let result = improved * power_of_two(q);
    choose(both(0.0 < magnitude, magnitude < f64::INFINITY), result, magnitude).copysign(x)
}

/// The leading 32 bits of ∛x⁻¹ are this less a third of those of x, within 3.5 % of the value: |1 − x y³| ≤ 0.103.
const RECIPROCAL_CUBE_ROOT: f64 = 1_430_186_361.0;

/// ((1 − h)^(−1/3) − 1)/h on |h| ≤ 0.103: near-minimax of degree 3, which leaves a relative error of 1.9e-7.
const RECIPROCAL_STEP: [f64; 4] =
    [0.333_331_627_640_714_8, 0.222_220_814_474_155_56, 0.174_148_754_032_823_68, 0.145_176_062_134_650_92];

/// x^(−1/3) of 2⁻¹⁰²² ≤ x < ∞, with a relative error of 1.9e-7.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn start_of_recip_cbrt(x: f64) -> f64 {
    // The leading 32 bits placed in the fraction of 2⁵² are a float without a conversion.
    let leading = f64::from_bits((x.to_bits() >> 32) | 0x4330_0000_0000_0000) - 4_503_599_627_370_496.0;
    let y = f64::from_bits(((RECIPROCAL_CUBE_ROOT + ROUND) - leading * (1.0 / 3.0)).to_bits() << 32);
    let h = 1.0 - (x * y) * (y * y);
    // In this order the steps wait least for one another.
    y + (y * h) * cubic(h, h * h, RECIPROCAL_STEP)
}

/// 1/∛x: 1.1 ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn recip_cbrt(x: f64) -> f64 {
    let magnitude = x.abs();
    let small = magnitude < f64::MIN_POSITIVE;
    let u = choose(small, magnitude * 18_014_398_509_481_984.0, magnitude);
    let y = start_of_recip_cbrt(u);
    // h is exact up to the roundings of x y³.
    let h = 1.0 - (u * y) * (y * y);
    // Scale, sign and edges wait for nothing that h waits for: behind it is one step and one choice.
    let scaled = (y * choose(small, 262_144.0, 1.0)).copysign(x);
    let edge = choose(magnitude == 0.0, f64::INFINITY, 0.0).copysign(x);
    let improved = scaled + (scaled * h) * (1.0 / 3.0 + (2.0 / 9.0) * h);
    choose(either(magnitude == 0.0, magnitude == f64::INFINITY), edge, improved)
}

/// The largest |n| for which xⁿ is made of products; beyond, xʸ is faster.
pub(crate) const LARGEST_PRODUCT: u32 = 64;

/// a b as a sum of two doubles, for factors that are such sums.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn product(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let (a_upper, b_upper) = (upper(a.0), upper(b.0));
    let (a_lower, b_lower) = (a.0 - a_upper, b.0 - b_upper);
    let p = a.0 * b.0;
    let error = ((a_upper * b_upper - p) + (a_upper * b_lower + a_lower * b_upper)) + a_lower * b_lower;
    (p, error + (a.0 * b.1 + a.1 * b.0))
}

/// 1/x as a sum of two doubles.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn reciprocal(x: f64) -> (f64, f64) {
    let r = 1.0 / x;
    let (p, p_lower) = product((r, 0.0), (x, 0.0));
    (r, r * ((1.0 - p) - p_lower))
}

/// The sum of the parts; the upper one where it is zero or infinite and the lower one means nothing.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sum(a: (f64, f64)) -> f64 {
    choose(both(0.0 < a.0.abs(), a.0.abs() < f64::INFINITY), a.0 + a.1, a.0)
}

/// xⁿ by repeated squaring in doubles, whose roundings are far below those of the result.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]
pub(crate) fn powi_of_single(x: f32, n: i32) -> f32 {
    let (mut square, mut product) = (f64::from(x), 1.0);
    let mut bits = n.unsigned_abs();
    while 0 < bits {
        if bits & 1 == 1 {
            product *= square;
        }
        square *= square;
        bits >>= 1;
    }
    (if n < 0 { 1.0 / product } else { product }) as f32
}
