//! A tree of joints without what an evaluation need not see.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Inertia, RigidBody};

use super::{JointTree, Mechanism, Node, PartKind, Placed};

/// A tree with the same motion as that of a mechanism: parts that no coordinate moves are left out, fixed joints are merged with
/// the joints that carry them, and the parts of a joint become one body where they have the inertia of one.
///
/// # Example
/// ```
/// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
/// let turn = Coordinate { name: "turn".into(), angular: true, position: 0.1, velocity: 0.0 };
/// let motion = JointMotion::Revolute([0.0, 1.0, 0.0]);
/// let wheel = Joint { parent: None, offset: [0.0; 3], motion, coordinates: vec![turn] };
/// let arm = Joint { parent: Some(0), offset: [0.0, 0.0, -1.0], motion: JointMotion::Fixed, coordinates: Vec::new() };
/// let wall = Joint { parent: None, ..arm.clone() };
/// let part = |joint: usize, at: [f64; 3]| Part { joint, name: joint.to_string(), at, kind: PartKind::Particle(1.0) };
/// let rim = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]].map(|at| part(0, at));
/// let parts = rim.into_iter().chain([part(1, [0.0; 3]), part(2, [0.0; 3])]).collect();
/// let reduced = Mechanism::new(vec![wheel, arm, wall], parts, [0.0, 0.0, -9.81])?.reduction();
/// assert_eq!((reduced.still, reduced.merged_joints, reduced.merged_parts), (vec![4], 1, 3)); // four particles are one body
/// # Ok::<(), piola_simulation::SimulationError>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Reduction {
    /// The tree that is evaluated.
    pub tree: JointTree,
    /// Parts that no coordinate moves, by their index in [`Mechanism::parts`].
    pub still: Vec<usize>,
    /// Fixed joints that a moving joint carries.
    pub merged_joints: usize,
    /// Moving parts of the mechanism less those of the reduced tree.
    pub merged_parts: usize,
}

impl Reduction {
    /// Whether the tree is as it was.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.still.is_empty() && self.merged_joints == 0 && self.merged_parts == 0
    }
}

impl Mechanism {
    /// The tree that is evaluated in the steps of a run.
    ///
    /// # Example
    /// See [`Reduction`].
    #[must_use]
    pub fn reduction(&self) -> Reduction {
        let joints = &self.tree.joints;
        let bare = |node: &Node| Node { children: Vec::new(), parts: Vec::new(), ..node.clone() };
        let mut tree =
            JointTree { joints: joints.iter().map(bare).collect(), roots: Vec::new(), freedom: self.tree.freedom };
        let (mut still, mut merged_joints, mut part) = (Vec::new(), 0, 0);
        // Joints with the moving joint that carries them and their place in its frame, in the order of placement.
        let mut stack: Vec<(usize, Option<usize>, [f64; 3])> =
            self.tree.roots.iter().rev().map(|root| (*root, None, [0.0; 3])).collect();
        while let Some((joint, carrier, shift)) = stack.pop() {
            let node = &joints[joint];
            let place = sum(shift, node.offset);
            let (carrier, origin) = if node.motion.freedom() == 0 {
                merged_joints += usize::from(carrier.is_some());
                (carrier, place)
            } else {
                tree.joints[joint].offset = place;
                tree.joints[joint].parent = carrier;
                match carrier {
                    Some(carrier) => tree.joints[carrier].children.push(joint),
                    None => tree.roots.push(joint),
                }
                (Some(joint), [0.0; 3])
            };
            for placed in &node.parts {
                match carrier {
                    Some(carrier) => {
                        let kind = placed.kind.clone();
                        tree.joints[carrier].parts.push(Placed { at: sum(origin, placed.at), kind });
                    }
                    None => still.push(part),
                }
                part += 1;
            }
            stack.extend(node.children.iter().rev().map(|child| (*child, carrier, origin)));
        }
        let mut merged_parts = 0;
        for node in &mut tree.joints {
            if let Some(body) = one_body(&node.parts) {
                merged_parts += node.parts.len() - 1;
                node.parts = vec![body];
            }
        }
        Reduction { tree, still, merged_joints, merged_parts }
    }
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Several parts of one frame as one body; nothing where that is no gain, or where they have the inertia of no body, as particles
/// on a line.
fn one_body(parts: &[Placed]) -> Option<Placed> {
    /// So many particles take no longer than a body.
    const FEW: usize = 3;
    let bodies = parts.iter().filter(|part| matches!(part.kind, PartKind::Body(_))).count();
    if parts.len() < 2 || (bodies == 0 && parts.len() <= FEW) {
        return None;
    }
    let mass_of = |part: &Placed| match &part.kind {
        PartKind::Particle(mass) => *mass,
        PartKind::Body(body) => body.mass(),
    };
    let mass: f64 = parts.iter().map(mass_of).sum();
    let centre = parts.iter().map(|part| Vector3::from(part.at) * (mass_of(part) / mass)).sum::<Vector3<f64>>();
    let mut inertia = Matrix3::zeros();
    for part in parts {
        let arm = Vector3::from(part.at) - centre;
        inertia += (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * mass_of(part);
        if let PartKind::Body(body) = &part.kind {
            inertia += body.inertia().matrix();
        }
    }
    let body = RigidBody::new(mass, Inertia::new(inertia).ok()?).ok()?;
    Some(Placed { at: centre.into(), kind: PartKind::Body(body) })
}
