//! Kernels on arrays over pairs of indices: without a branch, inlined, so that they run in lanes.
//!
//! A change of basis, a push-forward and a pull-back of a tensor with minor symmetries are one product of 6×6
//! matrices from either side:
//!
//! ```text
//! c_ijkl = F_iA F_jB F_kC F_lD C_ABCD        c = M C Mᵀ,   slots(F S Fᵀ) = M slots(S)
//! ```
//! M costs 54 products, the rest 216 + 126 when the major symmetry holds (432 when not), in place of 3⁸.

use piola_numerics::Real;

use crate::rows::Rows;
use crate::slots::Slots;

/// a · b of six numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn dot6<T: Real>(a: &[T; 6], b: &[T; 6]) -> T {
    (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
}

/// The 6×6 matrix M with slots(F S Fᵀ) = M slots(S) for symmetric S.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn congruence_matrix<T: Real>(f: Rows<T>) -> Slots<T> {
    [squares(f[0]), squares(f[1]), squares(f[2]), products(f[0], f[1]), products(f[1], f[2]), products(f[0], f[2])]
}

/// Row (i, i) of the congruence.
#[cfg_attr(not(debug_assertions), inline(always))]
fn squares<T: Real>(a: [T; 3]) -> [T; 6] {
    let twice = [a[0] + a[0], a[1] + a[1]];
    [a[0] * a[0], a[1] * a[1], a[2] * a[2], twice[0] * a[1], twice[1] * a[2], twice[0] * a[2]]
}

/// Row (i, j) of the congruence.
#[cfg_attr(not(debug_assertions), inline(always))]
fn products<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 6] {
    [
        a[0] * b[0],
        a[1] * b[1],
        a[2] * b[2],
        a[0] * b[1] + a[1] * b[0],
        a[1] * b[2] + a[2] * b[1],
        a[0] * b[2] + a[2] * b[0],
    ]
}

/// Row i of a symmetric 6×6 matrix whose upper triangle is stored by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn full_row<T: Real>(c: &[T; 21], i: usize) -> [T; 6] {
    let at = |j: usize| c[triangle(i, j)];
    [at(0), at(1), at(2), at(3), at(4), at(5)]
}

/// The place of (i, j) in the upper triangle stored by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) const fn triangle(i: usize, j: usize) -> usize {
    let (i, j) = if i <= j { (i, j) } else { (j, i) };
    i * (11 - i) / 2 + j
}

/// M C Mᵀ of the upper triangle of a symmetric C: that of the result.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn transform_major<T: Real>(m: &Slots<T>, c: &[T; 21]) -> [T; 21] {
    let rows = [full_row(c, 0), full_row(c, 1), full_row(c, 2), full_row(c, 3), full_row(c, 4), full_row(c, 5)];
    let mut result = [T::zero(); 21];
    let mut place = 0;
    for i in 0..6 {
        let half = times_symmetric(&m[i], &rows);
        for row in &m[i..] {
            result[place] = dot6(&half, row);
            place += 1;
        }
    }
    result
}

/// M C Mᵀ of a 6×6 matrix C.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn transform_minor<T: Real>(m: &Slots<T>, c: &Slots<T>) -> Slots<T> {
    // Columns of C as rows: each entry of M C is one dot product.
    let columns = transposed(c);
    let mut result = [[T::zero(); 6]; 6];
    for i in 0..6 {
        let half = times_symmetric(&m[i], &columns);
        for j in 0..6 {
            result[i][j] = dot6(&half, &m[j]);
        }
    }
    result
}

/// v C for a row v, where `columns[j]` is column j of C.
#[cfg_attr(not(debug_assertions), inline(always))]
fn times_symmetric<T: Real>(v: &[T; 6], columns: &Slots<T>) -> [T; 6] {
    [
        dot6(v, &columns[0]),
        dot6(v, &columns[1]),
        dot6(v, &columns[2]),
        dot6(v, &columns[3]),
        dot6(v, &columns[4]),
        dot6(v, &columns[5]),
    ]
}

/// The transpose of a 6×6 matrix.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn transposed<T: Real>(c: &Slots<T>) -> Slots<T> {
    let row = |j: usize| [c[0][j], c[1][j], c[2][j], c[3][j], c[4][j], c[5][j]];
    [row(0), row(1), row(2), row(3), row(4), row(5)]
}

/// Components (ij) of C : A for symmetric A, from the rows of C: shears of A count twice.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn contract<T: Real>(c: &Slots<T>, a: [T; 6]) -> [T; 6] {
    let doubled = [a[0], a[1], a[2], a[3] + a[3], a[4] + a[4], a[5] + a[5]];
    [
        dot6(&c[0], &doubled),
        dot6(&c[1], &doubled),
        dot6(&c[2], &doubled),
        dot6(&c[3], &doubled),
        dot6(&c[4], &doubled),
        dot6(&c[5], &doubled),
    ]
}
