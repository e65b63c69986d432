//! Links: bodies each behind one elementary joint, as the passes visit them.
//!
//! An elementary joint turns the child by R, puts its origin to r, and moves it by S q̇:
//!
//! ```text
//! ω' = Rᵀ ω + S_ω q̇                          angular velocity, child's axes
//! α' = Rᵀ α + Rᵀω × S_ω q̇ + S_ω q̈
//! a' = Rᵀ (a + ([α]× + [ω]×²) r) + (Rᵀω + ω') × S_v q̇ + S_v q̈        of the origin
//! ```
//!
//! S is constant in the child's axes. The passes are generic over [`Elementary`], so that a joint about a coordinate axis
//! multiplies no matrices.

use piola_numerics::Real;

use crate::spatial::{Matrix, Symmetric, Vector, add, symmetric_times, times, transposed_times};
use crate::turn::Turning;

/// Which elementary joint a link has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    RevoluteX,
    RevoluteY,
    RevoluteZ,
    /// About z, after a constant turn.
    RevoluteTurned,
    /// Along `axis`; the child keeps the parent's axes.
    Prismatic,
    /// About and along z, after a constant turn.
    Helical,
    Spherical,
    Free,
}

impl Kind {
    /// Components of q.
    pub(crate) const fn coordinates(self) -> usize {
        match self {
            Self::Spherical => 4,
            Self::Free => 7,
            _ => 1,
        }
    }
    /// Components of v.
    pub(crate) const fn freedoms(self) -> usize {
        match self {
            Self::Spherical => 3,
            Self::Free => 6,
            _ => 1,
        }
    }
}

/// A body behind one elementary joint. States of links have the ground at index 0, so `parent` counts from it.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) kind: Kind,
    /// No child.
    pub(crate) is_leaf: bool,
    /// The last child of its parent: a pass from the tips meets it first.
    pub(crate) is_first_met: bool,
    pub(crate) parent: usize,
    /// The first component of q and of v.
    pub(crate) q: usize,
    pub(crate) v: usize,
    /// Where the square matrix of this joint begins among those of all.
    pub(crate) square: usize,
    /// The first link of the unbroken chain of parents and children that ends here.
    pub(crate) run: usize,
    /// The place of the joint in the parent.
    pub(crate) origin: [f64; 3],
    /// The constant turn of the joint in the parent.
    pub(crate) turn: [[f64; 3]; 3],
    /// The axis of a prismatic joint, in the parent's axes.
    pub(crate) axis: [f64; 3],
    /// Metres a radian.
    pub(crate) pitch: f64,
    /// ±1: the sign with which a coordinate axis is that of the joint.
    pub(crate) sign: f64,
    pub(crate) mass: f64,
    /// Mass times the centre of mass, from the link's origin.
    pub(crate) moment: [f64; 3],
    /// Inertia about the link's origin.
    pub(crate) inertia: [f64; 6],
    /// The joint of the user that it belongs to.
    pub(crate) joint: usize,
}

/// An inertia that acts on the accelerations (α, a) of a link's origin.
///
/// ```text
/// moment = J α + H a        force = Hᵀ α + M a
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct Articulated<T> {
    pub(crate) j: Symmetric<T>,
    pub(crate) h: Matrix<T>,
    pub(crate) m: Symmetric<T>,
}

/// A moment and a force, or an angular and a linear part.
pub(crate) type Pair<T> = (Vector<T>, Vector<T>);

impl<T: Real> Articulated<T> {
    /// The moment and the force of accelerations.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn times(&self, (alpha, a): Pair<T>) -> Pair<T> {
        (
            add(symmetric_times(self.j, alpha), times(self.h, a)),
            add(transposed_times(self.h, alpha), symmetric_times(self.m, a)),
        )
    }
}

/// An elementary joint of N freedoms.
pub(crate) trait Elementary<T: Real, const N: usize> {
    type Turn: Turning<T>;
    /// The turn and the child's origin in the parent's frame.
    fn place(link: &Link, q: &[T]) -> (Self::Turn, Vector<T>);
    /// The same where the sine and the cosine of its first coordinate are there.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place_by(link: &Link, q: &[T], _sine_cosine: (T, T)) -> (Self::Turn, Vector<T>) {
        Self::place(link, q)
    }
    /// Adds S_ω x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_angular(_link: &Link, _x: [T; N], _angular: &mut Vector<T>) {}
    /// Adds S_v x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_linear(_link: &Link, _x: [T; N], _linear: &mut Vector<T>) {}
    /// Adds ω × S_ω q̇ and (ω + ω') × S_v q̇, with ω of the parent in the child's axes and ω' of the child.
    fn add_bias(
        link: &Link,
        w: Vector<T>,
        w_child: Vector<T>,
        rate: [T; N],
        angular: &mut Vector<T>,
        linear: &mut Vector<T>,
    );
    /// Sᵀ (moment, force).
    fn project(link: &Link, moment: Vector<T>, force: Vector<T>) -> [T; N];
    /// The columns of an inertia times S.
    fn columns(link: &Link, inertia: &Articulated<T>) -> [Pair<T>; N];
    /// S column by column, in axes that the rows turn to.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turned_subspace(link: &Link, axes: Matrix<T>) -> [Pair<T>; N] {
        let mut columns = Self::subspace(link);
        let mut k = 0;
        while k < N {
            columns[k] = (times(axes, columns[k].0), times(axes, columns[k].1));
            k += 1;
        }
        columns
    }
    /// S column by column.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn subspace(link: &Link) -> [Pair<T>; N] {
        let mut columns = [([T::zero(); 3], [T::zero(); 3]); N];
        let mut k = 0;
        while k < N {
            let mut unit = [T::zero(); N];
            unit[k] = T::one();
            Self::add_angular(link, unit, &mut columns[k].0);
            Self::add_linear(link, unit, &mut columns[k].1);
            k += 1;
        }
        columns
    }
}

/// The components of a slice that belong to a joint.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn take<T: Real, const N: usize>(x: &[T], from: usize) -> [T; N] {
    let mut out = [T::zero(); N];
    out.copy_from_slice(&x[from..from + N]);
    out
}
