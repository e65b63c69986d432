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

use super::{LN_2_LOWER, LN_2_UPPER, choose, nearest, ordered_sum, polynomial_10, power_of_two};

/// (eʳ − 1 − r)/r² on |r| ≤ ½ ln 2: near-minimax of degree 10, error 2⁻⁶¹ after multiplication by r².
const EXPONENTIAL: [f64; 11] = [
    0.5,
    0.166_666_666_666_666_7,
    0.041_666_666_666_666_67,
    0.008_333_333_333_326_136,
    0.001_388_888_888_888_374_8,
    0.000_198_412_698_748_206_27,
    2.480_158_732_554_774_3e-5,
    2.755_725_540_020_642_2e-6,
    2.755_727_364_311_03e-7,
    2.510_521_700_472_074_5e-8,
    2.091_468_696_808_687_6e-9,
];

/// (k, p, lower part of p) for x + `lower`, |x| < 2000.
#[inline(always)]
fn parts(x: f64, lower: f64) -> (f64, f64, f64) {
    let k = nearest(x * core::f64::consts::LOG2_E);
    let upper = x - k * LN_2_UPPER;
    let correction = k * LN_2_LOWER - lower;
    let r = upper - correction;
    let r_lower = (upper - r) - correction;
    let (p, p_lower) = ordered_sum(r, r * r * polynomial_10(r, EXPONENTIAL));
    (k, p, p_lower + (r_lower + r_lower * r))
}

/// x · 2ᵏ for |k| ≤ 2044, in two steps, so that neither factor overflows.
#[inline(always)]
fn scale(x: f64, k: f64) -> f64 {
    let half = nearest(0.5 * k);
    x * power_of_two(half) * power_of_two(k - half)
}

/// e^(x + lower) for |lower| ≪ 1.
#[inline(always)]
pub(super) fn exp_of_sum(x: f64, lower: f64) -> f64 {
    let bounded = choose(x < -746.0, -746.0, choose(710.0 < x, 710.0, x));
    let (k, p, p_lower) = parts(bounded, lower);
    scale(1.0 + (p + p_lower), k)
}

/// eˣ.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    exp_of_sum(x, 0.0)
}

/// eˣ − 1.
#[inline(always)]
pub(crate) fn exp_m1(x: f64) -> f64 {
    // Below −40 the result is −1; c = 2⁻ᵏ is negligible long before it would be subnormal.
    let (k, p, p_lower) = parts(choose(x < -40.0, -40.0, choose(710.0 < x, 710.0, x)), 0.0);
    let c = power_of_two(-choose(100.0 < k, 100.0, k));
    let (one, one_lower) = ordered_sum(1.0, -c);
    let (sum, sum_lower) = ordered_sum(one, p);
    choose(x == 0.0, x, scale(sum + (sum_lower + (p_lower + one_lower)), k))
}

/// (k, 1 − c, 1 + c, p, c p/(1 + p)) of |x|, c = 2⁻²ᵏ, with the lower parts of the second to fourth added up.
#[inline(always)]
fn hyperbolic_parts(x: f64) -> (f64, f64, f64, f64) {
    let magnitude = x.abs();
    let (k, p, p_lower) = parts(choose(712.0 < magnitude, 712.0, magnitude), 0.0);
    let c = power_of_two(-2.0 * choose(100.0 < k, 100.0, k));
    let (g, g_lower) = ordered_sum(1.0, p);
    let quotient = p / g;
    (k, p, p_lower, c * (quotient - quotient * (g_lower + p_lower)))
}

/// sinh x.
#[inline(always)]
pub(crate) fn sinh(x: f64) -> f64 {
    let (k, p, p_lower, q) = hyperbolic_parts(x);
    let c = power_of_two(-2.0 * choose(100.0 < k, 100.0, k));
    let (one, one_lower) = ordered_sum(1.0, -c);
    let (sum, sum_lower) = ordered_sum(one, p);
    scale(sum + (q + (sum_lower + (p_lower + one_lower))), k - 1.0).copysign(x)
}

/// cosh x.
#[inline(always)]
pub(crate) fn cosh(x: f64) -> f64 {
    let (k, p, p_lower, q) = hyperbolic_parts(x);
    let c = power_of_two(-2.0 * choose(100.0 < k, 100.0, k));
    let (one, one_lower) = ordered_sum(1.0, c);
    let (sum, sum_lower) = ordered_sum(one, p);
    scale(sum + (sum_lower + (p_lower + one_lower) - q), k - 1.0)
}

/// tanh x.
#[inline(always)]
pub(crate) fn tanh(x: f64) -> f64 {
    // Beyond 22 the result is 1 to rounding.
    let magnitude = x.abs();
    let (k, p, p_lower) = parts(2.0 * choose(22.0 < magnitude, 22.0, magnitude), 0.0);
    let c = power_of_two(-k);
    let (minus, minus_lower) = ordered_sum(1.0, -c);
    let (plus, plus_lower) = ordered_sum(1.0, c);
    let (numerator, n_lower) = ordered_sum(minus, p);
    let (denominator, d_lower) = ordered_sum(plus, p);
    let quotient = numerator / denominator;
    let (n_rest, d_rest) = (n_lower + (p_lower + minus_lower), d_lower + (p_lower + plus_lower));
    let correction = (n_rest - quotient * d_rest) / denominator;
    (quotient + correction).copysign(x)
}
