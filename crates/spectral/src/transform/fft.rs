//! Complex Fourier transforms of several lines at once: Stockham's algorithm with radices 4, 2, 3 and 5.
//!
//! ```text
//! Z_k = Σ_j z_j e^{−2πijk/h},   j, k = 0 … h − 1
//! ```
//! A line of a panel is one lane; real and imaginary parts alternate. Nothing is shuffled between lanes, and no order is
//! reversed.

use std::f64::consts::PI;

use crate::Precision;
use crate::transform::Line;

/// One pass: h = radix · rest of the lines are combined; `stride` transforms run side by side.
#[derive(Clone, Debug)]
struct Pass {
    radix: usize,
    rest: usize,
    stride: usize,
    /// Where its factors begin: radix − 1 for each index below `rest`.
    factors: usize,
}

/// A planned transform of h complex numbers.
#[derive(Clone, Debug)]
pub(super) struct FourierPlan<T> {
    passes: Vec<Pass>,
    factors: Vec<[T; 2]>,
}

impl<T: Precision> FourierPlan<T> {
    /// `None` when the length has a prime factor above 5.
    pub(super) fn new(length: usize) -> Option<Self> {
        let (mut rest, mut stride) = (length, 1);
        let (mut passes, mut factors) = (Vec::new(), Vec::new());
        while rest != 1 {
            let radix = [4, 2, 3, 5].into_iter().find(|radix| rest % radix == 0)?;
            let whole = rest;
            rest /= radix;
            passes.push(Pass { radix, rest, stride, factors: factors.len() });
            for p in 0..rest {
                factors.extend((1..radix).map(|k| {
                    let (sin, cos) = (2.0 * PI * ((p * k) % whole) as f64 / whole as f64).sin_cos();
                    [T::lit(cos), T::lit(-sin)]
                }));
            }
            stride *= radix;
        }
        Some(Self { passes, factors })
    }

    /// Transforms the numbers in `first`, with `second` as memory. True when the result is in `second`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn run(&self, first: &mut [Line<T>], second: &mut [Line<T>]) -> bool {
        let mut is_in_second = false;
        for pass in &self.passes {
            if is_in_second {
                self.combine(pass, second, first);
            } else {
                self.combine(pass, first, second);
            }
            is_in_second = !is_in_second;
        }
        is_in_second
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn combine(&self, pass: &Pass, from: &[Line<T>], into: &mut [Line<T>]) {
        let factors = &self.factors[pass.factors..];
        match pass.radix {
            4 => radix_4(pass, factors, from, into),
            2 => radix_2(pass, factors, from, into),
            3 => radix_3(pass, factors, from, into),
            _ => radix_5(pass, factors, from, into),
        }
    }
}

/// A complex number in each lane.
type Pair<T> = [Line<T>; 2];

#[cfg_attr(not(debug_assertions), inline(always))]
fn load<T: Precision>(from: &[Line<T>], index: usize) -> Pair<T> {
    let pair = &from[2 * index..2 * index + 2];
    [pair[0], pair[1]]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn store<T: Precision>(into: &mut [Line<T>], index: usize, [re, im]: Pair<T>) {
    let pair = &mut into[2 * index..2 * index + 2];
    pair[0] = re;
    pair[1] = im;
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn add<T: Precision>(a: Pair<T>, b: Pair<T>) -> Pair<T> {
    [a[0] + b[0], a[1] + b[1]]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn sub<T: Precision>(a: Pair<T>, b: Pair<T>) -> Pair<T> {
    [a[0] - b[0], a[1] - b[1]]
}

/// −i a.
#[cfg_attr(not(debug_assertions), inline(always))]
fn turned<T: Precision>([re, im]: Pair<T>) -> Pair<T> {
    [im, -re]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn scaled<T: Precision>(a: Pair<T>, factor: f64) -> Pair<T> {
    let factor = Line::splat(T::lit(factor));
    [a[0] * factor, a[1] * factor]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn times<T: Precision>(a: Pair<T>, factor: [T; 2]) -> Pair<T> {
    let [c, s] = factor.map(Line::splat);
    [a[0] * c - a[1] * s, a[0] * s + a[1] * c]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn radix_2<T: Precision>(pass: &Pass, factors: &[[T; 2]], from: &[Line<T>], into: &mut [Line<T>]) {
    let (m, s) = (pass.rest, pass.stride);
    for p in 0..m {
        for q in 0..s {
            let (a, b) = (load(from, q + s * p), load(from, q + s * (p + m)));
            let (sum, difference) = (add(a, b), sub(a, b));
            store(into, q + s * 2 * p, sum);
            store(into, q + s * (2 * p + 1), if p == 0 { difference } else { times(difference, factors[p]) });
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn radix_3<T: Precision>(pass: &Pass, factors: &[[T; 2]], from: &[Line<T>], into: &mut [Line<T>]) {
    let (m, s) = (pass.rest, pass.stride);
    for p in 0..m {
        for q in 0..s {
            let a = load(from, q + s * p);
            let (b, c) = (load(from, q + s * (p + m)), load(from, q + s * (p + 2 * m)));
            let sum = add(b, c);
            let across = turned(scaled(sub(b, c), 0.866_025_403_784_438_6));
            let middle = sub(a, scaled(sum, 0.5));
            store(into, q + s * 3 * p, add(a, sum));
            store(into, q + s * (3 * p + 1), times(add(middle, across), factors[2 * p]));
            store(into, q + s * (3 * p + 2), times(sub(middle, across), factors[2 * p + 1]));
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn radix_4<T: Precision>(pass: &Pass, factors: &[[T; 2]], from: &[Line<T>], into: &mut [Line<T>]) {
    let (m, s) = (pass.rest, pass.stride);
    for p in 0..m {
        let w = &factors[3 * p..3 * p + 3];
        for q in 0..s {
            let (a, b) = (load(from, q + s * p), load(from, q + s * (p + m)));
            let (c, d) = (load(from, q + s * (p + 2 * m)), load(from, q + s * (p + 3 * m)));
            let (even, odd) = (add(a, c), add(b, d));
            let (left, right) = (sub(a, c), turned(sub(b, d)));
            let results = [sub(even, odd), add(left, right), sub(left, right)];
            store(into, q + s * 4 * p, add(even, odd));
            if p == 0 {
                store(into, q + s, results[1]);
                store(into, q + s * 2, results[0]);
                store(into, q + s * 3, results[2]);
            } else {
                store(into, q + s * (4 * p + 1), times(results[1], w[0]));
                store(into, q + s * (4 * p + 2), times(results[0], w[1]));
                store(into, q + s * (4 * p + 3), times(results[2], w[2]));
            }
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn radix_5<T: Precision>(pass: &Pass, factors: &[[T; 2]], from: &[Line<T>], into: &mut [Line<T>]) {
    // cos and sin of 2π/5 and 4π/5.
    const C: [f64; 2] = [0.309_016_994_374_947_45, -0.809_016_994_374_947_5];
    const S: [f64; 2] = [0.951_056_516_295_153_5, 0.587_785_252_292_473_1];
    let (m, s) = (pass.rest, pass.stride);
    for p in 0..m {
        for q in 0..s {
            let a = load(from, q + s * p);
            let (b, e) = (load(from, q + s * (p + m)), load(from, q + s * (p + 4 * m)));
            let (c, d) = (load(from, q + s * (p + 2 * m)), load(from, q + s * (p + 3 * m)));
            let (outer, inner) = (add(b, e), add(c, d));
            let (far, near) = (sub(b, e), sub(c, d));
            let first = add(a, add(scaled(outer, C[0]), scaled(inner, C[1])));
            let second = add(a, add(scaled(outer, C[1]), scaled(inner, C[0])));
            let across_first = turned(add(scaled(far, S[0]), scaled(near, S[1])));
            let across_second = turned(sub(scaled(far, S[1]), scaled(near, S[0])));
            store(into, q + s * 5 * p, add(a, add(outer, inner)));
            store(into, q + s * (5 * p + 1), times(add(first, across_first), factors[4 * p]));
            store(into, q + s * (5 * p + 2), times(add(second, across_second), factors[4 * p + 1]));
            store(into, q + s * (5 * p + 3), times(sub(second, across_second), factors[4 * p + 2]));
            store(into, q + s * (5 * p + 4), times(sub(first, across_first), factors[4 * p + 3]));
        }
    }
}
