//! The mass matrix by composite bodies.
//!
//! ```text
//! M_ij = S_iᵀ 𝕀_j S_j        for i on the way from j to the ground, 𝕀_j of the link of j with all beyond it
//! ```
//!
//! Composite inertias are summed in the axes of the links, so that they keep their digits however long the tree is; forces and
//! freedoms then meet in space axes, where one entry is six products.
//!
//! # References
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, chapter 6.

use piola_numerics::{Kernel, Real, dispatch};

use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_length};
use crate::freedoms::{EIGHT, Eight, is_plain, product, six};
use crate::link::{Articulated, Elementary, Link};
use crate::space::{Runs, add_symmetric, put_place, reference};
use crate::spatial::{add, cross, lit, lit_symmetric, scaled, skew, sub, times, translated_inertia};
use crate::tree::RigidTree;
use crate::turn::Turning;
use crate::workspace::{Composite, LinkForces, LinkInSpace, Rows, TreeWorkspace};

impl RigidTree {
    /// The mass matrix M(q): kinetic energy ½ vᵀ M v, reflected inertias on the diagonal included.
    ///
    /// `out` holds n² entries, (i, j) at `i + j n`; both triangles are written.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`], [`MultibodyError::NotUnitQuaternion`],
    /// [`MultibodyError::OtherWorkspace`].
    ///
    /// # Example
    /// A particle of 2 kg at 0.5 m: m l² = 0.5 kg m².
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    /// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
    /// let tree = builder.build()?;
    /// let mut mass_matrix = [0.0];
    /// tree.mass_matrix(&mut tree.workspace(), &[0.3], &mut mass_matrix)?;
    /// assert_eq!(mass_matrix, [0.5]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[doc(alias("CRBA", "joint-space inertia matrix"))]
    pub fn mass_matrix<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        self.whole_or_upper::<T, true>(work, q, out)
    }

    /// The entries (i, j) of the [mass matrix](Self::mass_matrix) with i ≤ j, at `i + j n`. The others in `out` stay as they were.
    ///
    /// It is all that a factorisation of a symmetric matrix reads. From about a hundred freedoms on it takes a fifth less time, for few no
    /// less.
    ///
    /// # Errors
    /// Those of [`mass_matrix`](Self::mass_matrix).
    pub fn mass_matrix_upper<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        self.whole_or_upper::<T, false>(work, q, out)
    }

    fn whole_or_upper<T: Real, const LOWER: bool>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms;
        self.check_workspace(work)?;
        check_length("q", self.coordinates, q.len())?;
        check_length("out", n * n, out.len())?;
        dispatch(MassMatrix::<_, LOWER> { tree: self, work, q, out: &mut *out });
        // A number that is not finite reaches the diagonal.
        if all_finite(q) && out.iter().step_by(n + 1).all(|x| all_finite(&[*x])) && self.has_unit_quaternions(q) {
            return Ok(());
        }
        self.explain(q, [("q", q), ("q", q)], ("out", out))
    }
}

/// The mass matrix as a kernel, with the entries below the diagonal or without.
struct MassMatrix<'a, T, const LOWER: bool> {
    tree: &'a RigidTree,
    work: &'a mut TreeWorkspace<T>,
    q: &'a [T],
    out: &'a mut [T],
}

impl<T: Real, const LOWER: bool> Kernel for MassMatrix<'_, T, LOWER> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        fill(self.tree, self.work, self.q, self.out, LOWER);
    }
}

/// The mass matrix without checks, its entries below the diagonal where they are wanted.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn fill<T: Real>(tree: &RigidTree, work: &mut TreeWorkspace<T>, q: &[T], out: &mut [T], lower: bool) {
    let TreeWorkspace { space, composite, forces, turns, motions, .. } = work;
    if is_plain::<T>() {
        sines_and_cosines(q, turns);
    }
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, begin::<T>(link, i + 1, q, turns, space, forces, motions, composite));
    }
    let reference = reference(space);
    if tree.links.iter().any(|link| link.run != 1) {
        let n = tree.freedoms;
        for j in 0..n {
            out[j * n..][..if lower { n } else { j }].fill(T::zero());
        }
    }
    for (i, link) in tree.links.iter().enumerate().rev() {
        for_kind!(link.kind, end::<T>(tree, link, i + 1, space, forces, composite, reference, motions, out, lower));
    }
}

/// The columns and rows of a link, which adds its composite inertia to its parent's.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::too_many_arguments, reason = "the parts of a workspace")]
fn end<T: Real, E: Elementary<T, N>, const N: usize>(
    tree: &RigidTree,
    link: &Link,
    state: usize,
    space: &[LinkInSpace<T>],
    forces: &[LinkForces<T>],
    composite: &mut [Composite<T>],
    reference: [T; 3],
    motions: &[[T; 6]],
    out: &mut [T],
    lower: bool,
) {
    entries::<T, E, N>(tree, link, state, state, space, composite, reference, motions, out, lower);
    add_to_parent::<T, E, N>(tree, link, state, forces, composite);
}

/// The entries of a link with the freedoms from the link `from` to the ground, which is this one or nearer to the ground.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::too_many_arguments, reason = "the parts of a workspace")]
pub(crate) fn entries<T: Real, E: Elementary<T, N>, const N: usize>(
    tree: &RigidTree,
    link: &Link,
    state: usize,
    from: usize,
    space: &[LinkInSpace<T>],
    composite: &[Composite<T>],
    reference: [T; 3],
    motions: &[[T; 6]],
    out: &mut [T],
    lower: bool,
) {
    let (n, zero, here, beyond) = (tree.freedoms, T::zero(), &space[state], &composite[state]);
    let m = [beyond.mass, zero, zero, beyond.mass, zero, beyond.mass];
    let columns = E::columns(link, &Articulated { j: beyond.inertia, h: skew(beyond.moment), m });
    let arm = sub(here.origin, reference);
    let mut k = 0;
    while k < N {
        let (j, force) = (link.v + k, times(here.axes, columns[k].1));
        let felt = six((add(times(here.axes, columns[k].0), cross(arm, force)), force));
        join(tree, from, j, motions, &felt, out, lower);
        if from == state {
            out[j * n + j] += T::lit(tree.armature[j]);
        }
        k += 1;
    }
}

/// The entries of freedom j, which feels 𝕀 S_j, with those from a link to the ground, in its column and, for the lower
/// triangle, its row. Freedoms of the same joint beyond j are left to their own columns.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn join<T: Real>(
    tree: &RigidTree,
    from: usize,
    j: usize,
    s: &[[T; 6]],
    felt: &[T; 6],
    out: &mut [T],
    lower: bool,
) {
    let n = tree.freedoms;
    for (first, end) in Runs::of(tree, from) {
        for i in first..end.min(j + 1) {
            let entry = product(&s[i], felt);
            out[j * n + i] = entry;
            if lower {
                out[i * n + j] = entry;
            }
        }
    }
}

/// Of all coordinates, so that no angle is taken alone.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sines_and_cosines<T: Real>(q: &[T], turns: &mut [Eight<T, 2>]) {
    for (turns, q) in turns.iter_mut().zip(q.chunks(EIGHT)) {
        let mut eight = [T::zero(); EIGHT];
        for (angle, &q) in eight.iter_mut().zip(q) {
            *angle = q;
        }
        turns.0 = T::sin_cos_of_eight(eight).into();
    }
}

/// The place of a link, its freedoms about the reference point, its own inertia.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::too_many_arguments, reason = "the parts of a workspace")]
fn begin<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    q: &[T],
    turns: &[Eight<T, 2>],
    space: &mut [LinkInSpace<T>],
    forces: &mut [LinkForces<T>],
    motions: &mut [[T; 6]],
    composite: &mut [Composite<T>],
) {
    let turned = if is_plain::<T>() {
        let ([sines, cosines], k) = (&turns[link.q / EIGHT].0, link.q % EIGHT);
        E::place_by(link, q, (sines[k], cosines[k]))
    } else {
        E::place(link, q)
    };
    place_at::<T, E, N>(link, state, turned, space, forces);
    // The first link, whose origin it is, is there.
    let reference = reference(space);
    put_motions::<T, E, N>(link, &space[state], reference, motions);
    // Those with children are written when the first of these is met.
    if link.is_leaf {
        let own = &mut composite[state];
        own.mass = T::lit(link.mass);
        own.moment = lit(link.moment);
        own.inertia = lit_symmetric(link.inertia);
    }
}

/// S of a link in space about the reference point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn put_motions<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    here: &LinkInSpace<T>,
    reference: [T; 3],
    motions: &mut [[T; 6]],
) {
    let arm = sub(here.origin, reference);
    let columns = E::turned_subspace(link, here.axes);
    let mut k = 0;
    while k < N {
        let (angular, linear) = columns[k];
        motions[link.v + k] = six((angular, add(linear, cross(arm, angular))));
        k += 1;
    }
}

/// Places a link in space and keeps its turn.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn place<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    q: &[T],
    space: &mut [LinkInSpace<T>],
    forces: &mut [LinkForces<T>],
) {
    place_at::<T, E, N>(link, state, E::place(link, q), space, forces);
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn place_at<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    (turn, origin): (E::Turn, [T; 3]),
    space: &mut [LinkInSpace<T>],
    forces: &mut [LinkForces<T>],
) {
    turn.keep(&mut forces[state].turn);
    forces[state].origin = origin;
    put_place(link, state, (turn, origin), space);
}

/// Adds the composite inertia of a link to its parent's, which begins with its own where this is the first child met.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add_to_parent<T: Real, E: Elementary<T, N>, const N: usize>(
    tree: &RigidTree,
    link: &Link,
    state: usize,
    forces: &[LinkForces<T>],
    composite: &mut [Composite<T>],
) {
    if link.parent != 0 {
        let (turn, origin) = (E::Turn::recall(&forces[state].turn), forces[state].origin);
        let own = &composite[state];
        let h = turn.to_parent(own.moment);
        let turned = turn.symmetric_to_parent(own.inertia);
        let mass = own.mass;
        let parent = &mut composite[link.parent];
        let (mut sum, mut moment, mut inertia) = (parent.mass, parent.moment, parent.inertia);
        if link.is_first_met {
            let parent = &tree.links[link.parent - 1];
            (sum, moment, inertia) = (T::lit(parent.mass), lit(parent.moment), lit_symmetric(parent.inertia));
        }
        parent.mass = sum + mass;
        parent.moment = add(moment, add(h, scaled(mass, origin)));
        parent.inertia = add_symmetric(inertia, add_symmetric(turned, translated_inertia(mass, h, origin)));
    }
}

/// Writes the products of the freedoms' vectors from `first` with (moment, force).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn dots<T: Real>(rows: &Rows<T>, row: usize, first: usize, moment: [T; 3], force: [T; 3], out: &mut [T]) {
    let count = out.len();
    let of = |k: usize| &rows.row(row + k)[first..first + count];
    let (x, y, z) = (of(0), of(1), of(2));
    let (u, v, w) = (of(3), of(4), of(5));
    for i in 0..count {
        out[i] = (x[i] * moment[0] + y[i] * moment[1] + z[i] * moment[2])
            + (u[i] * force[0] + v[i] * force[1] + w[i] * force[2]);
    }
}
