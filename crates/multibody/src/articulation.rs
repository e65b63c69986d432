//! Articulated inertias: of one link with its own, reduced by a joint, moved to the parent.

use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use crate::link::{Articulated, Link, Pair};
use crate::spatial::{ENTRY, Matrix, Symmetric, cross, lit, lit_symmetric, skew};
use crate::turn::Turning;
use crate::workspace::LinkArticulation;

/// D⁻¹ of a symmetric matrix, and where it is positive definite. Elsewhere the diagonal holds the reciprocal pivots, infinite
/// where rounding leaves nothing of one: `explain_inertia` finds the joint by the first that is not positive and finite.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn inverse_of<T: Real, const N: usize>(d: [[T; N]; N]) -> ([[T; N]; N], T::Mask) {
    let mut inverse = [[T::zero(); N]; N];
    if N == 1 {
        inverse[0][0] = d[0][0].recip();
        return (inverse, T::zero().less_than(d[0][0]));
    }
    // D = L diag Lᵀ, then a column of the identity at a time.
    let mut l = d;
    let rounding = T::lit(8.0 * unit_in_last_place::<T>());
    let mut reciprocals = [T::zero(); N];
    let mut is_positive = T::Mask::splat(true);
    for j in 0..N {
        for k in 0..j {
            let scaled = l[j][k] * l[k][k];
            for i in j..N {
                let entry = l[i][k] * scaled;
                l[i][j] -= entry;
            }
        }
        // A pivot of the size of rounding beside those of rotations, or of displacements, is none.
        let first = j / 3 * 3;
        let mut trace = d[first][first];
        for i in first + 1..first + 3 {
            if i < N {
                trace += d[i][i];
            }
        }
        let least = rounding * trace;
        is_positive = is_positive & least.less_than(l[j][j]);
        let reciprocal = l[j][j].recip();
        reciprocals[j] = T::select(l[j][j].abs().at_most(least), T::lit(f64::INFINITY), reciprocal);
        for i in j + 1..N {
            l[i][j] *= reciprocal;
        }
    }
    for c in 0..N {
        let mut x = [T::zero(); N];
        x[c] = T::one();
        for i in 0..N {
            for k in 0..i {
                let part = l[i][k] * x[k];
                x[i] -= part;
            }
        }
        for i in (0..N).rev() {
            x[i] /= l[i][i];
            for k in i + 1..N {
                let part = l[k][i] * x[k];
                x[i] -= part;
            }
        }
        for i in 0..N {
            inverse[i][c] = x[i];
        }
    }
    for j in 0..N {
        inverse[j][j] = T::select(is_positive, inverse[j][j], reciprocals[j]);
    }
    (inverse, is_positive)
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sum<T: Real>(a: Symmetric<T>, b: Symmetric<T>) -> Symmetric<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}

/// The link's own inertia and that which its children added.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn with_own<T: Real>(link: &Link, state: &LinkArticulation<T>) -> Articulated<T> {
    let own = lit_symmetric(link.inertia);
    let (mass, h) = (T::lit(link.mass), lit(link.moment));
    if link.is_leaf {
        let zero = T::zero();
        return Articulated { j: own, h: skew(h), m: [mass, zero, zero, mass, zero, mass] };
    }
    let mut inertia = Articulated { j: sum(own, state.j), h: state.h, m: state.m };
    inertia.h[0][1] -= h[2];
    inertia.h[0][2] += h[1];
    inertia.h[1][0] += h[2];
    inertia.h[1][2] -= h[0];
    inertia.h[2][0] -= h[1];
    inertia.h[2][1] += h[0];
    inertia.m[0] += mass;
    inertia.m[3] += mass;
    inertia.m[5] += mass;
    inertia
}

/// 𝕀 − Y Uᵀ, one column of each.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn reduce<T: Real>(inertia: &mut Articulated<T>, gain: Pair<T>, column: Pair<T>) {
    let mut i = 0;
    while i < 3 {
        let mut j = 0;
        while j < 3 {
            if i <= j {
                inertia.j[ENTRY[i][j]] -= gain.0[i] * column.0[j];
                inertia.m[ENTRY[i][j]] -= gain.1[i] * column.1[j];
            }
            inertia.h[i][j] -= gain.0[i] * column.1[j];
            j += 1;
        }
        i += 1;
    }
}

/// Xᵀ 𝕀 X: in the parent's axes, about its origin.
///
/// ```text
/// H' = H + [r]× M        J' = J + [r]× H'ᵀ − H [r]×        of the turned H, M, J
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn moved_to_parent<T: Real, R: Turning<T>>(turn: R, r: [T; 3], inertia: &Articulated<T>) -> Articulated<T> {
    let m = turn.symmetric_to_parent(inertia.m);
    let h = turn.matrix_to_parent(inertia.h);
    let mut j = turn.symmetric_to_parent(inertia.j);
    // [r]× M: row by row, r × on the columns of M, which are its rows.
    let columns = [cross(r, [m[0], m[1], m[2]]), cross(r, [m[1], m[3], m[4]]), cross(r, [m[2], m[4], m[5]])];
    let mut moved: Matrix<T> = h;
    let mut i = 0;
    while i < 3 {
        let mut k = 0;
        while k < 3 {
            moved[i][k] += columns[k][i];
            k += 1;
        }
        i += 1;
    }
    // ([r]× H'ᵀ)_ij = (r × row j of H')_i and (H [r]×)_ij = −(r × row i of H)_j.
    let by_moved = [cross(r, moved[0]), cross(r, moved[1]), cross(r, moved[2])];
    let by_old = [cross(r, h[0]), cross(r, h[1]), cross(r, h[2])];
    i = 0;
    while i < 3 {
        let mut k = i;
        while k < 3 {
            j[ENTRY[i][k]] += by_moved[k][i] + by_old[i][k];
            k += 1;
        }
        i += 1;
    }
    Articulated { j, h: moved, m }
}
