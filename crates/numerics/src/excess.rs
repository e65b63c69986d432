//! Differences of elementary functions that would cancel if they were formed.

use crate::outlined::outlined;
use crate::{Mask, Real};

/// x − ln(1 + x), of second order in x, without cancellation.
///
/// # Accuracy
/// 4 ulp for |x| ≤ ½; beyond, the difference itself, 8 ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn excess_over_logarithm<T: Real>(x: T) -> T {
    let small = x.abs().at_most(T::lit(0.5));
    if small.all() {
        return small_excess(x);
    }
    let plain = x - x.ln_1p();
    if small.any() { T::select(small, small_excess(x), plain) } else { plain }
}

/// x − ln(1 + x) of |x| ≤ ½.
#[cfg_attr(not(debug_assertions), inline(always))]
fn small_excess<T: Real>(x: T) -> T {
    // Of numbers with derivatives the series is long: it is compiled once for each. In lanes it is inlined, for the instructions of its caller.
    if const { T::ORDER == 0 || 1 < T::LANES } { series(x) } else { outlined(|| series(x)) }
}

/// ```text
/// s = x/(2 + x):   x − ln(1 + x) = x s − 2 (s³/3 + s⁵/5 + …)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
fn series<T: Real>(x: T) -> T {
    let s = x / (T::lit(2.0) + x);
    let q = s * s;
    let q2 = q * q;
    let q4 = q2 * q2;
    // 1/3 + q/5 + … + q¹⁵/33: at |s| ≤ 1/3 sixteen terms, by Estrin's scheme so that few wait for one another.
    let a = (T::lit(1.0 / 3.0) + T::lit(1.0 / 5.0) * q) + (T::lit(1.0 / 7.0) + T::lit(1.0 / 9.0) * q) * q2;
    let b = (T::lit(1.0 / 11.0) + T::lit(1.0 / 13.0) * q) + (T::lit(1.0 / 15.0) + T::lit(1.0 / 17.0) * q) * q2;
    let c = (T::lit(1.0 / 19.0) + T::lit(1.0 / 21.0) * q) + (T::lit(1.0 / 23.0) + T::lit(1.0 / 25.0) * q) * q2;
    let d = (T::lit(1.0 / 27.0) + T::lit(1.0 / 29.0) * q) + (T::lit(1.0 / 31.0) + T::lit(1.0 / 33.0) * q) * q2;
    let sum = (a + b * q4) + (c + d * q4) * (q4 * q4);
    x * s - T::lit(2.0) * (s * q * sum)
}

/// x − ln(1 + x), of second order in x, the logarithm given: near x = −1 it knows more than x does.
///
/// # Accuracy
/// That of [`excess_over_logarithm`]; for x → −1 and its derivatives that of the logarithm.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn excess_over_given<T: Real>(x: T, logarithm: T) -> T {
    let small = x.abs().at_most(T::lit(0.5));
    if small.all() {
        return small_excess(x);
    }
    let plain = x - logarithm;
    if small.any() { T::select(small, small_excess(x), plain) } else { plain }
}

/// J − 1 − ln J of J − 1 and J, of second order in J − 1, without cancellation; the logarithm is formed only where J is far
/// from 1.
///
/// # Accuracy
/// As [`excess_over_given`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn volume_excess<T: Real>(change: T, jacobian: T) -> T {
    let small = change.abs().at_most(T::lit(0.5));
    if small.all() {
        return small_excess(change);
    }
    let plain = change - jacobian.ln();
    if small.any() { T::select(small, small_excess(change), plain) } else { plain }
}

/// eˣ − 1 − x, of second order in x, without cancellation.
///
/// # Accuracy
/// 4 ulp for |x| ≤ ½; beyond, the difference itself, 8 ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn excess_of_exponential<T: Real>(x: T) -> T {
    let small = x.abs().at_most(T::lit(0.5));
    let plain = x.exp_m1() - x;
    if !small.any() {
        return plain;
    }
    let mut sum = T::one();
    for k in (3..24).rev() {
        sum = T::one() + x * sum * T::lit(1.0 / f64::from(k));
    }
    T::select(small, T::lit(0.5) * (x * x) * sum, plain)
}
