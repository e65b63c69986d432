//! Integrals over a history with an error bound.

use piola_numerics::gauss_kronrod::{GAUSS, KRONROD, NODES};

use crate::Integral;

impl<T> Integral<T> {
    /// With another value, of which this is a part, and which is at most `size`: its rounding adds to the bound.
    pub(super) fn within<S>(&self, value: S, size: f64) -> Integral<S> {
        Integral { value, bound: self.bound + 16.0 * f64::EPSILON * size, evaluations: self.evaluations }
    }
}

/// ln s below the end from where a history is integrated: what is older counts e⁻⁴⁰ times, as the integrand vanishes at least
/// like s ds at s → 0.
const DEPTH: f64 = 40.0;
/// The most intervals.
const MOST: usize = 512;

/// An interval of ln s with its integral and what two rules differ by.
#[derive(Clone, Copy)]
struct Piece<const N: usize> {
    low: f64,
    high: f64,
    value: [f64; N],
    error: f64,
}

/// ∫ f(s) ds from 0 to `end`, for f that vanishes at s = 0 at least as s does: adaptive in ln s.
pub(super) fn integrate<const N: usize>(f: impl FnMut(f64) -> [f64; N], end: f64) -> Integral<[f64; N]> {
    let top = end.ln();
    let edges: [f64; 9] = core::array::from_fn(|k| top - DEPTH * (8 - k) as f64 / 8.0);
    adaptive(f, &edges, end)
}

/// ∫ f(s) ds from `start` to `end`, 0 < start: adaptive in ln s.
pub(super) fn integrate_between<const N: usize>(
    f: impl FnMut(f64) -> [f64; N],
    start: f64,
    end: f64,
) -> Integral<[f64; N]> {
    adaptive(f, &[start.ln(), end.ln()], end)
}

/// Halves the interval between `edges` of ln s whose error is the largest, until the sum of the errors is small. Allocates
/// nothing.
fn adaptive<const N: usize>(mut f: impl FnMut(f64) -> [f64; N], edges: &[f64], end: f64) -> Integral<[f64; N]> {
    let mut evaluations = 0;
    let mut rule = |low: f64, high: f64| {
        let (centre, half) = (f64::midpoint(low, high), (high - low) / 2.0);
        let (mut fine, mut coarse) = ([0.0; N], [0.0; N]);
        let mut add = |offset: f64, kronrod: f64, gauss: f64| {
            let s = (centre + offset).exp().min(end);
            for (i, value) in f(s).into_iter().enumerate() {
                fine[i] += kronrod * half * value * s;
                coarse[i] += gauss * half * value * s;
            }
            evaluations += 1;
        };
        for k in 0..8 {
            let gauss = if k % 2 == 1 { GAUSS[k / 2] } else { 0.0 };
            add(half * NODES[k], KRONROD[k], gauss);
            if k < 7 {
                add(-half * NODES[k], KRONROD[k], gauss);
            }
        }
        let error = (0..N).map(|i| (fine[i] - coarse[i]).abs()).fold(0.0, f64::max);
        Piece { low, high, value: fine, error }
    };
    let mut pieces = [Piece { low: 0.0, high: 0.0, value: [0.0; N], error: 0.0 }; MOST];
    let mut count = 0;
    for pair in edges.windows(2) {
        pieces[count] = rule(pair[0], pair[1]);
        count += 1;
    }
    loop {
        let pieces_now = &pieces[..count];
        let value: [f64; N] = core::array::from_fn(|i| pieces_now.iter().map(|piece| piece.value[i]).sum());
        let bound: f64 = pieces_now.iter().map(|piece| piece.error).sum();
        let size = value.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let worst = (0..count).max_by(|&a, &b| pieces[a].error.total_cmp(&pieces[b].error)).unwrap_or(0);
        if bound <= 1e-13 * size || MOST <= count || !bound.is_finite() {
            // The rounding of the sum, the depth, and what the rules do not agree upon.
            return Integral { value, bound: bound + 32.0 * f64::EPSILON * size, evaluations };
        }
        let Piece { low, high, .. } = pieces[worst];
        let centre = f64::midpoint(low, high);
        pieces[worst] = rule(low, centre);
        pieces[count] = rule(centre, high);
        count += 1;
    }
}
