//! Branch-free elementary functions, written so that the compiler runs several lanes at once.
//!
//! Each function takes and returns one `f64` and contains no branch, no table, no call and no conversion
//! between floats and integers: only sums, products, quotients, roots, selections and operations on bits.
//! Mapped over the lanes of [`Lanes`](crate::Lanes) it becomes a row of vector instructions, whatever the
//! width. Errors are at most 2 ulp; each file states the method and each function what was measured.
//!
//! No fused multiply-add is used: it would round differently from a separate product and sum, and results
//! would depend on the instruction set. Where a product is needed to more than a double, factors are cut
//! ([`upper`]) so that it is exact.
//!
//! Coefficients called *near-minimax* are Chebyshev interpolations computed with 60 digits, converted to
//! powers and rounded to doubles; stated errors include that rounding.

mod exponential;
mod inverse_trigonometric;
mod logarithm;
pub(crate) mod power;
pub(crate) mod single;
pub(crate) mod trigonometric;

/// The functions for lanes of `f64`.
pub(crate) mod double {
    pub(crate) use super::exponential::{cosh, exp, exp_m1, sinh, tanh};
    pub(crate) use super::inverse_trigonometric::{acos, asin, atan, atan2};
    pub(crate) use super::logarithm::{ln, ln_1p, ln_1p_given};
    pub(crate) use super::power::{cbrt, powf, recip_cbrt};
    pub(crate) use super::trigonometric::{sin_cos, tan};
}

/// 1.5 · 2⁵²: adding it to |x| < 2⁵¹ rounds x to a whole number, held in the lowest bits of the sum.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// The bits of a double's fraction.
const FRACTION: u64 = 0x000f_ffff_ffff_ffff;
/// ln 2 to 32 bits, so that its product with a whole number below 2²¹ is exact.
const LN_2_UPPER: f64 = 0.693_147_180_369_123_8;
/// ln 2 − `LN_2_UPPER`.
const LN_2_LOWER: f64 = 1.908_214_929_270_587_7e-10;

/// `if_true` or `if_false`, both already computed: a selection, never a jump.
#[cfg_attr(not(debug_assertions), inline(always))]
fn choose(condition: bool, if_true: f64, if_false: f64) -> f64 {
    let mask = 0_u64.wrapping_sub(u64::from(condition));
    f64::from_bits((mask & if_true.to_bits()) | (!mask & if_false.to_bits()))
}

/// Whether both hold: computed without a jump, which `&&` may become.
#[cfg_attr(not(debug_assertions), inline(always))]
fn both(a: bool, b: bool) -> bool {
    a & b
}

/// Whether one holds: computed without a jump, which `||` may become.
#[cfg_attr(not(debug_assertions), inline(always))]
fn either(a: bool, b: bool) -> bool {
    a | b
}

/// x cut to its leading 26 bits: the product of two such numbers is exact.
#[cfg_attr(not(debug_assertions), inline(always))]
fn upper(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0xffff_ffff_f800_0000)
}

/// 2ᵏ for a whole number −1022 ≤ k ≤ 1023.
#[cfg_attr(not(debug_assertions), inline(always))]
fn power_of_two(k: f64) -> f64 {
    f64::from_bits((k + ROUND).to_bits().wrapping_add(1023) << 52)
}

/// The nearest whole number, for |x| < 2⁵¹.
#[cfg_attr(not(debug_assertions), inline(always))]
fn nearest(x: f64) -> f64 {
    (x + ROUND) - ROUND
}

/// a + b and its rounding error, for |b| ≤ |a| or a = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
fn ordered_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, (a - sum) + b)
}

/// a − b and its rounding error.
#[cfg_attr(not(debug_assertions), inline(always))]
fn difference(a: f64, b: f64) -> (f64, f64) {
    let d = a - b;
    let part = d - a;
    (d, (a - (d - part)) - (b + part))
}

/// c₀ + c₁ x + c₂ x² + c₃ x³, given x².
#[cfg_attr(not(debug_assertions), inline(always))]
fn cubic(x: f64, x2: f64, c: [f64; 4]) -> f64 {
    (c[0] + c[1] * x) + (c[2] + c[3] * x) * x2
}

// Polynomials by Estrin's scheme: a chain of operations that grows with the logarithm of the degree. Each
// length has its own function without loops, because a loop here would stop the loop over lanes from
// becoming vector instructions.

/// c₀ + … + c₅ x⁵.
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial_5(x: f64, c: [f64; 6]) -> f64 {
    let x2 = x * x;
    cubic(x, x2, [c[0], c[1], c[2], c[3]]) + (c[4] + c[5] * x) * (x2 * x2)
}

/// c₀ + … + c₆ x⁶.
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial_6(x: f64, c: [f64; 7]) -> f64 {
    let x2 = x * x;
    cubic(x, x2, [c[0], c[1], c[2], c[3]]) + ((c[4] + c[5] * x) + c[6] * x2) * (x2 * x2)
}

/// c₀ + … + c₉ x⁹.
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial_9(x: f64, c: [f64; 10]) -> f64 {
    let x2 = x * x;
    let x4 = x2 * x2;
    let middle = cubic(x, x2, [c[4], c[5], c[6], c[7]]);
    cubic(x, x2, [c[0], c[1], c[2], c[3]]) + (middle + (c[8] + c[9] * x) * x4) * x4
}

/// c₀ + … + c₁₀ x¹⁰.
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial_10(x: f64, c: [f64; 11]) -> f64 {
    let x2 = x * x;
    let x4 = x2 * x2;
    let middle = cubic(x, x2, [c[4], c[5], c[6], c[7]]);
    let high = (c[8] + c[9] * x) + c[10] * x2;
    cubic(x, x2, [c[0], c[1], c[2], c[3]]) + (middle + high * x4) * x4
}

/// c₀ + … + c₁₂ x¹².
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial_12(x: f64, c: [f64; 13]) -> f64 {
    let x2 = x * x;
    let x4 = x2 * x2;
    let middle = cubic(x, x2, [c[4], c[5], c[6], c[7]]);
    let high = cubic(x, x2, [c[8], c[9], c[10], c[11]]) + c[12] * x4;
    cubic(x, x2, [c[0], c[1], c[2], c[3]]) + (middle + high * x4) * x4
}
