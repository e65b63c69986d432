//! sin, cos and tan.
//!
//! ```text
//! x = n π/2 + r,  |r| ≤ π/4        sin r = r + r z S(z),   cos r = 1 − z/2 + z² C(z),   z = r²
//! ```
//! π/2 is held in three parts of 29 bits and a fourth of 53 (140 bits together), so that the products with
//! |n| ≤ 2²⁴ are exact and r, a sum of two doubles, keeps full relative accuracy beside every multiple of
//! π/2. Larger arguments go to the standard library ([`LIMIT`]).

use super::{ROUND, choose, difference, ordered_sum, polynomial_5};

/// The largest |x| that the reduction is made for: 2²⁴ π/2 = 26 353 589.4….
pub(crate) const LIMIT: f64 = 26_353_589.0;

/// π/2 in parts.
pub(super) const HALF_PI: [f64; 4] =
    [1.570_796_325_802_803, 9.920_935_774_287_987e-10, 2.251_741_770_634_657_8e-18, 3.521_559_865_183_2e-27];

/// (sin r/r − 1)/z on |r| ≤ π/4: near-minimax of degree 5, error 2⁻⁵⁵ relative to r after multiplication by z.
const SINE: [f64; 6] = [
    -0.166_666_666_666_666_66,
    0.008_333_333_333_330_946,
    -0.000_198_412_698_367_549_7,
    2.755_731_610_068_303e-6,
    -2.505_113_145_542_794_5e-8,
    1.591_810_123_027_412e-10,
];

/// (cos r − 1 + z/2)/z² on |r| ≤ π/4: near-minimax of degree 5, error 2⁻⁶⁰ after multiplication by z².
const COSINE: [f64; 6] = [
    0.041_666_666_666_666_664,
    -0.001_388_888_888_888_739_5,
    2.480_158_729_876_343_3e-5,
    -2.755_731_727_056_032_6e-7,
    2.087_614_602_468_974_7e-9,
    -1.138_261_486_855_632_5e-11,
];

/// A sum of two doubles, the second a rounding error of the first.
type Pair = (f64, f64);

/// n (in the lowest bits), sin r and cos r.
#[cfg_attr(not(debug_assertions), inline(always))]
fn parts(x: f64) -> (u64, Pair, Pair) {
    let shifted = x * core::f64::consts::FRAC_2_PI + ROUND;
    let n = shifted - ROUND;
    let (a, a_lower) = difference(x - n * HALF_PI[0], n * HALF_PI[1]);
    let (b, b_lower) = difference(a, n * HALF_PI[2]);
    let (r, r_lower) = ordered_sum(b, (a_lower + b_lower) - n * HALF_PI[3]);
    let z = r * r;
    let sine = ordered_sum(r, r * z * polynomial_5(z, SINE) + r_lower * (1.0 - 0.5 * z));
    let (one, one_lower) = ordered_sum(1.0, -0.5 * z);
    let cosine = ordered_sum(one, one_lower + (z * z * polynomial_5(z, COSINE) - r * r_lower));
    (shifted.to_bits(), sine, cosine)
}

/// x with its sign changed when bit `bit` of n is set.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn flip(x: f64, n: u64, bit: u32) -> f64 {
    f64::from_bits(x.to_bits() ^ ((n >> bit) << 63))
}

/// (sin x, cos x) for |x| ≤ `LIMIT`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    let (n, (sine, _), (cosine, _)) = parts(x);
    let odd = n & 1 == 1;
    let (s, c) = (choose(odd, cosine, sine), choose(odd, sine, cosine));
    // sin changes sign with bit 1 of n, cos with bit 1 of n + 1.
    (choose(x == 0.0, x, flip(s, n, 1)), flip(c, n.wrapping_add(1), 1))
}

/// tan x for |x| ≤ `LIMIT`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn tan(x: f64) -> f64 {
    let (n, sine, cosine) = parts(x);
    let odd = n & 1 == 1;
    let (above, above_lower) = (choose(odd, cosine.0, sine.0), choose(odd, cosine.1, sine.1));
    let (below, below_lower) = (choose(odd, sine.0, cosine.0), choose(odd, sine.1, cosine.1));
    let quotient = above / below;
    let tangent = quotient + (above_lower - quotient * below_lower) / below;
    choose(x == 0.0, x, flip(tangent, n, 0))
}
