//! Forward dynamics with its derivatives by the inverse of the mass matrix, for trees of few freedoms: n³ operations in full registers.
//!
//! ```text
//! outwards at v̇ = 0        S, Ψ̇, Ψ̈, and the forces that the links need
//! inwards                  composite bodies, b = S·f        v̇ = M⁻¹ (τ − b)
//! outwards                 what v̇ adds to a, to Ψ̈ and to the forces
//! inwards                  ∂τ, from composite bodies that are there
//! ```
//!
//! Articulated inertias are not needed. M is that of composite bodies in the axes of the links, with all its digits.

use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::AccelerationDerivatives;
use super::inverse::{add_to_parent, pass_inwards, pass_outwards};
use crate::mass_matrix;
use crate::space::{SECOND_RATE, SUBSPACE, add_pairs, motion_cross, put_pair, row_pair};
use crate::spatial::{dot, scaled};
use crate::tree::RigidTree;
use crate::workspace::{COLUMNS, FOUR, TreeWorkspace};

/// v̇ and its derivatives; where M is positive definite.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn differentiate<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    (q, v, tau): (&[T], &[T], &[T]),
    out: &mut AccelerationDerivatives<T>,
) -> T::Mask {
    let n = tree.freedoms;
    let AccelerationDerivatives { acceleration, by_q, by_v, by_tau } = out;
    mass_matrix::fill(tree, work, q, by_tau);
    let is_positive = invert(&mut work.dense, by_tau, n);
    acceleration.fill(T::zero());
    pass_outwards(tree, work, v, acceleration);
    // τ − b, from the tips.
    for (i, link) in tree.links.iter().enumerate().rev() {
        let (torque, force) = (work.composite[i + 1].torque, work.composite[i + 1].force);
        for j in link.v..link.v + link.kind.freedoms() {
            let s = row_pair(&work.rows, SUBSPACE, j);
            work.column[j] = tau[j] - (dot(s.0, torque) + dot(s.1, force));
        }
        if link.parent != 0 {
            add_to_parent(&mut work.composite, i + 1, link.parent);
        }
    }
    for (j, column) in by_tau.chunks_exact(n.max(1)).enumerate() {
        for (acceleration, &entry) in acceleration.iter_mut().zip(column) {
            *acceleration += entry * work.column[j];
        }
    }
    accelerate(tree, work, acceleration);
    pass_inwards(tree, work, by_q, by_v, None, Some(acceleration));
    multiply(work, [by_q, by_v], n);
    is_positive
}

/// What v̇ adds to the accelerations of the links, to Ψ̈ and to the forces of composite bodies, of which those of v̇ beyond a link are
/// left to the pass inwards: they gather in the fields of velocities.
#[cfg_attr(not(debug_assertions), inline(always))]
fn accelerate<T: Real>(tree: &RigidTree, work: &mut TreeWorkspace<T>, a: &[T]) {
    let TreeWorkspace { space, rows, composite, .. } = work;
    let zero = [T::zero(); 3];
    for (i, link) in tree.links.iter().enumerate() {
        let parent = (space[link.parent].alpha, space[link.parent].acceleration);
        let mut own = parent;
        for j in link.v..link.v + link.kind.freedoms() {
            let s = row_pair(rows, SUBSPACE, j);
            let second = add_pairs(row_pair(rows, SECOND_RATE, j), motion_cross(parent, s));
            put_pair(rows, SECOND_RATE, j, second);
            own = add_pairs(own, (scaled(a[j], s.0), scaled(a[j], s.1)));
        }
        let here = &mut space[i + 1];
        (here.alpha, here.acceleration) = own;
        (here.w, here.velocity) = (zero, zero);
        let beyond = &mut composite[i + 1];
        (beyond.torque, beyond.force) = add_pairs((beyond.torque, beyond.force), beyond.momentum_of(own));
    }
}

/// Replaces a symmetric matrix by its inverse, by Gauss's and Jordan's elimination, and writes −1 times it to `dense`, with columns of a
/// length that fours divide; where it is positive definite by more than rounding.
#[cfg_attr(not(debug_assertions), inline(always))]
fn invert<T: Real>(dense: &mut [T], matrix: &mut [T], n: usize) -> T::Mask {
    let mut is_positive = T::Mask::splat(true);
    let rounding = T::lit(8.0 * unit_in_last_place::<T>());
    let stride = n.next_multiple_of(FOUR);
    for (row, from) in dense.chunks_exact_mut(stride.max(1)).zip(matrix.chunks_exact(n.max(1))) {
        row[..n].copy_from_slice(from);
    }
    for k in 0..n {
        let pivot = dense[k * stride + k];
        is_positive = is_positive & (rounding * matrix[k * n + k]).less_than(pivot);
        let reciprocal = pivot.recip();
        let (before, rest) = dense.split_at_mut(k * stride);
        let (row, after) = rest.split_at_mut(stride);
        row[k] = T::one();
        for x in row.as_chunks_mut::<FOUR>().0 {
            *x = x.map(|x| reciprocal * x);
        }
        let others = before.chunks_exact_mut(stride).chain(after.chunks_exact_mut(stride));
        for other in others {
            let factor = other[k];
            other[k] = T::zero();
            for (x, y) in other.as_chunks_mut::<FOUR>().0.iter_mut().zip(row.as_chunks::<FOUR>().0) {
                // All loads before all stores: then four go by one register.
                let (mut sum, y) = (*x, *y);
                let mut c = 0;
                while c < FOUR {
                    sum[c] -= factor * y[c];
                    c += 1;
                }
                *x = sum;
            }
        }
    }
    // The upper triangle as the lower one: rounding makes them differ.
    for i in 0..n {
        for j in 0..=i {
            let entry = dense[i * stride + j];
            matrix[i * n + j] = entry;
            matrix[j * n + i] = entry;
            dense[i * stride + j] = -entry;
            dense[j * stride + i] = -entry;
        }
    }
    is_positive
}

/// Replaces the columns b of matrices by −M⁻¹ b: eight or four columns at a time, four of their entries in one register.
#[cfg_attr(not(debug_assertions), inline(always))]
fn multiply<T: Real>(work: &mut TreeWorkspace<T>, matrices: [&mut [T]; 2], n: usize) {
    let TreeWorkspace { dense, column_values, .. } = work;
    let stride = n.next_multiple_of(FOUR);
    for matrix in matrices {
        for block in matrix.chunks_mut((COLUMNS * n).max(1)) {
            let count = block.len() / n;
            for (k, column) in block.chunks_exact(n).enumerate() {
                for (values, &b) in column_values.iter_mut().zip(column) {
                    values[k] = b;
                }
            }
            for group in 0..stride / FOUR {
                if count <= COLUMNS / 2 {
                    put(&tile::<T, { COLUMNS / 2 }>(dense, stride, group, &column_values[..n]), block, n, group);
                } else {
                    put(&tile::<T, COLUMNS>(dense, stride, group, &column_values[..n]), block, n, group);
                }
            }
        }
    }
}

/// Four rows of a product, of K columns.
#[cfg_attr(not(debug_assertions), inline(always))]
fn tile<T: Real, const K: usize>(
    dense: &[T],
    stride: usize,
    group: usize,
    values: &[[T; COLUMNS]],
) -> [[T; FOUR]; K] {
    let mut sums = [[T::zero(); FOUR]; K];
    for (row, values) in dense.chunks_exact(stride).zip(values) {
        let entries = row.as_chunks::<FOUR>().0[group];
        let mut k = 0;
        while k < K {
            let mut c = 0;
            while c < FOUR {
                sums[k][c] += entries[c] * values[k];
                c += 1;
            }
            k += 1;
        }
    }
    sums
}

/// Writes four rows of a product to columns, as many of both as there are.
#[cfg_attr(not(debug_assertions), inline(always))]
fn put<T: Real, const K: usize>(sums: &[[T; FOUR]; K], columns: &mut [T], n: usize, group: usize) {
    for (column, sum) in columns.chunks_exact_mut(n).zip(sums) {
        match (&mut column[group * FOUR..], *sum) {
            ([w, x, y, z, ..], [a, b, c, d]) => (*w, *x, *y, *z) = (a, b, c, d),
            ([w, x, y], [a, b, c, _]) => (*w, *x, *y) = (a, b, c),
            ([w, x], [a, b, ..]) => (*w, *x) = (a, b),
            ([w], [a, ..]) => *w = a,
            ([], _) => {}
        }
    }
}
