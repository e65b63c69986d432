//! Cosine and sine transforms at nodes from wall to wall, of several lines at once.
//!
//! ```text
//! cosines:  X_i = ½x_0 + ½(−1)^i x_N + Σ_{0<m<N} x_m cos(iπm/N)      i = 0 … N
//! sines:    X_i = Σ_{0<m<N} x_m sin(iπm/N)                           i = 1 … N − 1
//! ```
//! Each is N/2 times its own inverse. Sums and differences of the samples m and N − m split a transform of N intervals into
//! one of N/2 intervals, for even i, and one of N/2 cells, for odd i. All steps are sums or rotations, so rounding does not
//! grow with N.

use std::f64::consts::PI;

use crate::Precision;
use crate::transform::Line;
use crate::transform::cosine::CosinePlan;
use crate::walls::Parity;

/// Odd numbers of intervals up to this one are summed directly.
const DIRECT: usize = 15;

/// A planned transform of lines of N + 1 samples.
#[derive(Clone, Debug)]
pub(super) struct NodalPlan<T> {
    intervals: usize,
    /// Of N/2, N/4, … cells.
    halves: Vec<CosinePlan<T>>,
    /// cos(iπm/b) and sin(iπm/b) for the odd number b of intervals that is left, row i of b + 1 entries.
    tables: [Vec<T>; 2],
    last: usize,
}

impl<T: Precision> NodalPlan<T> {
    /// `None` when N is not 2^a b with b odd and at most 15, or N/2 cells cannot be transformed.
    pub(super) fn new(intervals: usize) -> Option<Self> {
        let mut halves = Vec::new();
        let mut last = intervals;
        while last.is_multiple_of(2) {
            last /= 2;
            halves.push(CosinePlan::new(last)?);
        }
        if DIRECT < last {
            return None;
        }
        let angle = |entry: usize| {
            let (i, m) = (entry / (last + 1), entry % (last + 1));
            ((i * m) % (2 * last)) as f64 * PI / last as f64
        };
        let entries = (last + 1) * (last + 1);
        let weighed = |entry: usize| if matches!(entry % (last + 1), m if m == 0 || m == last) { 0.5 } else { 1.0 };
        let cosines = (0..entries).map(|entry| T::lit(weighed(entry) * angle(entry).cos())).collect();
        let sines = (0..entries).map(|entry| T::lit(angle(entry).sin())).collect();
        Some(Self { intervals, halves, tables: [cosines, sines], last })
    }

    /// The lines of memory that a transform needs.
    pub(super) fn scratch(&self) -> usize {
        2 * self.intervals + 2 + self.halves.first().map_or(0, CosinePlan::scratch)
    }

    /// Both ways. Sines ignore the first and the last sample, and return zeros there.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn run(&self, parity: Parity, panel: &mut [Line<T>], scratch: &mut [Line<T>]) {
        let n = self.intervals;
        let panel = &mut panel[..=n];
        let (out, rest) = scratch.split_at_mut(n + 1);
        let (odd, rest) = rest.split_at_mut(n / 2);
        let zero = Line::splat(T::lit(0.0));
        let is_sine = parity == Parity::Sine;
        if is_sine {
            panel[0] = zero;
            panel[n] = zero;
        }
        let (mut intervals, mut step) = (n, 1);
        for half in &self.halves {
            let middle = intervals / 2;
            for m in 0..middle {
                let (x, y) = (panel[m], panel[intervals - m]);
                let (sum, difference) = (x + y, x - y);
                if is_sine {
                    panel[m] = difference;
                    odd[m] = sum;
                } else {
                    panel[m] = sum;
                    odd[m] = difference;
                }
            }
            let twice = panel[middle] + panel[middle];
            if is_sine {
                panel[middle] = zero;
                odd[0] = twice; // index N/2 of the sines
            } else {
                panel[middle] = twice;
            }
            half.to_samples(parity, odd, rest);
            for (j, &y) in odd[..middle].iter().enumerate() {
                out[step * (2 * j + 1)] = y;
            }
            intervals = middle;
            step *= 2;
        }
        let table = &self.tables[usize::from(is_sine)];
        for (i, row) in table.chunks_exact(self.last + 1).enumerate() {
            let mut sum = zero;
            for (&x, &c) in panel.iter().zip(row) {
                sum += x * Line::splat(c);
            }
            out[step * i] = sum;
        }
        panel.copy_from_slice(out);
        if is_sine {
            panel[0] = zero;
            panel[n] = zero;
        }
    }
}
