//! ln x and ln(1 + x).
//!
//! ```text
//! x = 2ᵏ m,  √½ ≤ m < √2,  f = m − 1,  s = f/(2 + f)
//! ln x = k ln 2 + ln m,    ln m = 2s + s z P(z) = f − (½f² − s (½f² + z P(z))),   z = s²
//! ```

use super::{FRACTION, LN_2_LOWER, LN_2_UPPER, choose, polynomial_6};

/// (2 artanh(s)/s − 2)/s² as a function of z = s² on m ∈ [√½, √2]: near-minimax of degree 6, error
/// 2⁻⁵⁶ after multiplication by z.
const LOGARITHM: [f64; 7] = [
    0.666_666_666_666_667,
    0.399_999_999_998_993_8,
    0.285_714_286_260_310_65,
    0.222_222_111_257_228_1,
    0.181_828_897_861_910_42,
    0.153_316_996_335_438_58,
    0.146_167_211_798_618_16,
];

/// The bits of √½ and of 1.
const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
const ONE: u64 = 0x3ff0_0000_0000_0000;

/// (k, m) of 0 < x, subnormals included.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn split(x: f64) -> (f64, f64) {
    let small = x < f64::MIN_POSITIVE;
    let bits = choose(small, x * 18_014_398_509_481_984.0, x).to_bits().wrapping_add(ONE - SQRT_HALF);
    let m = f64::from_bits((bits & FRACTION) + SQRT_HALF);
    // The exponent placed in the fraction of 2⁵² is a float without a conversion.
    let exponent = f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - 4_503_599_627_370_496.0;
    (exponent - choose(small, 1077.0, 1023.0), m)
}

/// (k, m) of a normal 0 < x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn split_normal(x: f64) -> (f64, f64) {
    let bits = x.to_bits().wrapping_add(ONE - SQRT_HALF);
    let m = f64::from_bits((bits & FRACTION) + SQRT_HALF);
    (f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 1023.0), m)
}

/// ln u + c, 0 < u < ∞, |c| ≪ 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn ln_of_positive(u: f64, c: f64) -> f64 {
    let (k, m) = split(u);
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let half_square = 0.5 * f * f;
    let rest = z * polynomial_6(z, LOGARITHM);
    k * LN_2_UPPER - ((half_square - (s * (half_square + rest) + (k * LN_2_LOWER + c))) - f)
}

/// ln x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ln(x: f64) -> f64 {
    let finite = choose(x < f64::INFINITY, ln_of_positive(x, 0.0), x);
    choose(0.0 < x, finite, choose(x == 0.0, f64::NEG_INFINITY, f64::NAN))
}

/// ln(1 + x) of x and 1 + x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ln_1p_given(x: f64, sum: f64) -> f64 {
    // As below where |x| ≤ ½; ln of the sum elsewhere.
    let near = x.abs() <= 0.5;
    let u = choose(near, 1.0 + x, sum);
    let part = u - 1.0;
    let e = choose(near, (1.0 - (u - part)) + (x - part), 0.0);
    let finite = choose(u < f64::INFINITY, ln_of_positive(u, e / u), u);
    choose(x == 0.0, x, choose(0.0 < u, finite, choose(u == 0.0, f64::NEG_INFINITY, f64::NAN)))
}

/// ln(1 + x).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ln_1p(x: f64) -> f64 {
    // u + e = 1 + x exactly; ln(1 + x) = ln u + e/u.
    let u = 1.0 + x;
    let part = u - 1.0;
    let e = (1.0 - (u - part)) + (x - part);
    let finite = choose(x < f64::INFINITY, ln_of_positive(u, e / u), x);
    let inside = choose(x == 0.0, x, finite);
    choose(-1.0 < x, inside, choose(u == 0.0, f64::NEG_INFINITY, f64::NAN))
}
