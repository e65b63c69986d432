//! The mass matrix kept from one configuration to the next: what no joint changed is not computed again.
//!
//! ```text
//! place of a link          changes with the joints from the ground to it, its own among them
//! composite inertia        changes with the joints beyond the link
//! entry (i, j) of M        changes with the joints between i and j, that of j among them, and with those beyond j
//! ```

use core::fmt;

use piola_numerics::Real;

use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_finite, check_length};
use crate::mass_matrix::{add_to_parent, entries, place, put_motions};
use crate::space::reference;
use crate::spatial::{lit, lit_symmetric};
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;

/// How much the last update of a [`KeptMassMatrix`] computed, of how many links.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UpdateCounts {
    /// The links of the tree.
    pub links: usize,
    /// Places that were computed.
    pub places: usize,
    /// Composite inertias that were summed.
    pub inertias: usize,
    /// Links whose columns were computed, whole or in part.
    pub columns: usize,
}

impl fmt::Display for UpdateCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { links, places, inertias, columns } = self;
        let kept = |computed: &usize| links - computed;
        write!(
            f,
            "of {links} links: {places} places computed, {} kept; {inertias} composite inertias computed, {} kept; \
             columns of {columns} links computed, of {} kept",
            kept(places),
            kept(inertias),
            kept(columns)
        )
    }
}

/// The mass matrix and the places of all links, which follow the joints that change and keep the rest.
///
/// # Accuracy
/// That of [`RigidTree::mass_matrix`]. A kept entry was computed at another place in space: the same number to rounding.
///
/// # Example
/// Two hinges in series: after the first one turns nothing is computed again but places, because M depends on the second alone.
/// ```
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, KeptMassMatrix, RigidTree, TreeJoint};
/// let y = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
/// let bob = BodyInertia::particle(1.0, [0.0, 0.0, -1.0])?;
/// let mut builder = RigidTree::builder();
/// let upper = builder.attach(BodyIndex::GROUND, TreeJoint::new("shoulder", y), "upper", bob)?;
/// builder.attach(upper, TreeJoint::new("elbow", y).at([0.0, 0.0, -1.0]), "lower", bob)?;
/// let tree = builder.build()?;
/// let mut kept = KeptMassMatrix::new(&tree);
/// kept.update(&[0.0, 0.0])?;
/// assert_eq!(kept.mass_matrix(), [5.0, 2.0, 2.0, 1.0]);
/// kept.update(&[0.7, 0.0])?;
/// let counts = kept.counts();
/// assert_eq!((counts.places, counts.inertias, counts.columns), (2, 0, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("cache", "incremental"))]
#[derive(Clone, Debug)]
pub struct KeptMassMatrix<'a, T = f64> {
    tree: &'a RigidTree,
    work: TreeWorkspace<T>,
    q: Vec<T>,
    entries: Vec<T>,
    /// Whether `q` and all that follows from it is there.
    is_there: bool,
    /// Of each state of a link: whether its own joint changed.
    changed: Vec<bool>,
    /// Whether a joint from the ground to it changed.
    moved: Vec<bool>,
    /// Whether a joint beyond it changed.
    is_reshaped: Vec<bool>,
    /// The last link with a changed joint on the way from the ground to it, or 0.
    last_changed: Vec<usize>,
    counts: UpdateCounts,
}

impl<'a, T: Real> KeptMassMatrix<'a, T> {
    /// Memory for a tree; nothing is computed yet.
    #[must_use]
    pub fn new(tree: &'a RigidTree) -> Self {
        let (states, n) = (tree.links() + 1, tree.freedoms());
        Self {
            tree,
            work: tree.workspace(),
            q: vec![T::zero(); tree.coordinates()],
            entries: vec![T::zero(); n * n],
            is_there: false,
            changed: vec![false; states],
            moved: vec![false; states],
            is_reshaped: vec![false; states],
            last_changed: vec![0; states],
            counts: UpdateCounts::default(),
        }
    }

    /// Goes to a configuration of the tree. The first call computes all.
    ///
    /// # Errors
    /// As [`RigidTree::mass_matrix`]. The last configuration stays where `q` is refused. After an overflow nothing is kept: the
    /// next call computes all.
    pub fn update(&mut self, q: &[T]) -> Result<(), MultibodyError> {
        let tree = self.tree;
        check_length("q", tree.coordinates(), q.len())?;
        check_finite("q", q)?;
        tree.check_quaternions(q)?;
        self.compare(q);
        self.is_there = false;
        self.q.copy_from_slice(q);
        self.follow();
        // A number that is not finite reaches the diagonal.
        let n = tree.freedoms();
        if !self.entries.iter().step_by(n + 1).all(|entry| all_finite(&[*entry])) {
            return check_finite("mass matrix", &self.entries);
        }
        self.is_there = true;
        Ok(())
    }

    /// M, entry (i, j) at `i + j n`; zeros before the first update.
    #[must_use]
    pub fn mass_matrix(&self) -> &[T] {
        &self.entries
    }

    /// The workspace with the places of all links, for [`RigidTree::place_of`].
    #[must_use]
    pub const fn workspace(&self) -> &TreeWorkspace<T> {
        &self.work
    }

    /// How much the last update computed.
    #[must_use]
    pub const fn counts(&self) -> UpdateCounts {
        self.counts
    }

    /// Which joints changed, and what that changes.
    fn compare(&mut self, q: &[T]) {
        let tree = self.tree;
        self.is_reshaped.fill(!self.is_there);
        for (i, link) in tree.links.iter().enumerate() {
            let own = link.q..link.q + link.kind.coordinates();
            let is_changed = !self.is_there || own.clone().any(|k| q[k] != self.q[k]);
            self.changed[i + 1] = is_changed;
            self.moved[i + 1] = is_changed || self.moved[link.parent];
            self.last_changed[i + 1] = if is_changed { i + 1 } else { self.last_changed[link.parent] };
        }
        for (i, link) in tree.links.iter().enumerate().rev() {
            self.is_reshaped[link.parent] |= self.changed[i + 1] || self.is_reshaped[i + 1];
        }
    }

    fn follow(&mut self) {
        let Self { tree, work, q, entries: out, moved, is_reshaped, last_changed, counts, .. } = self;
        *counts = UpdateCounts { links: tree.links(), ..UpdateCounts::default() };
        let TreeWorkspace { space, motions, composite, forces, .. } = work;
        for (i, link) in tree.links.iter().enumerate() {
            if moved[i + 1] {
                for_kind!(link.kind, place::<T>(link, i + 1, q, space, forces));
                counts.places += 1;
            }
            if is_reshaped[i + 1] {
                let own = &mut composite[i + 1];
                own.mass = T::lit(link.mass);
                own.moment = lit(link.moment);
                own.inertia = lit_symmetric(link.inertia);
                counts.inertias += 1;
            }
        }
        let reference = reference(space);
        // The reference point is the origin of the first link.
        let is_shifted = moved.get(1).copied().unwrap_or(false);
        for (i, link) in tree.links.iter().enumerate() {
            if moved[i + 1] || is_shifted {
                for_kind!(link.kind, put_motions::<T>(link, &space[i + 1], reference, motions));
            }
        }
        for (i, link) in tree.links.iter().enumerate().rev() {
            // Entries that change: all, or those above the last joint that changed.
            let last = last_changed[i + 1];
            let from = match (is_reshaped[i + 1], last) {
                (true, _) => i + 1,
                (false, 0) => 0,
                (false, last) => tree.links[last - 1].parent,
            };
            if from != 0 {
                let kind = link.kind;
                for_kind!(kind, entries::<T>(tree, link, i + 1, from, space, composite, reference, motions, out, true));
                counts.columns += 1;
            }
            if is_reshaped[link.parent] {
                for_kind!(link.kind, add_to_parent::<T>(tree, link, i + 1, forces, composite));
            }
        }
    }
}
