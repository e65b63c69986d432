//! M⁻¹ times many columns at once, each in time proportional to the links, from articulated inertias that are there.
//!
//! ```text
//! inwards     u = b − S·p        the parent gets p + Y u
//! outwards    x = D⁻¹ u − Y·A    A of the child is A + S x
//! ```
//!
//! All vectors are in space about one reference point, so that no link turns anything.

use piola_numerics::Real;

use crate::link::Link;
use crate::tree::RigidTree;
use crate::workspace::{COLUMNS, ColumnState, ColumnVectors, TreeWorkspace};

type Values<T> = [T; COLUMNS];

/// start − Σ a b.
#[cfg_attr(not(debug_assertions), inline(always))]
fn less_dot<T: Real>(start: &Values<T>, a: &[T; 6], b: &ColumnState<T>) -> Values<T> {
    let mut out = *start;
    let mut k = 0;
    while k < COLUMNS {
        let angular = a[0] * b[0][k] + a[1] * b[1][k] + a[2] * b[2][k];
        let linear = a[3] * b[3][k] + a[4] * b[4][k] + a[5] * b[5][k];
        out[k] -= angular + linear;
        k += 1;
    }
    out
}

/// b += a x.
#[cfg_attr(not(debug_assertions), inline(always))]
fn add_scaled<T: Real>(b: &mut ColumnState<T>, a: &[T; 6], x: &Values<T>) {
    let mut c = 0;
    while c < 6 {
        let mut k = 0;
        while k < COLUMNS {
            b[c][k] += a[c] * x[k];
            k += 1;
        }
        c += 1;
    }
}

/// Replaces columns b of three matrices by ±M⁻¹ b, from column `from` on, where column c of all is column c mod n of matrix
/// c / n.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn solve<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    matrices: &mut [&mut [T]; 3],
    signs: [f64; 3],
    from: usize,
) {
    let n = tree.freedoms;
    let TreeWorkspace { inverses, column_states, column_values, column_vectors, .. } = work;
    let count = COLUMNS.min(3 * n - from);
    for k in 0..COLUMNS {
        if count <= k {
            for values in &mut *column_values {
                values[k] = T::zero();
            }
            continue;
        }
        let (matrix, column) = ((from + k) / n, (from + k) % n);
        let sign = T::lit(signs[matrix]);
        for (values, &b) in column_values.iter_mut().zip(&matrices[matrix][column * n..(column + 1) * n]) {
            values[k] = sign * b;
        }
    }
    for (i, link) in tree.links.iter().enumerate().rev() {
        if link.kind.freedoms() == 1 {
            inwards::<T, 1>(link, i + 1, column_states, column_values, column_vectors);
        } else if link.kind.freedoms() == 3 {
            inwards::<T, 3>(link, i + 1, column_states, column_values, column_vectors);
        } else {
            inwards::<T, 6>(link, i + 1, column_states, column_values, column_vectors);
        }
    }
    for (i, link) in tree.links.iter().enumerate() {
        if link.kind.freedoms() == 1 {
            outwards::<T, 1>(link, i + 1, inverses, column_states, column_values, column_vectors);
        } else if link.kind.freedoms() == 3 {
            outwards::<T, 3>(link, i + 1, inverses, column_states, column_values, column_vectors);
        } else {
            outwards::<T, 6>(link, i + 1, inverses, column_states, column_values, column_vectors);
        }
    }
    for k in 0..count {
        let (matrix, column) = ((from + k) / n, (from + k) % n);
        for (values, x) in column_values.iter().zip(&mut matrices[matrix][column * n..(column + 1) * n]) {
            *x = values[k];
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn inwards<T: Real, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [ColumnState<T>],
    values: &mut [Values<T>],
    vectors: &[ColumnVectors<T>],
) {
    let mut p = if link.is_leaf { [[T::zero(); COLUMNS]; 6] } else { states[state] };
    let (values, vectors) = (&mut values[link.v..link.v + N], &vectors[link.v..link.v + N]);
    for (value, vector) in values.iter_mut().zip(vectors) {
        *value = less_dot(value, &vector.subspace, &p);
    }
    if link.parent == 0 {
        return;
    }
    for (value, vector) in values.iter().zip(vectors) {
        add_scaled(&mut p, &vector.gain, value);
    }
    let parent = &mut states[link.parent];
    if link.is_first_met {
        *parent = p;
        return;
    }
    for (parent, p) in parent.iter_mut().zip(&p) {
        for (parent, &p) in parent.iter_mut().zip(p) {
            *parent += p;
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn outwards<T: Real, const N: usize>(
    link: &Link,
    state: usize,
    inverses: &[T],
    states: &mut [ColumnState<T>],
    values: &mut [Values<T>],
    vectors: &[ColumnVectors<T>],
) {
    let mut acceleration = if link.parent == 0 { [[T::zero(); COLUMNS]; 6] } else { states[link.parent] };
    let (values, vectors) = (&mut values[link.v..link.v + N], &vectors[link.v..link.v + N]);
    let inverses = &inverses[link.square..link.square + N * N];
    let mut x = [[T::zero(); COLUMNS]; N];
    for (k, x) in x.iter_mut().enumerate() {
        for (l, value) in values.iter().enumerate() {
            for (x, &value) in x.iter_mut().zip(value) {
                *x += inverses[k * N + l] * value;
            }
        }
    }
    for ((value, vector), x) in values.iter_mut().zip(vectors).zip(&x) {
        *value = less_dot(x, &vector.gain, &acceleration);
    }
    if !link.is_leaf {
        for (value, vector) in values.iter().zip(vectors) {
            add_scaled(&mut acceleration, &vector.subspace, value);
        }
        states[state] = acceleration;
    }
}
