//! Inverse and forward dynamics that follow what joints change.
//!
//! ```text
//! place of a link in its parent      changes with its own q
//! motion, and what it needs          with q, v (and v̇ of inverse dynamics) from the ground to it
//! articulated inertia, D, Y          with q beyond it
//! forces that it passes on           with all that its motion and those beyond it change, and with τ there
//! acceleration under forces          with the forces of the whole tree that hangs on one joint of the ground
//! ```
//!
//! The sums run in the same order as those of the plain passes, so that the results are the same numbers.

use piola_numerics::{Mask, Real};

use super::DynamicsCounts;
use super::changes::Changes;
use crate::articulation::with_own;
use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_length};
use crate::forward_dynamics::{
    accelerations, articulate, felt as felt_forward, outwards_again as again_forward, recall, receive, to_parent,
};
use crate::inverse_dynamics::{felt as felt_inverse, outwards_again as again_inverse};
use crate::link::{Articulated, Elementary, Link, Pair};
use crate::space::add_pairs;
use crate::spatial::lit;
use crate::tree::RigidTree;
use crate::workspace::{LinkArticulation, TreeWorkspace};

/// Inverse and forward dynamics that compute again only what the arguments changed since the last call.
///
/// Each of the two keeps its own results. It pays where few links change in a tree with branches, or where q stays: then forward
/// dynamics keeps all articulated inertias. [`counts`](Self::counts) says what was computed. Where everything changes, a call costs
/// somewhat more than [`RigidTree::inverse_dynamics`] and [`RigidTree::forward_dynamics`]: see the page of measurements.
///
/// The places of links in space are no part of the dynamics; [`KeptMassMatrix`](crate::KeptMassMatrix) keeps them.
///
/// # Accuracy
/// The numbers of the plain calls, all their digits; a zero may have the other sign, because 0 and −0 count as equal arguments.
///
/// # Example
/// Two pendulums on the ground: when one moves, the other is left alone.
/// ```
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, KeptDynamics, RigidTree, TreeJoint};
/// let y = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
/// let bob = BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?;
/// let mut builder = RigidTree::builder();
/// builder.attach(BodyIndex::GROUND, TreeJoint::new("left", y), "left bob", bob)?;
/// builder.attach(BodyIndex::GROUND, TreeJoint::new("right", y).at([1.0, 0.0, 0.0]), "right bob", bob)?;
/// let tree = builder.build()?;
/// let mut kept = KeptDynamics::new(&tree);
/// kept.inverse_dynamics(&[0.3, 0.0], &[0.0; 2], &[0.0; 2])?;
/// // The left one goes to the horizontal: m g l = 9.81 N m.
/// assert_eq!(kept.inverse_dynamics(&[0.0, 0.0], &[0.0; 2], &[0.0; 2])?, [-9.81, -9.81]);
/// assert_eq!((kept.counts().motions, kept.counts().forces), (1, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("cache", "incremental"))]
#[derive(Clone, Debug)]
pub struct KeptDynamics<'a, T = f64> {
    tree: &'a RigidTree,
    work: TreeWorkspace<T>,
    inverse: Half<T>,
    forward: Half<T>,
    /// D⁻¹ u of each freedom.
    efforts: Vec<T>,
    /// What each link adds to the inertia of its parent.
    inertias: Vec<Articulated<T>>,
    counts: DynamicsCounts,
}

/// What inverse or forward dynamics keeps, besides the states of the workspace.
#[derive(Clone, Debug)]
struct Half<T> {
    changes: Changes<T>,
    /// The moment and force that each link needs for itself.
    own: Vec<Pair<T>>,
    /// Those that its parent feels.
    felt: Vec<Pair<T>>,
    /// τ or v̇.
    out: Vec<T>,
}

impl<T: Real> Half<T> {
    fn of(tree: &RigidTree) -> Self {
        let pairs = vec![([T::zero(); 3], [T::zero(); 3]); tree.links.len() + 1];
        let changes = Changes::of(tree);
        Self { changes, own: pairs.clone(), felt: pairs, out: vec![T::zero(); tree.freedoms] }
    }
}

impl<'a, T: Real> KeptDynamics<'a, T> {
    /// Memory for a tree; nothing is computed yet.
    #[must_use]
    pub fn new(tree: &'a RigidTree) -> Self {
        let (zero, square) = ([T::zero(); 6], [[T::zero(); 3]; 3]);
        Self {
            tree,
            work: tree.workspace(),
            inverse: Half::of(tree),
            forward: Half::of(tree),
            efforts: vec![T::zero(); tree.freedoms],
            inertias: vec![Articulated { j: zero, h: square, m: zero }; tree.links.len() + 1],
            counts: DynamicsCounts::default(),
        }
    }

    /// The forces τ of [`RigidTree::inverse_dynamics`]. The first call computes all.
    ///
    /// # Errors
    /// As [`RigidTree::inverse_dynamics`]. After an error of the values nothing is kept: the next call computes all.
    pub fn inverse_dynamics(&mut self, q: &[T], v: &[T], a: &[T]) -> Result<&[T], MultibodyError> {
        let tree = self.tree;
        tree.check_state(&self.work, q, v)?;
        check_length("a", tree.freedoms, a.len())?;
        self.inverse.changes.compare(tree, [q, v, a], true);
        self.inverse.changes.is_there = false;
        self.follow_inverse(q, v, a);
        if !(all_finite(&self.inverse.out) && tree.has_unit_quaternions(q)) {
            tree.explain(q, [("v", v), ("a", a)], ("tau", &self.inverse.out))?;
        }
        self.inverse.changes.is_there = true;
        Ok(&self.inverse.out)
    }

    /// The accelerations v̇ of [`RigidTree::forward_dynamics`]. The first call computes all.
    ///
    /// # Errors
    /// As [`RigidTree::forward_dynamics`]. After an error of the values nothing is kept: the next call computes all.
    pub fn forward_dynamics(&mut self, q: &[T], v: &[T], tau: &[T]) -> Result<&[T], MultibodyError> {
        let tree = self.tree;
        tree.check_state(&self.work, q, v)?;
        check_length("tau", tree.freedoms, tau.len())?;
        self.forward.changes.compare(tree, [q, v, tau], false);
        self.forward.changes.is_there = false;
        let is_positive = self.follow_forward(q, v, tau);
        if !(is_positive && all_finite(&self.forward.out) && tree.has_unit_quaternions(q)) {
            tree.explain(q, [("v", v), ("tau", tau)], ("out", &[]))?;
            tree.explain_inertia(&self.work)?;
            tree.explain(q, [("v", v), ("tau", tau)], ("out", &self.forward.out))?;
        }
        self.forward.changes.is_there = true;
        Ok(&self.forward.out)
    }

    /// How much the last call computed.
    #[must_use]
    pub const fn counts(&self) -> DynamicsCounts {
        self.counts
    }

    fn follow_inverse(&mut self, q: &[T], v: &[T], a: &[T]) {
        let Self { tree, work, inverse, counts, .. } = self;
        let Half { changes, own, felt, out } = inverse;
        let (states, links) = (&mut work.forces, &changes.links);
        *counts = DynamicsCounts { links: tree.links.len(), ..DynamicsCounts::default() };
        states[0].a = lit(tree.gravity.map(|g| -g));
        for (i, link) in tree.links.iter().enumerate() {
            if links[i + 1].motion {
                let is_placed = !links[i + 1].place;
                for_kind!(link.kind, again_inverse::<T>(link, i + 1, states, is_placed, (q, v, a)));
                own[i + 1] = (states[i + 1].moment, states[i + 1].force);
                counts.motions += 1;
                counts.places += usize::from(!is_placed);
            } else if links[i + 1].force {
                (states[i + 1].moment, states[i + 1].force) = own[i + 1];
            }
        }
        for (i, link) in tree.links.iter().enumerate().rev() {
            if links[i + 1].force {
                felt[i + 1] = for_kind!(link.kind, felt_inverse::<T>(link, &states[i + 1], &tree.armature, a, out));
                counts.forces += 1;
            }
            if links[link.parent].force {
                let parent = &mut states[link.parent];
                (parent.moment, parent.force) = add_pairs((parent.moment, parent.force), felt[i + 1]);
            }
        }
    }

    /// True where all D are positive.
    fn follow_forward(&mut self, q: &[T], v: &[T], tau: &[T]) -> bool {
        let Self { tree, work, forward, efforts, inertias, counts, .. } = self;
        let Half { changes, own, felt, out } = forward;
        let TreeWorkspace { articulation: states, gains, inverses, .. } = work;
        let links = &changes.links;
        *counts = DynamicsCounts { links: tree.links.len(), ..DynamicsCounts::default() };
        states[0].needed.1 = lit(tree.gravity.map(|g| -g));
        for (i, link) in tree.links.iter().enumerate() {
            if links[i + 1].motion {
                let is_placed = !links[i + 1].place;
                for_kind!(link.kind, again_forward::<T>(link, i + 1, states, is_placed, (q, v)));
                own[i + 1] = states[i + 1].needed;
                counts.motions += 1;
                counts.places += usize::from(!is_placed);
            } else if links[i + 1].force {
                states[i + 1].needed = own[i + 1];
            }
        }
        let mut is_positive = T::Mask::splat(true);
        for (i, link) in tree.links.iter().enumerate().rev() {
            let change = links[i + 1];
            if change.force {
                let mut joint = Joint {
                    is_reshaped: change.shape || change.place,
                    armature: &tree.armature,
                    tau,
                    inertia: &mut inertias[i + 1],
                };
                let (pair, mask) =
                    for_kind!(link.kind, inwards::<T>(link, &states[i + 1], gains, inverses, &mut joint, efforts));
                felt[i + 1] = pair;
                is_positive = is_positive & mask;
                counts.inertias += usize::from(change.shape || change.place);
                counts.forces += 1;
            }
            let above = links[link.parent];
            let parent = &mut states[link.parent];
            if above.force {
                parent.needed = add_pairs(parent.needed, felt[i + 1]);
            }
            if above.shape {
                receive(parent, link.is_first_met, &inertias[i + 1]);
            }
        }
        for (i, link) in tree.links.iter().enumerate() {
            if links[i + 1].acceleration {
                let own = link.v..link.v + link.kind.freedoms();
                out[own.clone()].copy_from_slice(&efforts[own]);
                for_kind!(link.kind, accelerations::<T>(link, i + 1, states, gains, out));
                counts.accelerations += 1;
            }
        }
        is_positive.all()
    }
}

/// Of a joint in the pass inwards.
struct Joint<'a, T> {
    /// Whether the inertia of its link, or its turn, changed.
    is_reshaped: bool,
    armature: &'a [f64],
    tau: &'a [T],
    /// What the parent feels of the inertia.
    inertia: &'a mut Articulated<T>,
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn inwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    child: &LinkArticulation<T>,
    gains: &mut [Pair<T>],
    inverses: &mut [T],
    given: &mut Joint<'_, T>,
    efforts: &mut [T],
) -> (Pair<T>, T::Mask) {
    let inertia = with_own(link, child);
    let (joint, is_positive) = if given.is_reshaped {
        articulate::<T, E, N>(link, &inertia, given.armature, gains, inverses)
    } else {
        (recall::<T, E, N>(link, &inertia, gains, inverses), T::Mask::splat(true))
    };
    if given.is_reshaped && link.parent != 0 {
        *given.inertia = to_parent::<T, E, N>(child, &inertia, &joint);
    }
    (felt_forward::<T, E, N>(link, child, &inertia, &joint, given.tau, efforts), is_positive)
}
