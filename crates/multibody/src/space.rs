//! Links in space axes: places, velocities, accelerations, and the vectors of the freedoms about one reference point.
//!
//! The reference point is the origin of the first link, so that a tree far from the origin of space loses no digits.

use piola_numerics::Real;

use crate::elementary::for_kind;
use crate::link::{Elementary, Link, Pair, take};
use crate::spatial::{
    Symmetric, Vector, add, cross, lit, lit_symmetric, scaled, sub, symmetric_times, times, translated_inertia,
};
use crate::tree::RigidTree;
use crate::turn::{AnyTurn, Turning};
use crate::workspace::{Composite, LinkInSpace, Rows};

/// Rows of the freedoms' vectors in [`Rows`], angular part before linear part, about the reference point.
pub(crate) const SUBSPACE: usize = 0;
/// Ṡ.
pub(crate) const RATE: usize = 6;

/// m × n of two motions.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn motion_cross<T: Real>(m: Pair<T>, n: Pair<T>) -> Pair<T> {
    (cross(m.0, n.0), add(cross(m.0, n.1), cross(m.1, n.0)))
}

/// m ×* f of a motion and a moment with its force.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn force_cross<T: Real>(m: Pair<T>, f: Pair<T>) -> Pair<T> {
    (add(cross(m.0, f.0), cross(m.1, f.1)), cross(m.0, f.1))
}

/// The sum of two pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add_pairs<T: Real>(a: Pair<T>, b: Pair<T>) -> Pair<T> {
    (add(a.0, b.0), add(a.1, b.1))
}

/// (angular momentum, momentum) of a motion under mass, first moment and inertia about one point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn momentum<T: Real>(mass: T, h: Vector<T>, inertia: Symmetric<T>, (w, v): Pair<T>) -> Pair<T> {
    (add(symmetric_times(inertia, w), cross(h, v)), add(scaled(mass, v), cross(w, h)))
}

/// Axes and origins of all links.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_places<T: Real>(tree: &RigidTree, states: &mut [LinkInSpace<T>], q: &[T]) {
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, place::<T>(link, i + 1, states, q));
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn place<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkInSpace<T>],
    q: &[T],
) {
    put_place(link, state, E::place(link, q), states);
}

/// Writes axes and origin of a link behind a turn and an origin in its parent.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn put_place<T: Real, R: Turning<T>>(
    link: &Link,
    state: usize,
    (turn, origin): (R, Vector<T>),
    states: &mut [LinkInSpace<T>],
) {
    let parent = &states[link.parent];
    let (axes, origin) = (turn.after(parent.axes), add(parent.origin, times(parent.axes, origin)));
    states[state].axes = axes;
    states[state].origin = origin;
}

/// Angular velocities and velocities of origins; places must be there.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_velocities<T: Real>(tree: &RigidTree, states: &mut [LinkInSpace<T>], v: &[T]) {
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, velocities::<T>(link, i + 1, states, v));
    }
}

/// The motion that a joint gives its child, at the child's origin, in space axes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn relative<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    child: &LinkInSpace<T>,
    rate: [T; N],
) -> Pair<T> {
    let (mut angular, mut linear) = ([T::zero(); 3], [T::zero(); 3]);
    E::add_angular(link, rate, &mut angular);
    E::add_linear(link, rate, &mut linear);
    (times(child.axes, angular), times(child.axes, linear))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn velocities<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkInSpace<T>],
    v: &[T],
) {
    let (parent, child) = (states[link.parent], &mut states[state]);
    let relative = relative::<T, E, N>(link, child, take::<T, N>(v, link.v));
    let arm = sub(child.origin, parent.origin);
    child.w = add(parent.w, relative.0);
    child.velocity = add(add(parent.velocity, cross(parent.w, arm)), relative.1);
}

/// Angular accelerations and accelerations of origins; velocities must be there.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_accelerations<T: Real>(tree: &RigidTree, states: &mut [LinkInSpace<T>], v: &[T], a: &[T]) {
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, accelerations::<T>(link, i + 1, states, v, a));
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn accelerations<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkInSpace<T>],
    v: &[T],
    a: &[T],
) {
    let (parent, child) = (states[link.parent], &mut states[state]);
    let rate = relative::<T, E, N>(link, child, take::<T, N>(v, link.v));
    let second = relative::<T, E, N>(link, child, take::<T, N>(a, link.v));
    let arm = sub(child.origin, parent.origin);
    child.alpha = add(add(parent.alpha, cross(parent.w, rate.0)), second.0);
    let carried = add(cross(parent.alpha, arm), cross(parent.w, cross(parent.w, arm)));
    let own = add(cross(add(parent.w, child.w), rate.1), second.1);
    child.acceleration = add(parent.acceleration, add(carried, own));
}

/// S of all freedoms about the reference point; places must be there.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_subspaces<T: Real>(tree: &RigidTree, states: &[LinkInSpace<T>], rows: &mut Rows<T>) {
    let reference = reference(states);
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, subspaces::<T>(link, &states[i + 1], reference, rows));
    }
}

/// The reference point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn reference<T: Real>(states: &[LinkInSpace<T>]) -> Vector<T> {
    let first = states[states.len().min(2) - 1].origin;
    [first[0].frozen(), first[1].frozen(), first[2].frozen()]
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn subspaces<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: &LinkInSpace<T>,
    reference: Vector<T>,
    rows: &mut Rows<T>,
) {
    let arm = sub(state.origin, reference);
    let columns = E::turned_subspace(link, state.axes);
    let mut k = 0;
    while k < N {
        let angular = columns[k].0;
        let linear = add(columns[k].1, cross(arm, angular));
        rows.put(SUBSPACE, link.v + k, angular);
        rows.put(SUBSPACE + 3, link.v + k, linear);
        k += 1;
    }
}

/// A vector of a freedom with its linear part.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn row_pair<T: Real>(rows: &Rows<T>, row: usize, freedom: usize) -> Pair<T> {
    (rows.get(row, freedom), rows.get(row + 3, freedom))
}

/// Writes a vector of a freedom with its linear part.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn put_pair<T: Real>(rows: &mut Rows<T>, row: usize, freedom: usize, pair: Pair<T>) {
    rows.put(row, freedom, pair.0);
    rows.put(row + 3, freedom, pair.1);
}

/// The velocity of the reference point as a part of the link, with the angular velocity.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn motion_at<T: Real>(state: &LinkInSpace<T>, reference: Vector<T>) -> Pair<T> {
    (state.w, add(state.velocity, cross(sub(state.origin, reference), state.w)))
}

/// Mass, first moment and inertia of each link about the reference point, in space axes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn own_inertia<T: Real>(link: &Link, state: &LinkInSpace<T>, reference: Vector<T>, out: &mut Composite<T>) {
    let mass = T::lit(link.mass);
    let h = times(state.axes, lit(link.moment));
    let arm = sub(state.origin, reference);
    let turned = AnyTurn(state.axes).symmetric_to_parent(lit_symmetric(link.inertia));
    let shift = translated_inertia(mass, h, arm);
    out.mass = mass;
    out.moment = add(h, scaled(mass, arm));
    out.inertia = add_symmetric(turned, shift);
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add_symmetric<T: Real>(a: Symmetric<T>, b: Symmetric<T>) -> Symmetric<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}

/// Adds mass, moment and inertia of a link to its parent's.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add_inertia<T: Real>(parent: &mut Composite<T>, child: &Composite<T>) {
    parent.mass += child.mass;
    parent.moment = add(parent.moment, child.moment);
    parent.inertia = add_symmetric(parent.inertia, child.inertia);
}

/// The runs of freedoms that move a link: [first, end) of each, from the link to the ground.
///
/// `link` is the index of the link, not of its state.
pub(crate) struct Runs<'a> {
    tree: &'a RigidTree,
    state: usize,
}

impl<'a> Runs<'a> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of(tree: &'a RigidTree, state: usize) -> Self {
        Self { tree, state }
    }
}

impl Iterator for Runs<'_> {
    type Item = (usize, usize);
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn next(&mut self) -> Option<(usize, usize)> {
        if self.state == 0 {
            return None;
        }
        let last = &self.tree.links[self.state - 1];
        let first = &self.tree.links[last.run - 1];
        self.state = first.parent;
        Some((first.v, last.v + last.kind.freedoms()))
    }
}
