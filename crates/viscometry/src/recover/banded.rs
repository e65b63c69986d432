//! Equations with few entries beside the diagonal: of splines through rows.
//!
//! Matrices of B-splines at rising abscissas are totally positive: elimination needs no exchange of rows (C. de Boor, A. Pinkus, 1977),
//! and memory and time grow with the number of rows.

/// The highest degree of splines.
pub(super) const HIGHEST: usize = 9;
/// Entries of a row: the diagonal in the middle.
const WIDTH: usize = 2 * HIGHEST + 1;
/// Values below this part of the largest are none.
const NONE: f64 = 1e-20;

/// The factors L U of a matrix with `reach` entries on each side of the diagonal.
#[derive(Clone, Debug)]
pub(super) struct Banded {
    reach: usize,
    rows: Vec<[f64; WIDTH]>,
}

impl Banded {
    /// Of rows (first column, values); `None` where a pivot is no number or zero, or a row leaves the band.
    pub(super) fn factors<'r>(reach: usize, rows: impl Iterator<Item = (usize, &'r [f64])>) -> Option<Self> {
        let mut band: Vec<[f64; WIDTH]> = Vec::new();
        for (i, (first, values)) in rows.enumerate() {
            let mut row = [0.0; WIDTH];
            for (k, value) in values.iter().enumerate() {
                let place = (first + k + reach).checked_sub(i)?;
                if 2 * reach < place {
                    if 0.0 < value.abs() {
                        return None;
                    }
                    continue;
                }
                row[place] = *value;
            }
            band.push(row);
        }
        let count = band.len();
        for k in 0..count {
            let pivot = band[k];
            if !(pivot[reach].is_finite() && 0.0 < pivot[reach].abs()) {
                return None;
            }
            for (i, row) in band.iter_mut().enumerate().take(count.min(k + reach + 1)).skip(k + 1) {
                let place = reach + k - i;
                let factor = row[place] / pivot[reach];
                row[place] = factor;
                if 0.0 < factor.abs() {
                    for j in 1..=reach {
                        row[place + j] -= factor * pivot[reach + j];
                    }
                }
            }
        }
        Some(Self { reach, rows: band })
    }

    /// The solution of A x = b.
    pub(super) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let (reach, count) = (self.reach, self.rows.len());
        let mut x = b.to_vec();
        for i in 0..count {
            for j in i.saturating_sub(reach)..i {
                x[i] -= self.rows[i][reach + j - i] * x[j];
            }
        }
        for i in (0..count).rev() {
            for j in i + 1..count.min(i + reach + 1) {
                x[i] -= self.rows[i][reach + j - i] * x[j];
            }
            x[i] /= self.rows[i][reach];
        }
        x
    }

    /// The solution of Aᵀ x = b in place, whose entries that count are few: their range.
    pub(super) fn solve_transposed(&self, x: &mut [f64]) -> core::ops::Range<usize> {
        let (reach, count) = (self.reach, self.rows.len());
        let Some(first) = x.iter().position(|x| 0.0 < x.abs()) else { return 0..0 };
        let last = x.iter().rposition(|x| 0.0 < x.abs()).unwrap_or(first);
        let mut largest = 0.0_f64;
        let mut end = first;
        for i in first..count {
            for j in i.saturating_sub(reach).max(first)..i {
                x[i] -= self.rows[j][reach + i - j] * x[j];
            }
            x[i] /= self.rows[i][reach];
            largest = largest.max(x[i].abs());
            end = i + 1;
            if last < i && x[end.saturating_sub(reach)..end].iter().all(|x| x.abs() <= NONE * largest) {
                break;
            }
        }
        let mut begin = end;
        for i in (0..end).rev() {
            for j in i + 1..end.min(i + reach + 1) {
                x[i] -= self.rows[j][reach + i - j] * x[j];
            }
            largest = largest.max(x[i].abs());
            begin = i;
            if i < first && x[i..end.min(i + reach)].iter().all(|x| x.abs() <= NONE * largest) {
                break;
            }
        }
        begin..end
    }
}
