//! Turns of a child's axes against its parent's: about a coordinate axis, any, or none.

use piola_numerics::Real;

use crate::spatial::{ENTRY, Matrix, Symmetric, Vector, add, cross, product, symmetric_times, times, transposed_times};

/// A rotation R that takes components in the child's axes to components in the parent's.
pub(crate) trait Turning<T: Real>: Copy {
    /// R v.
    fn to_parent(self, v: Vector<T>) -> Vector<T>;
    /// Rᵀ v.
    fn to_child(self, v: Vector<T>) -> Vector<T>;
    /// R A Rᵀ.
    fn symmetric_to_parent(self, a: Symmetric<T>) -> Symmetric<T>;
    /// R A Rᵀ.
    fn matrix_to_parent(self, a: Matrix<T>) -> Matrix<T>;
    /// P R: the child's axes in space from the parent's.
    fn after(self, parent: Matrix<T>) -> Matrix<T>;
    /// Writes what [`recall`](Self::recall) needs.
    fn keep(self, slot: &mut Matrix<T>);
    /// The turn that was kept.
    fn recall(slot: &Matrix<T>) -> Self;
}

/// A moment and a force about the child's origin, in the parent's axes about the parent's origin.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn wrench_to_parent<T: Real, R: Turning<T>>(
    turn: R,
    origin: Vector<T>,
    (moment, force): (Vector<T>, Vector<T>),
) -> (Vector<T>, Vector<T>) {
    let force = turn.to_parent(force);
    (add(turn.to_parent(moment), cross(origin, force)), force)
}

/// A turn about coordinate axis A: the angle's cosine and sine.
#[derive(Clone, Copy)]
pub(crate) struct About<T, const A: usize> {
    pub(crate) cosine: T,
    pub(crate) sine: T,
}

impl<T: Real, const A: usize> About<T, A> {
    const I: usize = (A + 1) % 3;
    const J: usize = (A + 2) % 3;
}

impl<T: Real, const A: usize> Turning<T> for About<T, A> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_parent(self, v: Vector<T>) -> Vector<T> {
        let mut out = v;
        out[Self::I] = self.cosine * v[Self::I] - self.sine * v[Self::J];
        out[Self::J] = self.sine * v[Self::I] + self.cosine * v[Self::J];
        out
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_child(self, v: Vector<T>) -> Vector<T> {
        let mut out = v;
        out[Self::I] = self.cosine * v[Self::I] + self.sine * v[Self::J];
        out[Self::J] = self.cosine * v[Self::J] - self.sine * v[Self::I];
        out
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn symmetric_to_parent(self, a: Symmetric<T>) -> Symmetric<T> {
        let (s, c) = (self.sine, self.cosine);
        let (ii, jj, ij) = (ENTRY[Self::I][Self::I], ENTRY[Self::J][Self::J], ENTRY[Self::I][Self::J]);
        let (ia, ja) = (ENTRY[Self::I][A], ENTRY[Self::J][A]);
        // y = s (a_ii − a_jj) + 2 c a_ij
        let y = s * (a[ii] - a[jj]) + (c + c) * a[ij];
        let mut out = a;
        out[ii] = a[ii] - s * y;
        out[jj] = a[jj] + s * y;
        out[ij] = c * y - a[ij];
        out[ia] = c * a[ia] - s * a[ja];
        out[ja] = s * a[ia] + c * a[ja];
        out
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn matrix_to_parent(self, a: Matrix<T>) -> Matrix<T> {
        let (s, c) = (self.sine, self.cosine);
        let mut out = a;
        let mut k = 0;
        while k < 3 {
            out[k] = self.to_parent(a[k]);
            k += 1;
        }
        let (upper, lower) = (out[Self::I], out[Self::J]);
        k = 0;
        while k < 3 {
            out[Self::I][k] = c * upper[k] - s * lower[k];
            out[Self::J][k] = s * upper[k] + c * lower[k];
            k += 1;
        }
        out
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn after(self, parent: Matrix<T>) -> Matrix<T> {
        let mut out = parent;
        let mut k = 0;
        while k < 3 {
            out[k] = self.to_child(parent[k]);
            k += 1;
        }
        out
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(self, slot: &mut Matrix<T>) {
        slot[0][0] = self.cosine;
        slot[0][1] = self.sine;
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn recall(slot: &Matrix<T>) -> Self {
        Self { cosine: slot[0][0], sine: slot[0][1] }
    }
}

/// Any turn: the rows of R.
#[derive(Clone, Copy)]
pub(crate) struct AnyTurn<T>(pub(crate) Matrix<T>);

impl<T: Real> Turning<T> for AnyTurn<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_parent(self, v: Vector<T>) -> Vector<T> {
        times(self.0, v)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_child(self, v: Vector<T>) -> Vector<T> {
        transposed_times(self.0, v)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn symmetric_to_parent(self, a: Symmetric<T>) -> Symmetric<T> {
        let r = self.0;
        let half = [symmetric_times(a, r[0]), symmetric_times(a, r[1]), symmetric_times(a, r[2])];
        let entry = |i: usize, j: usize| r[i][0] * half[j][0] + r[i][1] * half[j][1] + r[i][2] * half[j][2];
        [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn matrix_to_parent(self, a: Matrix<T>) -> Matrix<T> {
        let half = product(self.0, a);
        [times(self.0, half[0]), times(self.0, half[1]), times(self.0, half[2])]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn after(self, parent: Matrix<T>) -> Matrix<T> {
        product(parent, self.0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(self, slot: &mut Matrix<T>) {
        *slot = self.0;
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn recall(slot: &Matrix<T>) -> Self {
        Self(*slot)
    }
}

/// No turn.
#[derive(Clone, Copy)]
pub(crate) struct NoTurn;

impl<T: Real> Turning<T> for NoTurn {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_parent(self, v: Vector<T>) -> Vector<T> {
        v
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_child(self, v: Vector<T>) -> Vector<T> {
        v
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn symmetric_to_parent(self, a: Symmetric<T>) -> Symmetric<T> {
        a
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn matrix_to_parent(self, a: Matrix<T>) -> Matrix<T> {
        a
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn after(self, parent: Matrix<T>) -> Matrix<T> {
        parent
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(self, _slot: &mut Matrix<T>) {}
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn recall(_slot: &Matrix<T>) -> Self {
        Self
    }
}
