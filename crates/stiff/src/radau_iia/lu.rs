//! L U with row exchanges of real and of complex matrices, down their columns.
//!
//! Unlike the decomposition of `piola-numerics` it refuses no pivot but zero: the matrix γ/h M − J of a long step is nearly
//! singular where J is singular, and yet its solution is sound.

use core::ops::{Div, Mul, Sub, SubAssign};

use num_complex::Complex64;

/// An entry of a matrix.
pub(super) trait Entry:
    Copy + Default + Mul<Output = Self> + Div<Output = Self> + Sub<Output = Self> + SubAssign
{
    /// The size by which pivots are chosen: |re| + |im|.
    fn size(self) -> f64;
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
}

impl<T: Entry> Factors<T> {
    pub(super) fn resize(&mut self, n: usize) {
        self.entries.resize(n * n, T::default());
        self.exchanges.resize(n, 0);
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
        let (a, n) = (&mut self.entries[..], self.exchanges.len());
        for k in 0..n {
            let mut row = k;
            for i in k + 1..n {
                if a[row + k * n].size() < a[i + k * n].size() {
                    row = i;
                }
            }
            self.exchanges[k] = row;
            let pivot = a[row + k * n];
            if !(0.0 < pivot.size() && pivot.size() < f64::INFINITY) {
                return Err(k);
            }
            a.swap(k + k * n, row + k * n);
            for i in k + 1..n {
                a[i + k * n] = a[i + k * n] / pivot;
            }
            let (left, right) = a.split_at_mut((k + 1) * n);
            let lower = &left[k * n + k + 1..];
            for column in right.chunks_exact_mut(n) {
                column.swap(k, row);
                let weight = column[k];
                if weight.size() <= 0.0 {
                    continue;
                }
                for (x, &l) in column[k + 1..].iter_mut().zip(lower) {
                    *x -= l * weight;
                }
            }
        }
        Ok(())
    }

    /// Overwrites b with the solution.
    pub(super) fn solve(&self, b: &mut [T]) {
        let (a, n) = (&self.entries[..], self.exchanges.len());
        for k in 0..n {
            b.swap(k, self.exchanges[k]);
            let x = b[k];
            for i in k + 1..n {
                b[i] -= a[i + k * n] * x;
            }
        }
        for k in (0..n).rev() {
            let x = b[k] / a[k + k * n];
            b[k] = x;
            for i in 0..k {
                b[i] -= a[i + k * n] * x;
            }
        }
    }
}
