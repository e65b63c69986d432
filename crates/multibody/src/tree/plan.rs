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
///     "2 bodies in 1 link; merged: weld; folded: 1 of 1 turn about a coordinate axis, without products of matrices"
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
}

impl RigidTree {
    /// What was merged and folded when the tree was built. How much of an evaluation is skipped is counted by
    /// [`KeptMassMatrix::counts`](crate::KeptMassMatrix::counts).
    #[must_use]
    pub fn plan(&self) -> TreePlan {
        let fixed = self.joints.iter().filter(|place| place.joint.kind == JointKind::Fixed);
        let count = |kinds: &[Kind]| self.links.iter().filter(|link| kinds.contains(&link.kind)).count();
        let aligned = count(&[Kind::RevoluteX, Kind::RevoluteY, Kind::RevoluteZ]);
        TreePlan {
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
        write!(f, "; folded: {} of {turns} about a coordinate axis, without products of matrices", self.aligned)
    }
}
