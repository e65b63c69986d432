//! The Langevin function and its inverse.

use piola_numerics::internal::outlined;
use piola_numerics::{Mask, Real};

/// Arguments up to this size take the continued fraction.
const SMALL: f64 = 2.0;

/// Levels of the continued fraction: at |β| = 2 the rest is below 1e-18.
const LEVELS: u8 = 13;

/// ℒ(β) = coth β − 1/β, the mean projection of a freely jointed link under the tension β.
///
/// ```text
/// ℒ(β) = β/(3 + β²/(5 + β²/(7 + …)))
/// ```
///
/// # Accuracy
/// 6 ulp everywhere: the fraction has no differences, and beyond β = 2 the closed form has no cancellation.
///
/// # Example
/// ```
/// use piola_solids::isochoric::langevin;
/// assert!((langevin(3e-20) / 1e-20 - 1.0_f64).abs() < 1e-15); // β/3
/// assert!((langevin(1.0) - 0.313_035_285_499_331_3_f64).abs() < 1e-15); // coth 1 − 1
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn langevin<T: Real>(beta: T) -> T {
    beta * ratio_and_slope(beta).0
}

/// ℒ(β)/β and ℒ′(β).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn ratio_and_slope<T: Real>(beta: T) -> (T, T) {
    // In lanes it is inlined, for the instructions of its caller.
    if const { T::ORDER == 0 || 1 < T::LANES } { inlined(beta) } else { outlined(|| inlined(beta)) }
}

/// With derivatives the fraction is long: outlined, it is compiled once for each scalar, not at each of the dozen calls of a law.
#[cfg_attr(not(debug_assertions), inline(always))]
fn inlined<T: Real>(beta: T) -> (T, T) {
    let (one, two) = (T::one(), T::lit(2.0));
    let small = beta.abs().at_most(T::lit(SMALL));
    let mut far = (one, one);
    if !small.all() {
        // coth β = 1 + 2/(e^{2β} − 1), from |β|; both results are even.
        let size = beta.abs();
        // Beyond 80 nothing is left of the excess; its derivatives stay finite.
        let growth = (two * size).min(T::lit(80.0)).exp_m1();
        let reciprocal = size.recip();
        let excess = two / growth;
        let ratio = ((one + excess) - reciprocal) * reciprocal;
        // 1/sinh² β = coth² β − 1 = e (e + 2) with e = coth β − 1.
        far = (ratio, reciprocal * reciprocal - excess * (excess + two));
    }
    if !small.any() {
        return far;
    }
    let square = beta * beta;
    // Numerator and denominator of the fraction, every term positive: one division in all.
    let (mut before, mut now) = ((T::one(), T::zero()), (T::zero(), T::one()));
    let mut partial = T::one();
    for level in 1..=LEVELS {
        let odd = T::lit(f64::from(2 * level + 1));
        let next = (odd * now.0 + partial * before.0, odd * now.1 + partial * before.1);
        (before, now) = (now, next);
        partial = square;
    }
    let ratio = now.0 / now.1;
    // Riccati's equation of ℒ.
    let near = (ratio, one - two * ratio - square * (ratio * ratio));
    (T::select(small, near.0, far.0), T::select(small, near.1, far.1))
}

/// β (1 − λ²)/λ as a polynomial in λ²: near-minimax of degree 7, relative error 9e-5.
const START: [f64; 8] = [
    2.999_865_21,
    -1.182_886_24,
    -0.447_482_126,
    2.599_936_06,
    -8.561_459_18,
    14.829_663_5,
    -11.546_812_7,
    3.309_237_89,
];

/// β with ℒ(β) = λ, for |λ| < 1: a polynomial over 1 − λ² (9e-5) and two steps of Newton's iteration; three where the
/// scalar carries derivatives, which they make exact too.
///
/// # Accuracy
/// 6 ulp × the condition number λ/(β ℒ′(β)), that is 6 ulp for small λ and 6 ulp/(1 − λ) near the limit.
///
/// # Errors
/// NaN where 1 ≤ |λ|, derivatives included.
///
/// # Example
/// ```
/// use piola_solids::isochoric::inverse_langevin;
/// assert_eq!(inverse_langevin(1e-20), 3e-20);
/// let tension: f64 = inverse_langevin(0.999); // ℒ(β) = 1 − 1/β up to exp(−2β)
/// assert!((tension - 1000.0).abs() < 1e-9);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn inverse_langevin<T: Real>(lambda: T) -> T {
    let square = lambda * lambda;
    let mut start = T::lit(START[7]);
    let mut k = 7;
    while 0 < k {
        k -= 1;
        start = start * square + T::lit(START[k]);
    }
    let mut beta = lambda * start / ((T::one() - lambda) * (T::one() + lambda));
    for _ in 0..if T::ORDER == 0 { 2 } else { 3 } {
        let (ratio, slope) = ratio_and_slope(beta);
        beta += (lambda - beta * ratio) / slope;
    }
    // A product: the derivatives beyond the limit are NaN too.
    beta * T::select(lambda.abs().less_than(T::one()), T::one(), T::lit(f64::NAN))
}
