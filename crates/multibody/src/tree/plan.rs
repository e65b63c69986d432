//! What the building of a tree merged and folded.

use core::fmt;

use super::{JointKind, RigidTree};
use crate::link::Kind;

/// What the passes of a tree visit, and what they need not do because the tree was built so.
///
/// # Example
/// ```
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
/// let bob = BodyInertia::particle(1.0, [0.0, 0.0, -1.0])?;
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// let rod = builder.attach(BodyIndex::GROUND, hinge, "rod", bob)?;
/// builder.attach(rod, TreeJoint::new("weld", JointKind::Fixed), "tool", bob)?;
/// let plan = builder.build()?.plan();
/// assert_eq!((plan.links, plan.merged.as_slice()), (1, ["weld".to_owned()].as_slice()));
/// assert_eq!(
///     plan.to_string(),
///     "2 bodies in 1 link; merged: weld; folded: 1 of 1 turn about a coordinate axis, without products of matrices; \
///      a joint that changes alone moves 1.0 of 1 link in the mean: KeptMassMatrix keeps the rest, KeptDynamics their motions"
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TreePlan {
    /// Bodies, without the ground.
    pub bodies: usize,
    /// Links behind elementary joints: what each pass visits.
    pub links: usize,
    /// The fixed joints, whose bodies are parts of their parents.
    pub merged: Vec<String>,
    /// Elementary rotations about one axis.
    pub turns: usize,
    /// Those of them about a coordinate axis of their link: they multiply no matrices.
    pub aligned: usize,
    /// The links that each joint moves, its own among them, summed over the links. A joint that changes alone moves
    /// `moved / links` of them in the mean: half the links of a chain, and few of a tree with many branches.
    /// [`KeptMassMatrix`](crate::KeptMassMatrix) keeps the places of the others, and [`KeptDynamics`](crate::KeptDynamics) their
    /// motions. Its forward dynamics computes the accelerations of all links again.
    pub moved: usize,
}

impl RigidTree {
    /// What was merged and folded when the tree was built, and how many links a joint moves. How much of an evaluation is skipped
    /// is counted by [`KeptMassMatrix::counts`](crate::KeptMassMatrix::counts) and
    /// [`KeptDynamics::counts`](crate::KeptDynamics::counts).
    #[must_use]
    pub fn plan(&self) -> TreePlan {
        let fixed = self.joints.iter().filter(|place| place.joint.kind == JointKind::Fixed);
        let count = |kinds: &[Kind]| self.links.iter().filter(|link| kinds.contains(&link.kind)).count();
        let aligned = count(&[Kind::RevoluteX, Kind::RevoluteY, Kind::RevoluteZ]);
        // A link is moved by all joints from the ground to it.
        let mut depths = vec![0; self.links.len() + 1];
        for (i, link) in self.links.iter().enumerate() {
            depths[i + 1] = depths[link.parent] + 1;
        }
        TreePlan {
            moved: depths.iter().sum(),
            bodies: self.bodies(),
            links: self.links(),
            merged: fixed.map(|place| place.joint.name.clone()).collect(),
            turns: aligned + count(&[Kind::RevoluteTurned, Kind::Helical]),
            aligned,
        }
    }
}

impl fmt::Display for TreePlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = |count: usize, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
        let bodies = plural(self.bodies, "body", "bodies");
        write!(f, "{bodies} in {}; merged: ", plural(self.links, "link", "links"))?;
        match self.merged.as_slice() {
            [] => write!(f, "nothing")?,
            names => write!(f, "{}", names.join(", "))?,
        }
        let turns = plural(self.turns, "turn", "turns");
        write!(f, "; folded: {} of {turns} about a coordinate axis, without products of matrices", self.aligned)?;
        let mean = self.moved as f64 / self.links.max(1) as f64;
        let links = plural(self.links, "link", "links");
        let keeping = "KeptMassMatrix keeps the rest, KeptDynamics their motions";
        write!(f, "; a joint that changes alone moves {mean:.1} of {links} in the mean: {keeping}")
    }
}
