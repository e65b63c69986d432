//! M⁻¹ times many columns at once, each in time proportional to the links, from articulated inertias that are there.
//!
//! ```text
//! inwards     u = b − S·p        the parent gets p + Y u
//! outwards    x = D⁻¹ u − Y·A    A of the child is A + S x
//! ```
//!
//! All vectors are in space about one reference point, so that no link turns anything.

use piola_numerics::Real;

use crate::space::{GAIN, SUBSPACE};
use crate::tree::RigidTree;
use crate::workspace::{COLUMNS, ColumnState, TreeWorkspace};

/// a·b of a freedom's vector with many columns, from `start`: start − Σ a b.
#[cfg_attr(not(debug_assertions), inline(always))]
fn less_dot<T: Real>(start: [T; COLUMNS], a: &[T; 6], b: &ColumnState<T>) -> [T; COLUMNS] {
    let mut out = start;
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
fn add_scaled<T: Real>(b: &mut ColumnState<T>, a: &[T; 6], x: &[T; COLUMNS]) {
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

/// The six components of a freedom's vector.
#[cfg_attr(not(debug_assertions), inline(always))]
fn gather<T: Real>(rows: &[T], stride: usize, row: usize, freedom: usize) -> [T; 6] {
    let mut out = [T::zero(); 6];
    let mut c = 0;
    while c < 6 {
        out[c] = rows[(row + c) * stride + freedom];
        c += 1;
    }
    out
}

/// Replaces columns b of three matrices by sign M⁻¹ b, where column c of all is column c mod n of matrix c / n.
///
/// `last` is the last link with a right-hand side that is not zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn solve<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    matrices: &mut [&mut [T]; 3],
    signs: [f64; 3],
    from: usize,
) {
    let n = tree.freedoms;
    let TreeWorkspace { rows, inverses, column_states, column_values, .. } = work;
    let count = COLUMNS.min(3 * n - from);
    let place = |k: usize| {
        let column = (from + k).min(3 * n - 1);
        (column / n, column % n * n)
    };
    let mut places = [(0, 0); COLUMNS];
    let mut sign = [T::zero(); COLUMNS];
    for k in 0..COLUMNS {
        places[k] = place(k);
        sign[k] = T::lit(signs[places[k].0]);
    }
    let stride = rows.stride;
    let rows = &rows.rows[..];
    let zero = [[T::zero(); COLUMNS]; 6];
    for (i, link) in tree.links.iter().enumerate().rev() {
        let mut p = if link.is_leaf { zero } else { column_states[i + 1] };
        let freedoms = link.kind.freedoms();
        let mut k = 0;
        while k < freedoms {
            let j = link.v + k;
            let mut b = [T::zero(); COLUMNS];
            for c in 0..COLUMNS {
                b[c] = sign[c] * matrices[places[c].0][places[c].1 + j];
            }
            column_values[j] = less_dot(b, &gather(rows, stride, SUBSPACE, j), &p);
            k += 1;
        }
        if link.parent != 0 {
            k = 0;
            while k < freedoms {
                let j = link.v + k;
                add_scaled(&mut p, &gather(rows, stride, GAIN, j), &column_values[j]);
                k += 1;
            }
            let parent = &mut column_states[link.parent];
            if link.is_first_met {
                *parent = p;
            } else {
                for c in 0..6 {
                    for k in 0..COLUMNS {
                        parent[c][k] += p[c][k];
                    }
                }
            }
        }
    }
    for (i, link) in tree.links.iter().enumerate() {
        let mut state = if link.parent == 0 { zero } else { column_states[link.parent] };
        let freedoms = link.kind.freedoms();
        let mut x = [[T::zero(); COLUMNS]; 6];
        let mut k = 0;
        while k < freedoms {
            let j = link.v + k;
            let mut own = [T::zero(); COLUMNS];
            let mut l = 0;
            while l < freedoms {
                let inverse = inverses[link.square + k * freedoms + l];
                for c in 0..COLUMNS {
                    own[c] += inverse * column_values[link.v + l][c];
                }
                l += 1;
            }
            x[k] = less_dot(own, &gather(rows, stride, GAIN, j), &state);
            for c in 0..count {
                matrices[places[c].0][places[c].1 + j] = x[k][c];
            }
            k += 1;
        }
        if !link.is_leaf {
            k = 0;
            while k < freedoms {
                add_scaled(&mut state, &gather(rows, stride, SUBSPACE, link.v + k), &x[k]);
                k += 1;
            }
            column_states[i + 1] = state;
        }
    }
}
