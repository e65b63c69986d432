//! M⁻¹ times many columns at once, each in time proportional to the links, from articulated inertias that are there.
//!
//! ```text
//! inwards     u = b − S·p        the parent gets p + Y u
//! outwards    x = D⁻¹ u − Y·A    A of the child is A + S x
//! ```
//!
//! All vectors are in space about one reference point, so that no link turns anything.

use piola_numerics::Real;

use crate::freedoms::six;
use crate::link::Link;
use crate::space::{SUBSPACE, reference, row_pair};
use crate::spatial::{add, cross, sub, times};
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

/// S and Y of all freedoms in space, from articulated inertias, places and S that are there: S in the rows of the workspace, or
/// freedom after freedom.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn gains_in_space<T: Real>(tree: &RigidTree, work: &mut TreeWorkspace<T>, is_in_rows: bool) {
    let reference = reference(&work.space);
    for (i, link) in tree.links.iter().enumerate() {
        let here = &work.space[i + 1];
        let arm = sub(here.origin, reference);
        for j in link.v..link.v + link.kind.freedoms() {
            let force = times(here.axes, work.gains[j].1);
            let moment = add(times(here.axes, work.gains[j].0), cross(arm, force));
            let subspace = if is_in_rows { six(row_pair(&work.rows, SUBSPACE, j)) } else { work.motions[j] };
            work.column_vectors[j] = ColumnVectors { subspace, gain: six((moment, force)) };
        }
    }
}

/// Replaces the columns b of matrices of equal size, each with `each` columns, by ±M⁻¹ b.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn solve_columns<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    matrices: &mut [&mut [T]],
    signs: &[f64],
    each: usize,
) {
    let mut from = 0;
    while from < matrices.len() * each {
        solve(tree, work, matrices, signs, each, from);
        from += COLUMNS;
    }
}

/// [`solve_columns`] for so many columns from one on, where column c of all is column c mod `each` of matrix c / `each`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn solve<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    matrices: &mut [&mut [T]],
    signs: &[f64],
    each: usize,
    from: usize,
) {
    let n = tree.freedoms;
    let TreeWorkspace { inverses, column_states, column_values, column_vectors, .. } = work;
    let count = COLUMNS.min(matrices.len() * each - from);
    for k in 0..COLUMNS {
        if count <= k {
            for values in &mut *column_values {
                values[k] = T::zero();
            }
            continue;
        }
        let (matrix, column) = ((from + k) / each, (from + k) % each);
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
        let (matrix, column) = ((from + k) / each, (from + k) % each);
        for (values, x) in column_values.iter().zip(&mut matrices[matrix][column * n..(column + 1) * n]) {
            *x = values[k];
        }
    }
}

/// b = a + c x.
#[cfg_attr(not(debug_assertions), inline(always))]
fn set_sum<T: Real>(b: &mut ColumnState<T>, a: &ColumnState<T>, c: &[T; 6], x: &Values<T>) {
    let mut i = 0;
    while i < 6 {
        let mut k = 0;
        while k < COLUMNS {
            b[i][k] = a[i][k] + c[i] * x[k];
            k += 1;
        }
        i += 1;
    }
}

/// b = c x.
#[cfg_attr(not(debug_assertions), inline(always))]
fn set_scaled<T: Real>(b: &mut ColumnState<T>, c: &[T; 6], x: &Values<T>) {
    let mut i = 0;
    while i < 6 {
        let mut k = 0;
        while k < COLUMNS {
            b[i][k] = c[i] * x[k];
            k += 1;
        }
        i += 1;
    }
}

/// States are written where they stay: they are too large to be copied about.
#[cfg_attr(not(debug_assertions), inline(always))]
fn inwards<T: Real, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [ColumnState<T>],
    values: &mut [Values<T>],
    vectors: &[ColumnVectors<T>],
) {
    let (before, after) = states.split_at_mut(state);
    let (parent, own) = (&mut before[link.parent], &after[0]);
    let (values, vectors) = (&mut values[link.v..link.v + N], &vectors[link.v..link.v + N]);
    if !link.is_leaf {
        for (value, vector) in values.iter_mut().zip(vectors) {
            *value = less_dot(value, &vector.subspace, own);
        }
    }
    if link.parent == 0 {
        return;
    }
    // What the parent gets: p + Y u.
    let mut rest = 0;
    if link.is_first_met {
        if link.is_leaf {
            set_scaled(parent, &vectors[0].gain, &values[0]);
        } else {
            set_sum(parent, own, &vectors[0].gain, &values[0]);
        }
        rest = 1;
    } else if !link.is_leaf {
        for (parent, own) in parent.iter_mut().zip(own) {
            for (parent, &own) in parent.iter_mut().zip(own) {
                *parent += own;
            }
        }
    }
    for (value, vector) in values[rest..].iter().zip(&vectors[rest..]) {
        add_scaled(parent, &vector.gain, value);
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
    let (before, after) = states.split_at_mut(state);
    let (parent, own) = (&before[link.parent], &mut after[0]);
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
    // The ground does not move.
    let is_root = link.parent == 0;
    for ((value, vector), x) in values.iter_mut().zip(vectors).zip(&x) {
        *value = if is_root { *x } else { less_dot(x, &vector.gain, parent) };
    }
    if link.is_leaf {
        return;
    }
    if is_root {
        set_scaled(own, &vectors[0].subspace, &values[0]);
    } else {
        set_sum(own, parent, &vectors[0].subspace, &values[0]);
    }
    for (value, vector) in values[1..].iter().zip(&vectors[1..]) {
        add_scaled(own, &vector.subspace, value);
    }
}
