//! Integrals over a history with an error bound.

use core::convert::Infallible;

use piola_numerics::quadrature::{self, GaussKronrod, LargestDifference, Panel};

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

/// ∫ f(s) ds from 0 to `end`, for f that vanishes at s = 0 at least as s does: adaptive in ln s.
pub(super) fn integrate<const N: usize>(f: impl FnMut(f64) -> [f64; N], end: f64) -> Integral<[f64; N]> {
    let edge = |k: u32| end.ln() - DEPTH * f64::from(8 - k) / 8.0;
    adaptive(f, (0..8).map(|k| (edge(k), edge(k + 1))), end)
}

/// ∫ f(s) ds from `start` to `end`, 0 < start: adaptive in ln s.
pub(super) fn integrate_between<const N: usize>(
    f: impl FnMut(f64) -> [f64; N],
    start: f64,
    end: f64,
) -> Integral<[f64; N]> {
    adaptive(f, [(start.ln(), end.ln())], end)
}

/// Over intervals of ln s, until the sum of the largest errors of any component is small. Allocates nothing.
fn adaptive<const N: usize>(
    mut f: impl FnMut(f64) -> [f64; N],
    intervals: impl IntoIterator<Item = (f64, f64)>,
    end: f64,
) -> Integral<[f64; N]> {
    let size = |values: &[f64; N]| values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let allowed = |values: &[f64; N], _: &[f64; N]| [1e-13 * size(values); N];
    let method = (&GaussKronrod::POINTS_15, &LargestDifference);
    let Ok(found) = quadrature::integrate(&mut [Panel::EMPTY; MOST], intervals, method, &allowed, |_, x| {
        let s = x.exp().min(end);
        Ok::<_, Infallible>(f(s).map(|value| value * s))
    });
    // The rounding of the sum, the depth, and what the rules do not agree upon.
    let bound = found.errors.iter().fold(0.0_f64, |a, b| a.max(*b)) + 32.0 * f64::EPSILON * size(&found.values);
    Integral { value: found.values, bound, evaluations: found.evaluations }
}
