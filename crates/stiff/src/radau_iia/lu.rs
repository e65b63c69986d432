//! L U with row exchanges of real and of complex matrices, down their columns.
//!
//! Of each column only the rows between its first entry and its last that are not zero take part. The result is the same, and
//! banded matrices, as of chains, cost far less than full ones.
//!
//! Unlike the decomposition of `piola-numerics` it refuses no pivot but zero: the matrix γ/h M − J of a long step is nearly
//! singular where J is singular, and yet its solution is sound.

use core::ops::{Div, Mul, Sub, SubAssign};

use num_complex::Complex64;
use piola_numerics::{Kernel, dispatch};

/// The rows from which on wider instructions pay for the call.
const DISPATCHED: usize = 4;

/// An entry of a matrix.
pub(super) trait Entry:
    Copy + Default + Mul<Output = Self> + Div<Output = Self> + Sub<Output = Self> + SubAssign
{
    /// The size by which pivots are chosen: |re| + |im|.
    fn size(self) -> f64;
    /// Whether it is something else than zero; a NaN is.
    fn is_entry(&self) -> bool {
        0.0 < self.size() || self.size().is_nan()
    }
}
impl Entry for f64 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(self) -> f64 {
        self.abs()
    }
}
impl Entry for Complex64 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(self) -> f64 {
        self.l1_norm()
    }
}

/// The matrix, then its factors, with the row that was exchanged with each.
#[derive(Clone, Debug, Default)]
pub(super) struct Factors<T> {
    pub(super) entries: Vec<T>,
    exchanges: Vec<usize>,
    /// Of each column: where the entries of L begin and end, and where those of U above the diagonal begin.
    spans: Vec<[usize; 3]>,
}

impl<T: Entry> Factors<T> {
    pub(super) fn resize(&mut self, n: usize) {
        self.entries.resize(n * n, T::default());
        self.exchanges.resize(n, 0);
        self.spans.resize(n, [0; 3]);
    }

    /// The number of rows.
    pub(super) fn order(&self) -> usize {
        self.exchanges.len()
    }

    /// Factors `entries` in place.
    ///
    /// # Errors
    /// The index of the first pivot that is zero or not finite.
    pub(super) fn factor(&mut self) -> Result<(), usize> {
        if self.order() < DISPATCHED { Factor(self).run() } else { dispatch(Factor(self)) }
    }

    /// Overwrites b with the solution.
    pub(super) fn solve(&self, b: &mut [T]) {
        if self.order() < DISPATCHED { Solve(self, b).run() } else { dispatch(Solve(self, b)) }
    }
}

/// The factorisation, compiled for each set of instructions.
struct Factor<'a, T>(&'a mut Factors<T>);
impl<T: Entry> Kernel for Factor<'_, T> {
    type Output = Result<(), usize>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Result<(), usize> {
        let Self(factors) = self;
        let (a, n) = (&mut factors.entries[..], factors.exchanges.len());
        for k in 0..n {
            let column = &mut a[k * n..][..n];
            let end = column.iter().rposition(Entry::is_entry).map_or(0, |last| last + 1).max(k + 1);
            let begin = column[k + 1..end].iter().position(Entry::is_entry).map_or(end, |first| k + 1 + first);
            let above = column[..k].iter().position(Entry::is_entry).unwrap_or(k);
            let mut row = k;
            for i in begin..end {
                if column[row].size() < column[i].size() {
                    row = i;
                }
            }
            let pivot = column[row];
            if !(0.0 < pivot.size() && pivot.size() < f64::INFINITY) {
                return Err(k);
            }
            column.swap(k, row);
            for entry in &mut column[begin..end] {
                *entry = *entry / pivot;
            }
            factors.exchanges[k] = row;
            factors.spans[k] = [begin, end, above];
            let (left, right) = a.split_at_mut((k + 1) * n);
            let lower = &left[k * n..][begin..end];
            for column in right.chunks_exact_mut(n) {
                column.swap(k, row);
                let weight = column[k];
                if !weight.is_entry() {
                    continue;
                }
                for (x, &l) in column[begin..end].iter_mut().zip(lower) {
                    *x -= l * weight;
                }
            }
        }
        Ok(())
    }
}

/// The solution, compiled for each set of instructions.
struct Solve<'a, T>(&'a Factors<T>, &'a mut [T]);
impl<T: Entry> Kernel for Solve<'_, T> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let Self(factors, b) = self;
        let (a, n) = (&factors.entries[..], factors.exchanges.len());
        for k in 0..n {
            b.swap(k, factors.exchanges[k]);
            let (x, [begin, end, _]) = (b[k], factors.spans[k]);
            for (b, &l) in b[begin..end].iter_mut().zip(&a[k * n..][begin..end]) {
                *b -= l * x;
            }
        }
        for k in (0..n).rev() {
            let x = b[k] / a[k + k * n];
            b[k] = x;
            let [_, _, above] = factors.spans[k];
            for (b, &u) in b[above..k].iter_mut().zip(&a[k * n..][above..k]) {
                *b -= u * x;
            }
        }
    }
}
