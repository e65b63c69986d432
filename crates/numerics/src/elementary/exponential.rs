//! eˣ, eˣ − 1 and the hyperbolic functions.
//!
//! ```text
//! x = k ln 2 + r,  |r| ≤ ½ ln 2        eˣ = 2ᵏ (1 + p),   p = eʳ − 1 = r + r² P(r)
//! ```
//! All follow from k and p, the latter held as a sum of two doubles:
//!
//! ```text
//! eˣ − 1 = 2ᵏ   [(1 − c) + p],                    c = 2⁻ᵏ
//! sinh x = 2ᵏ⁻¹ [(1 − c) + p + c p/(1 + p)],      c = 2⁻²ᵏ
//! cosh x = 2ᵏ⁻¹ [(1 + c) + p − c p/(1 + p)],      c = 2⁻²ᵏ
//! tanh x = [(1 − c) + p] / [(1 + c) + p],         c = 2⁻ᵏ,  k and p those of 2x
//! ```

use super::{LN_2_LOWER, LN_2_UPPER, ROUND, choose, ordered_sum, polynomial_9};

/// (eʳ − 1 − r)/r² on |r| ≤ ½ ln 2: near-minimax of degree 9, error 2⁻⁵⁶ after multiplication by r².
const EXPONENTIAL: [f64; 10] = [
    0.500_000_000_000_000_1,
    0.166_666_666_666_666_69,
    0.041_666_666_666_624_13,
    0.008_333_333_333_330_062,
    0.001_388_888_891_721_371_7,
    0.000_198_412_698_630_536_18,
    2.480_152_129_595_437_6e-05,
    2.755_726_845_999_706_4e-06,
    2.762_008_844_540_974_6e-07,
    2.510_038_549_551_032e-08,
];

/// What eˣ is made of.
struct Parts {
    /// k + 1.5 · 2⁵², which holds the whole number k in its lowest bits.
    shifted: f64,
    /// eʳ − 1, rounded.
    p: f64,
    /// What the rounding left of it.
    p_lower: f64,
}

/// (k + `ROUND`, r, lower part of r) of x + `lower`, |x| < 2000.
#[cfg_attr(not(debug_assertions), inline(always))]
fn reduce(x: f64, lower: f64) -> (f64, f64, f64) {
    let shifted = x * core::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let upper = x - k * LN_2_UPPER;
    let correction = k * LN_2_LOWER - lower;
    let r = upper - correction;
    (shifted, r, (upper - r) - correction)
}

/// The parts of eˣ, |x| < 2000.
#[cfg_attr(not(debug_assertions), inline(always))]
fn parts(x: f64) -> Parts {
    let (shifted, r, r_lower) = reduce(x, 0.0);
    let (p, p_lower) = ordered_sum(r, r * r * polynomial_9(r, EXPONENTIAL));
    Parts { shifted, p, p_lower: p_lower + (r_lower + r_lower * r) }
}

/// x · 2ᵏ for |k| ≤ 2044, in two steps, so that neither factor overflows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn scale(x: f64, shifted: f64) -> f64 {
    // 1023 is added to each half of k; the shift by 52 drops all other bits.
    let both = shifted.to_bits().wrapping_add(2046);
    let half = both >> 1;
    x * f64::from_bits(half << 52) * f64::from_bits(both.wrapping_sub(half) << 52)
}

/// 2⁻ᵐᵏ for −1 ≤ mk ≤ 100 or so, else 0: where it is negligible beside 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn reciprocal_power(shifted: f64, m: u64) -> f64 {
    let power = f64::from_bits(1023_u64.wrapping_sub(shifted.to_bits().wrapping_mul(m)) << 52);
    choose(shifted < ROUND + 100.0, power, 0.0)
}

/// e^(x + lower) for |lower| ≪ 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn exp_of_sum(x: f64, lower: f64) -> f64 {
    let bounded = choose(x < -746.0, -746.0, choose(710.0 < x, 710.0, x));
    let (shifted, r, _) = reduce(bounded, lower);
    scale(1.0 + (r + r * r * polynomial_9(r, EXPONENTIAL)), shifted)
}

/// eˣ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn exp(x: f64) -> f64 {
    exp_of_sum(x, 0.0)
}

/// eˣ − 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn exp_m1(x: f64) -> f64 {
    // Below −40 the result is −1.
    let Parts { shifted, p, p_lower } = parts(choose(x < -40.0, -40.0, choose(710.0 < x, 710.0, x)));
    let (one, one_lower) = ordered_sum(1.0, -reciprocal_power(shifted, 1));
    let (sum, sum_lower) = ordered_sum(one, p);
    choose(x == 0.0, x, scale(sum + (sum_lower + (p_lower + one_lower)), shifted))
}

/// The parts of e^|x|, c = 2⁻²ᵏ and c p/(1 + p).
#[cfg_attr(not(debug_assertions), inline(always))]
fn hyperbolic_parts(x: f64) -> (Parts, f64, f64) {
    let magnitude = x.abs();
    let parts = parts(choose(712.0 < magnitude, 712.0, magnitude));
    let c = reciprocal_power(parts.shifted, 2);
    let (g, g_lower) = ordered_sum(1.0, parts.p);
    let quotient = parts.p / g;
    let rest = c * (quotient - quotient * (g_lower + parts.p_lower));
    (parts, c, rest)
}

/// sinh x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sinh(x: f64) -> f64 {
    let (Parts { shifted, p, p_lower }, c, rest) = hyperbolic_parts(x);
    let (one, one_lower) = ordered_sum(1.0, -c);
    let (sum, sum_lower) = ordered_sum(one, p);
    scale(sum + (rest + (sum_lower + (p_lower + one_lower))), shifted - 1.0).copysign(x)
}

/// cosh x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cosh(x: f64) -> f64 {
    let (Parts { shifted, p, p_lower }, c, rest) = hyperbolic_parts(x);
    let (one, one_lower) = ordered_sum(1.0, c);
    let (sum, sum_lower) = ordered_sum(one, p);
    scale(sum + (sum_lower + (p_lower + one_lower) - rest), shifted - 1.0)
}

/// tanh x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn tanh(x: f64) -> f64 {
    // Beyond 22 the result is 1 to rounding.
    let magnitude = x.abs();
    let Parts { shifted, p, p_lower } = parts(2.0 * choose(22.0 < magnitude, 22.0, magnitude));
    let c = reciprocal_power(shifted, 1);
    let (minus, minus_lower) = ordered_sum(1.0, -c);
    let (plus, plus_lower) = ordered_sum(1.0, c);
    let (numerator, n_lower) = ordered_sum(minus, p);
    let (denominator, d_lower) = ordered_sum(plus, p);
    let quotient = numerator / denominator;
    let (n_rest, d_rest) = (n_lower + (p_lower + minus_lower), d_lower + (p_lower + plus_lower));
    let correction = (n_rest - quotient * d_rest) / denominator;
    (quotient + correction).copysign(x)
}
