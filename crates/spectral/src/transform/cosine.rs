//! Cosine and sine transforms at the centres of cells, of several lines at once.
//!
//! ```text
//! to modes:    X_i = Σ_m x_m cos(iπ(m + ½)/n)                   i = 0 … n − 1
//! to samples:  y_m = ½X_0 + Σ_{0<i} X_i cos(iπ(m + ½)/n)        (n/2 times the inverse)
//! ```
//! Those of sines have index n in the place of index 0. They are the same transforms of the samples with alternating signs, with the slots i and
//! n − i exchanged.
//!
//! Even lengths: the even samples, then the odd ones backwards, are the real and imaginary parts of n/2 complex numbers
//! (Makhoul, IEEE Trans. ASSP 28 (1980) 27).

use std::f64::consts::PI;

use crate::Precision;
use crate::transform::Line;
use crate::transform::fft::FourierPlan;
use crate::walls::Parity;

/// Lengths up to this one are summed directly if the others cannot be had.
const DIRECT: usize = 15;

/// A planned transform of lines of n samples.
#[derive(Clone, Debug)]
pub(super) struct CosinePlan<T> {
    length: usize,
    method: Method<T>,
}

#[derive(Clone, Debug)]
enum Method<T> {
    /// cos(iπ(m + ½)/n), row i.
    Direct(Vec<T>),
    /// The transform of half the length; for each pair (k, n/2 − k) the factors e^{−2πik/n}, e^{−iπk/2n}/2 and
    /// e^{−iπ(n/2−k)/2n}/2.
    Half(FourierPlan<T>, Vec<[[T; 2]; 3]>),
}

impl<T: Precision> CosinePlan<T> {
    /// `None` when the length is neither short nor even with half a product of 2, 3 and 5.
    pub(super) fn new(length: usize) -> Option<Self> {
        if length % 2 == 1 || length < 8 {
            let angle = |i: usize, m: usize| ((2 * m + 1) * i % (4 * length)) as f64 * PI / (2 * length) as f64;
            let table = (0..length * length).map(|entry| T::lit(angle(entry / length, entry % length).cos()));
            return (length <= DIRECT).then(|| Self { length, method: Method::Direct(table.collect()) });
        }
        let half = length / 2;
        let plan = FourierPlan::new(half)?;
        let unit = |turns: f64, factor: f64| {
            let (sin, cos) = (2.0 * PI * turns).sin_cos();
            [T::lit(factor * cos), T::lit(-factor * sin)]
        };
        let n = length as f64;
        let factors = (0..=half / 2).map(|k| {
            let (near, far) = (k as f64, (half - k) as f64);
            [unit(near / n, 1.0), unit(near / (4.0 * n), 0.5), unit(far / (4.0 * n), 0.5)]
        });
        Some(Self { length, method: Method::Half(plan, factors.collect()) })
    }

    /// The lines of memory that a transform needs.
    pub(super) fn scratch(&self) -> usize {
        2 * self.length
    }

    /// From samples to modes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn to_modes(&self, parity: Parity, panel: &mut [Line<T>], scratch: &mut [Line<T>]) {
        let n = self.length;
        let panel = &mut panel[..n];
        let (first, second) = scratch[..2 * n].split_at_mut(n);
        let is_sine = parity == Parity::Sine;
        let sign = Line::splat(T::lit(if is_sine { -1.0 } else { 1.0 }));
        match &self.method {
            Method::Direct(table) => {
                first.copy_from_slice(panel);
                for (i, row) in table.chunks_exact(n).enumerate() {
                    let mut sum = Line::splat(T::lit(0.0));
                    for (m, (&x, &c)) in first.iter().zip(row).enumerate() {
                        sum += if m % 2 == 1 { sign * x } else { x } * Line::splat(c);
                    }
                    panel[slot(i, n, is_sine)] = sum;
                }
            }
            Method::Half(plan, factors) => {
                let half = n / 2;
                for m in 0..half {
                    first[m] = panel[2 * m];
                    first[n - 1 - m] = sign * panel[2 * m + 1];
                }
                let is_in_second = plan.run(first, second);
                let z = if is_in_second { &*second } else { &*first };
                // Z_0 = (even, odd) sums: X_0 and X_{n/2}.
                let (even, odd) = (z[0], z[1]);
                panel[0] = even + odd;
                panel[half] = (even - odd) * Line::splat(T::lit(std::f64::consts::FRAC_1_SQRT_2));
                for (k, &[t, near, far]) in factors.iter().enumerate().skip(1) {
                    let j = half - k;
                    let (a, b) = ([z[2 * k], z[2 * k + 1]], [z[2 * j], z[2 * j + 1]]);
                    // 2E = Z_k + conj Z_j, 2O = −i(Z_k − conj Z_j), then E ± tO.
                    let e = [a[0] + b[0], a[1] - b[1]];
                    let o = turned_by([a[1] + b[1], b[0] - a[0]], t);
                    let [x, y] = turned_by([e[0] + o[0], e[1] + o[1]], near);
                    panel[slot(k, n, is_sine)] = x;
                    panel[slot(n - k, n, is_sine)] = -y;
                    let [x, y] = turned_by([e[0] - o[0], o[1] - e[1]], far);
                    panel[slot(j, n, is_sine)] = x;
                    panel[slot(half + k, n, is_sine)] = -y;
                }
            }
        }
    }

    /// From modes to samples.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn to_samples(&self, parity: Parity, panel: &mut [Line<T>], scratch: &mut [Line<T>]) {
        let n = self.length;
        let panel = &mut panel[..n];
        let (first, second) = scratch[..2 * n].split_at_mut(n);
        let is_sine = parity == Parity::Sine;
        let sign = Line::splat(T::lit(if is_sine { -1.0 } else { 1.0 }));
        let a_half = Line::splat(T::lit(0.5));
        match &self.method {
            Method::Direct(table) => {
                first.copy_from_slice(panel);
                first[0] = a_half * first[0];
                panel.fill(Line::splat(T::lit(0.0)));
                for (i, row) in table.chunks_exact(n).enumerate() {
                    let x = first[slot(i, n, is_sine)];
                    for (y, &c) in panel.iter_mut().zip(row) {
                        *y += x * Line::splat(c);
                    }
                }
                for y in panel.iter_mut().skip(1).step_by(2) {
                    *y = sign * *y;
                }
            }
            Method::Half(plan, factors) => {
                let half = n / 2;
                // The forward transform with its parts exchanged is the inverse: the imaginary part is stored first.
                let (even, odd) =
                    (a_half * panel[0], panel[half] * Line::splat(T::lit(std::f64::consts::FRAC_1_SQRT_2)));
                first[1] = even + odd;
                first[0] = even - odd;
                for (k, &[t, near, far]) in factors.iter().enumerate().skip(1) {
                    let j = half - k;
                    let x = panel[slot(k, n, is_sine)];
                    let y = panel[slot(n - k, n, is_sine)];
                    let [p, q] = turned_back([x, -y], near);
                    let x = panel[slot(j, n, is_sine)];
                    let y = panel[slot(half + k, n, is_sine)];
                    let [r, s] = turned_back([x, -y], far);
                    // 2E = V_k + conj V_j, 2O = (V_k − conj V_j) conj t, Z_k = E + iO, Z_j = conj E + i conj O.
                    let e = [p + r, q - s];
                    let o = turned_back([p - r, q + s], t);
                    first[2 * k + 1] = e[0] - o[1];
                    first[2 * k] = e[1] + o[0];
                    first[2 * j + 1] = e[0] + o[1];
                    first[2 * j] = o[0] - e[1];
                }
                let is_in_second = plan.run(first, second);
                let z = if is_in_second { &*second } else { &*first };
                for m in 0..half {
                    // v_m is the real part of z_{m/2} for even m, stored second, and its imaginary part for odd m.
                    panel[2 * m] = z[m ^ 1];
                    panel[2 * m + 1] = sign * z[(n - 1 - m) ^ 1];
                }
            }
        }
    }
}

/// Where index i of the cosines is stored: sines have slots i and n − i exchanged.
#[cfg_attr(not(debug_assertions), inline(always))]
fn slot(i: usize, n: usize, is_sine: bool) -> usize {
    if is_sine && i != 0 { n - i } else { i }
}

/// a w.
#[cfg_attr(not(debug_assertions), inline(always))]
fn turned_by<T: Precision>(a: [Line<T>; 2], w: [T; 2]) -> [Line<T>; 2] {
    let [c, s] = w.map(Line::splat);
    [a[0] * c - a[1] * s, a[0] * s + a[1] * c]
}

/// a conj w.
#[cfg_attr(not(debug_assertions), inline(always))]
fn turned_back<T: Precision>(a: [Line<T>; 2], w: [T; 2]) -> [Line<T>; 2] {
    let [c, s] = w.map(Line::splat);
    [a[0] * c + a[1] * s, a[1] * c - a[0] * s]
}
