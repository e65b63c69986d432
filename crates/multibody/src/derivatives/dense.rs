//! M⁻¹ of small trees from articulated inertias, and its products with columns that are zero for freedoms on other branches.
//!
//! ```text
//! M = Lᵀ D L        U = L⁻ᵀ        M⁻¹ = Uᵀ D⁻¹ U
//! from the tips     U_kj = −S_k·p_j for j beyond k, then p_j += Y_k U_kj        p_j = Y_j at the joint of j
//! ```
//!
//! All vectors are in space about one reference point, so that eight freedoms j are carried to the ground side by side.

use piola_numerics::Real;

use crate::freedoms::{EIGHT, Eight, FOUR, products, put, write};
use crate::link::Link;
use crate::tree::RigidTree;
use crate::workspace::{ColumnVectors, Dense, TreeWorkspace};

/// M⁻¹, where articulated inertias are there.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn invert<T: Real>(tree: &RigidTree, work: &mut TreeWorkspace<T>, out: &mut [T]) {
    let TreeWorkspace { inverses, column_vectors, dense, .. } = work;
    for (j, of) in column_vectors.iter().enumerate() {
        put(&mut dense.sums, j, 0, of.gain);
    }
    for (i, link) in tree.links.iter().enumerate().rev() {
        let beyond = tree.relatives.of(i);
        let own = &column_vectors[link.v..];
        match link.kind.freedoms() {
            1 => rows::<T, 1>(link, beyond, own, inverses, dense),
            3 => rows::<T, 3>(link, beyond, own, inverses, dense),
            _ => rows::<T, 6>(link, beyond, own, inverses, dense),
        }
    }
    let (n, eights) = (tree.freedoms, tree.relatives.eights);
    let Dense { upper, scaled, inverse, columns, .. } = dense;
    for first in (0..n).step_by(FOUR) {
        let count = FOUR.min(n - first);
        let [support, _] = tree.relatives.lists(first);
        for (column, &k) in columns.iter_mut().zip(support) {
            let (fours, _) = scaled[k * eights + first / EIGHT].0[0].as_chunks::<FOUR>();
            *column = fours[first % EIGHT / FOUR];
        }
        for b in 0..eights {
            // Row k of U is zero before k.
            let support = &support[..support.partition_point(|&k| k < (b + 1) * EIGHT)];
            let sums = multiply(upper, eights, b, support, columns);
            for (c, sums) in sums[..count].iter().enumerate() {
                inverse[(first + c) * eights + b].0[0] = *sums;
                write(&mut out[(first + c) * n..(first + c + 1) * n], b * EIGHT, n, sums);
            }
        }
    }
}

/// Replaces the columns b of matrices by −M⁻¹ b, where M⁻¹ is there.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn multiply_columns<T: Real>(tree: &RigidTree, dense: &mut Dense<T>, mut matrices: [&mut [T]; 2]) {
    let (n, eights) = (tree.freedoms, tree.relatives.eights);
    let Dense { inverse, columns, .. } = dense;
    for first in (0..n).step_by(FOUR) {
        let count = FOUR.min(n - first);
        let [_, support] = tree.relatives.lists(first);
        for matrix in &mut matrices {
            let four = &mut matrix[first * n..(first + count) * n];
            for c in 0..FOUR {
                if let Some(from) = four.get(c * n..(c + 1) * n) {
                    for (column, &k) in columns.iter_mut().zip(support) {
                        column[c] = -from[k];
                    }
                }
            }
            for b in 0..eights {
                let sums = multiply(inverse, eights, b, support, columns);
                for (out, sums) in four.chunks_exact_mut(n).zip(&sums) {
                    write(out, b * EIGHT, n, sums);
                }
            }
        }
    }
}

/// Rows k of U and of D⁻¹ U for the freedoms k of a joint.
#[cfg_attr(not(debug_assertions), inline(always))]
fn rows<T: Real, const N: usize>(
    link: &Link,
    bits: &[[u8; 2]],
    own: &[ColumnVectors<T>],
    inverses: &[T],
    dense: &mut Dense<T>,
) {
    let eights = bits.len();
    let inverses = &inverses[link.square..link.square + N * N];
    let first = link.v / EIGHT;
    for k in link.v..link.v + N {
        for b in k * eights..k * eights + first {
            (dense.upper[b], dense.scaled[b]) = (Eight([[T::zero(); EIGHT]]), Eight([[T::zero(); EIGHT]]));
        }
    }
    for b in first..eights {
        let beyond = bits[b][1];
        let mut entries = [[T::zero(); EIGHT]; N];
        if beyond != 0 {
            let sums = &mut dense.sums[b].0;
            for (entries, own) in entries.iter_mut().zip(own) {
                let parts = products(beyond, sums, &own.subspace);
                for j in 0..EIGHT {
                    entries[j] -= parts[j];
                }
            }
            for (entries, own) in entries.iter().zip(own) {
                for (sums, &gain) in sums.iter_mut().zip(&own.gain) {
                    for j in 0..EIGHT {
                        sums[j] += gain * entries[j];
                    }
                }
            }
        }
        for k in 0..N {
            if (link.v + k) / EIGHT == b {
                entries[k][(link.v + k) % EIGHT] = T::one();
            }
        }
        for k in 0..N {
            let mut scaled = [T::zero(); EIGHT];
            for l in 0..N {
                for j in 0..EIGHT {
                    scaled[j] += inverses[k * N + l] * entries[l][j];
                }
            }
            dense.upper[(link.v + k) * eights + b].0[0] = entries[k];
            dense.scaled[(link.v + k) * eights + b].0[0] = scaled;
        }
    }
}

/// Eight rows of the products of a matrix with four columns, which are zero outside of their support.
#[cfg_attr(not(debug_assertions), inline(always))]
fn multiply<T: Real>(
    matrix: &[Eight<T, 1>],
    eights: usize,
    b: usize,
    support: &[usize],
    columns: &[[T; FOUR]],
) -> [[T; EIGHT]; FOUR] {
    let mut sums = [[T::zero(); EIGHT]; FOUR];
    for (&k, four) in support.iter().zip(columns) {
        let eight = &matrix[k * eights + b].0[0];
        for c in 0..FOUR {
            for r in 0..EIGHT {
                sums[c][r] += eight[r] * four[c];
            }
        }
    }
    sums
}
