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
use crate::link::{Articulated, Elementary, Link};
use crate::space::{Runs, SUBSPACE, add_symmetric, reference, subspaces};
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
        let n = self.freedoms;
        self.check_workspace(work)?;
        check_length("q", self.coordinates, q.len())?;
        check_length("out", n * n, out.len())?;
        dispatch(MassMatrix { tree: self, work, q, out: &mut *out });
        // A number that is not finite reaches the diagonal.
        if all_finite(q) && out.iter().step_by(n + 1).all(|x| all_finite(&[*x])) && self.has_unit_quaternions(q) {
            return Ok(());
        }
        self.explain(q, [("q", q), ("q", q)], ("out", out))
    }
}

/// The mass matrix as a kernel.
struct MassMatrix<'a, T> {
    tree: &'a RigidTree,
    work: &'a mut TreeWorkspace<T>,
    q: &'a [T],
    out: &'a mut [T],
}

impl<T: Real> Kernel for MassMatrix<'_, T> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        fill(self.tree, self.work, self.q, self.out);
    }
}

/// The mass matrix without checks.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn fill<T: Real>(tree: &RigidTree, work: &mut TreeWorkspace<T>, q: &[T], out: &mut [T]) {
    let TreeWorkspace { space, rows, composite, forces, .. } = work;
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, begin::<T>(link, i + 1, q, space, forces, rows, composite));
    }
    if tree.links.iter().any(|link| link.run != 1) {
        out.fill(T::zero());
    }
    let reference = reference(space);
    for (i, link) in tree.links.iter().enumerate().rev() {
        for_kind!(link.kind, end::<T>(tree, link, i + 1, space, forces, composite, reference, rows, out));
    }
    mirror(tree.freedoms, out);
}

/// The place of a link, its freedoms about the reference point, its own inertia.
#[cfg_attr(not(debug_assertions), inline(always))]
fn begin<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    q: &[T],
    space: &mut [LinkInSpace<T>],
    forces: &mut [LinkForces<T>],
    rows: &mut Rows<T>,
    composite: &mut [Composite<T>],
) {
    place::<T, E, N>(link, state, q, space, forces);
    // The first link, whose origin it is, is there.
    let reference = reference(space);
    subspaces::<T, E, N>(link, &space[state], reference, rows);
    let own = &mut composite[state];
    own.mass = T::lit(link.mass);
    own.moment = lit(link.moment);
    own.inertia = lit_symmetric(link.inertia);
}

/// The columns of a link, which adds its composite inertia to its parent's.
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
    rows: &Rows<T>,
    out: &mut [T],
) {
    column::<T, E, N>(tree, link, state, state, space, composite, reference, rows, out);
    add_to_parent::<T, E, N>(link, state, forces, composite);
}

/// Columns whose entries are copied to rows at once: a line of the cache of doubles.
const BLOCK: usize = 8;

/// Copies the entries (i, j), i < j, to (j, i): a block of columns at a time, so that each line of memory is written once.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mirror<T: Real>(n: usize, out: &mut [T]) {
    let mut first = 0;
    while first < n {
        let end = (first + BLOCK).min(n);
        for i in 0..end {
            for j in first.max(i + 1)..end {
                out[i * n + j] = out[j * n + i];
            }
        }
        first = end;
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
    let (turn, origin) = E::place(link, q);
    turn.keep(&mut forces[state].turn);
    forces[state].origin = origin;
    let parent = &space[link.parent];
    let (axes, place) = (turn.after(parent.axes), add(parent.origin, times(parent.axes, origin)));
    space[state].axes = axes;
    space[state].origin = place;
}

/// The columns of a link: the entries of the freedoms from the link `from`, which is this one or nearer to the ground.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::too_many_arguments, reason = "the parts of a workspace")]
pub(crate) fn column<T: Real, E: Elementary<T, N>, const N: usize>(
    tree: &RigidTree,
    link: &Link,
    state: usize,
    from: usize,
    space: &[LinkInSpace<T>],
    composite: &[Composite<T>],
    reference: [T; 3],
    rows: &Rows<T>,
    out: &mut [T],
) {
    let n = tree.freedoms;
    let own = &composite[state];
    let zero = T::zero();
    let inertia =
        Articulated { j: own.inertia, h: skew(own.moment), m: [own.mass, zero, zero, own.mass, zero, own.mass] };
    let columns = E::columns(link, &inertia);
    let here = &space[state];
    let arm = sub(here.origin, reference);
    let mut k = 0;
    while k < N {
        let force = times(here.axes, columns[k].1);
        let moment = add(times(here.axes, columns[k].0), cross(arm, force));
        let j = link.v + k;
        // Freedoms of the same joint beyond this one are left to their own columns.
        for (first, end) in Runs::of(tree, from) {
            let end = end.min(j + 1);
            let column = &mut out[j * n + first..j * n + end];
            dots(rows, SUBSPACE, first, moment, force, column);
        }
        if from == state {
            out[j * n + j] += T::lit(tree.armature[j]);
        }
        k += 1;
    }
}

/// Copies the columns of a link to their rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn rows_of_columns<T: Real>(tree: &RigidTree, link: &Link, from: usize, out: &mut [T]) {
    let n = tree.freedoms;
    for j in link.v..link.v + link.kind.freedoms() {
        for (first, end) in Runs::of(tree, from) {
            for i in first..end.min(j) {
                out[i * n + j] = out[j * n + i];
            }
        }
    }
}

/// Adds the composite inertia of a link to its parent's.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add_to_parent<T: Real, E: Elementary<T, N>, const N: usize>(
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
        parent.mass += mass;
        parent.moment = add(parent.moment, add(h, scaled(mass, origin)));
        parent.inertia = add_symmetric(parent.inertia, add_symmetric(turned, translated_inertia(mass, h, origin)));
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
