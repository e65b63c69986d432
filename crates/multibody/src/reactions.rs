//! Reactions: what a joint carries, beside what drives it.

use piola_numerics::Real;

use crate::error::{MultibodyError, check_length};
use crate::inverse_dynamics::AppliedWrench;
use crate::space::pass_places;
use crate::spatial::times;
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;

/// The moment and the force by which a parent acts on a child through a joint, in space axes, the driving torque included.
///
/// # Example
/// See [`RigidTree::joint_reactions`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointReaction<T> {
    /// The point about which the moment is taken: the origin of the frame that the joint moves, m.
    pub point: [T; 3],
    /// The moment, N m.
    pub moment: [T; 3],
    /// The force, N.
    pub force: [T; 3],
}

impl RigidTree {
    /// The reactions in some joints, given by their positions in [`joints`](Self::joints), at accelerations v̇ and under
    /// forces from outside.
    ///
    /// Of a joint of several elementary ones the reaction is that behind the last.
    ///
    /// # Errors
    /// As [`inverse_dynamics_under`](Self::inverse_dynamics_under); [`MultibodyError::NoSuchIndex`] for joints that do not
    /// exist or are fixed, which are no joints of the tree any more.
    ///
    /// # Example
    /// A particle of 2 kg hangs at rest from a hinge: the hinge carries 19.62 N.
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, JointReaction, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    /// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.0, 0.0, -0.5])?)?;
    /// let tree = builder.build()?;
    /// let mut out = [JointReaction { point: [0.0; 3], moment: [0.0; 3], force: [0.0; 3] }];
    /// tree.joint_reactions(&mut tree.workspace(), &[0.0], &[0.0], &[0.0], &[], &[0], &mut out)?;
    /// assert_eq!(out[0].force, [0.0, 0.0, 19.62]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[expect(clippy::too_many_arguments, reason = "a state, what acts, and what is asked")]
    pub fn joint_reactions<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        wrenches: &[AppliedWrench<T>],
        joints: &[usize],
        out: &mut [JointReaction<T>],
    ) -> Result<(), MultibodyError> {
        check_length("out", joints.len(), out.len())?;
        let mut tau = core::mem::take(&mut work.column);
        let result = self.inverse_dynamics_under(work, q, v, a, wrenches, &mut tau);
        work.column = tau;
        result?;
        pass_places(self, &mut work.space, q);
        for (&joint, out) in joints.iter().zip(out) {
            let Some(link) = self.links.iter().rposition(|link| link.joint == joint) else {
                let count = self.joints.len();
                return Err(MultibodyError::NoSuchIndex { what: "joint that moves", index: joint, count });
            };
            let (forces, space) = (&work.forces[link + 1], &work.space[link + 1]);
            *out = JointReaction {
                point: space.origin,
                moment: times(space.axes, forces.moment),
                force: times(space.axes, forces.force),
            };
        }
        Ok(())
    }
}
