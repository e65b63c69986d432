//! L U with row exchanges of real and of complex matrices, down their columns.
//!
//! Unlike the decomposition of `piola-numerics` it refuses no pivot but zero: the matrix γ/h M − J of a long step is nearly
//! singular where J is singular, and yet its solution is sound.

use core::ops::{AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A complex number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Complex {
    pub(super) re: f64,
    pub(super) im: f64,
}

impl Sub for Complex {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}
impl SubAssign for Complex {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
impl AddAssign for Complex {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_assign(&mut self, other: Self) {
        *self = Self { re: self.re + other.re, im: self.im + other.im };
    }
}
impl Neg for Complex {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}
impl Mul for Complex {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}
impl Div for Complex {
    type Output = Self;
    /// By Smith's rule: without overflow of the squares.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn div(self, other: Self) -> Self {
        if other.im.abs() <= other.re.abs() {
            let ratio = other.im / other.re;
            let length = other.re + other.im * ratio;
            Self { re: (self.re + self.im * ratio) / length, im: (self.im - self.re * ratio) / length }
        } else {
            let ratio = other.re / other.im;
            let length = other.im + other.re * ratio;
            Self { re: (self.re * ratio + self.im) / length, im: (self.im * ratio - self.re) / length }
        }
    }
}

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
impl Entry for Complex {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
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
