//! Mechanisms from lists of joints and parts.

use piola_kinematics::RigidBody;

use super::{JointTree, Mechanism, Node, PartName, Placed};
use crate::SimulationError;
use crate::questions::MechanismQuestions;

/// Largest number of joints on one path from the ground: the placement recurses along it.
pub const DEEPEST: usize = 200;

/// A joint of a mechanism, by the index of its parent.
///
/// # Example
/// See [`Mechanism`].
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Index of the joint that carries it; none for the ground.
    pub parent: Option<usize>,
    /// Its place in the frame of its parent, m.
    pub offset: [f64; 3],
    /// The motion that it allows.
    pub motion: JointMotion,
    /// Its coordinates, as many as the motion has.
    pub coordinates: Vec<Coordinate>,
}

/// The motion that a joint allows, in the frame of its parent moved by the offset.
///
/// # Example
/// See [`Mechanism`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointMotion {
    /// None: no coordinate.
    Fixed,
    /// Rotation about a unit axis: an angle, rad.
    Revolute([f64; 3]),
    /// Displacement along a unit axis: a length, m.
    Prismatic([f64; 3]),
    /// Rotation about a unit axis and then about a second one that the first turns: two angles, rad.
    Universal([f64; 3], [f64; 3]),
    /// Any rotation: three Eulerian angles z–y–z, rad.
    Spherical,
    /// Any displacement and rotation: three lengths, m, and three Eulerian angles z–y–z, rad.
    Free,
}

/// A coordinate of a joint with its value at the start.
///
/// # Example
/// See [`Mechanism`].
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// Name.
    pub name: String,
    /// Whether it is an angle (rad) rather than a length (m).
    pub angular: bool,
    /// Its value at the start, rad or m.
    pub position: f64,
    /// Its rate at the start, rad/s or m/s.
    pub velocity: f64,
}

/// A particle or rigid body on a joint.
///
/// # Example
/// See [`Mechanism`].
#[derive(Debug, Clone)]
pub struct Part {
    /// Index of the joint that carries it.
    pub joint: usize,
    /// Name.
    pub name: String,
    /// Place of the particle or of the centre of mass in the frame of the joint, m.
    pub at: [f64; 3],
    /// Particle or body.
    pub kind: PartKind,
}

/// Kinds of parts.
///
/// # Example
/// See [`Mechanism`].
#[derive(Debug, Clone)]
pub enum PartKind {
    /// A particle of this mass, kg.
    Particle(f64),
    /// A rigid body with the axes of its joint.
    Body(RigidBody),
}

impl JointMotion {
    /// The number of coordinates.
    #[must_use]
    pub fn freedom(&self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute(_) | Self::Prismatic(_) => 1,
            Self::Universal(..) => 2,
            Self::Spherical => 3,
            Self::Free => 6,
        }
    }

    fn axes(&self) -> Vec<[f64; 3]> {
        match *self {
            Self::Revolute(axis) | Self::Prismatic(axis) => vec![axis],
            Self::Universal(first, second) => vec![first, second],
            Self::Fixed | Self::Spherical | Self::Free => Vec::new(),
        }
    }
}

impl Mechanism {
    /// The mechanism of joints and parts under uniform gravity, m/s².
    ///
    /// Coordinates are numbered in the order of `joints`. Parents may stand after their children.
    ///
    /// # Errors
    /// [`SimulationError`] where a number is not finite, an axis no unit vector, a mass not positive, the number of a joint's
    /// coordinates not that of its motion, or where parents do not lead to the ground over at most [`DEEPEST`] joints.
    pub fn new(joints: Vec<Joint>, parts: Vec<Part>, gravity: [f64; 3]) -> Result<Self, SimulationError> {
        check(&joints, &parts, gravity)?;
        let order = order(&joints)?;
        let count = joints.len();
        let parents: Vec<Option<usize>> = joints.iter().map(|joint| joint.parent).collect();
        let mut mechanism = Mechanism {
            tree: JointTree { joints: Vec::with_capacity(count), roots: Vec::new(), freedom: 0 },
            parts: Vec::new(),
            coordinates: Vec::new(),
            angular: Vec::new(),
            gravity,
            position: Vec::new(),
            velocity: Vec::new(),
            forces: Vec::new(),
            constraints: Vec::new(),
            simplify: true,
            reactions: false,
            questions: MechanismQuestions::default(),
        };
        // Coordinates are numbered as the joints are written.
        for draft in joints {
            let first = mechanism.position.len();
            for coordinate in draft.coordinates {
                mechanism.coordinates.push(coordinate.name);
                mechanism.angular.push(coordinate.angular);
                mechanism.position.push(coordinate.position);
                mechanism.velocity.push(coordinate.velocity);
            }
            let (parent, offset, motion) = (draft.parent, draft.offset, draft.motion);
            mechanism.tree.joints.push(Node { parent, offset, motion, first, children: Vec::new(), parts: Vec::new() });
        }
        mechanism.tree.freedom = mechanism.position.len();
        for joint in order {
            match parents[joint] {
                Some(parent) => mechanism.tree.joints[parent].children.push(joint),
                None => mechanism.tree.roots.push(joint),
            }
        }
        let mut names: Vec<Vec<PartName>> = vec![Vec::new(); count];
        for Part { joint, name, at, kind } in parts {
            let (mass, rigid) = match &kind {
                PartKind::Particle(mass) => (*mass, false),
                PartKind::Body(body) => (body.mass(), true),
            };
            names[joint].push(PartName { name, mass, rigid });
            mechanism.tree.joints[joint].parts.push(Placed { at, kind });
        }
        // Names in the order of placement.
        let mut stack: Vec<usize> = mechanism.tree.roots.iter().rev().copied().collect();
        while let Some(joint) = stack.pop() {
            mechanism.parts.append(&mut names[joint]);
            stack.extend(mechanism.tree.joints[joint].children.iter().rev());
        }
        Ok(mechanism)
    }
}

/// Checks each joint and part by itself.
fn check(joints: &[Joint], parts: &[Part], gravity: [f64; 3]) -> Result<(), SimulationError> {
    for (joint, Joint { motion, coordinates, .. }) in joints.iter().enumerate() {
        let (expected, found) = (motion.freedom(), coordinates.len());
        if expected != found {
            return Err(SimulationError::WrongLength { quantity: "coordinates", expected, found });
        }
        for axis in motion.axes() {
            let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
            let is_unit = (length - 1.0).abs() <= 1e-12;
            if !is_unit {
                return Err(SimulationError::AxisNotUnit { joint, length });
            }
        }
    }
    for (part, Part { kind, .. }) in parts.iter().enumerate() {
        if let PartKind::Particle(value) = *kind
            && !(0.0 < value && value < f64::INFINITY)
        {
            return Err(SimulationError::InvalidMass { part, value });
        }
    }
    let above = joints.iter().filter_map(|joint| joint.parent).chain(parts.iter().map(|part| part.joint));
    if let Some(joint) = above.into_iter().find(|joint| joints.len() <= *joint) {
        return Err(SimulationError::NoSuchJoint { joint, joints: joints.len() });
    }
    let coordinates = || joints.iter().flat_map(|joint| &joint.coordinates);
    finite("gravity", gravity)?;
    finite("offset", joints.iter().flat_map(|joint| joint.offset))?;
    finite("at", parts.iter().flat_map(|part| part.at))?;
    finite("position", coordinates().map(|coordinate| coordinate.position))?;
    finite("velocity", coordinates().map(|coordinate| coordinate.velocity))
}

pub(crate) fn finite(quantity: &'static str, values: impl IntoIterator<Item = f64>) -> Result<(), SimulationError> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, value)) => Err(SimulationError::NotFinite { quantity, index, value }),
        None => Ok(()),
    }
}

/// Joints so that parents come before children; a cycle has no such order.
fn order(joints: &[Joint]) -> Result<Vec<usize>, SimulationError> {
    let mut order = Vec::with_capacity(joints.len());
    let mut depth = vec![0; joints.len()];
    for start in 0..joints.len() {
        let mut path = Vec::new();
        let mut at = Some(start);
        while let Some(joint) = at.filter(|joint| depth[*joint] == 0) {
            if path.len() == joints.len() {
                return Err(SimulationError::CyclicJoints { joint: start });
            }
            path.push(joint);
            at = joints[joint].parent;
        }
        for &joint in path.iter().rev() {
            depth[joint] = joints[joint].parent.map_or(0, |parent| depth[parent]) + 1;
            if DEEPEST < depth[joint] {
                return Err(SimulationError::TooDeep { joint, depth: depth[joint], most: DEEPEST });
            }
            order.push(joint);
        }
    }
    Ok(order)
}

#[cfg(test)]
mod tests {
    use super::{DEEPEST, Joint, JointMotion, Mechanism, Part, PartKind};
    use crate::SimulationError;

    fn fixed(parent: Option<usize>) -> Joint {
        Joint { parent, offset: [0.0, 0.0, 1.0], motion: JointMotion::Fixed, coordinates: Vec::new() }
    }

    fn particle(joint: usize, mass: f64) -> Part {
        Part { joint, name: format!("on {joint}"), at: [0.0; 3], kind: PartKind::Particle(mass) }
    }

    fn violated(joints: Vec<Joint>, parts: Vec<Part>) -> Option<SimulationError> {
        Mechanism::new(joints, parts, [0.0; 3]).err()
    }

    #[test]
    fn parts_are_named_in_the_order_of_placement() {
        let joints = vec![fixed(Some(2)), fixed(None), fixed(None)];
        let parts = vec![particle(0, 1.0), particle(1, 2.0), particle(2, 3.0)];
        let Ok(mechanism) = Mechanism::new(joints, parts, [0.0; 3]) else { panic!() };
        let names: Vec<&str> = mechanism.parts.iter().map(|part| part.name.as_str()).collect();
        assert_eq!(names, ["on 2", "on 0", "on 1"]);
    }

    #[test]
    fn a_violated_condition_is_named() {
        use SimulationError::{AxisNotUnit, CyclicJoints, InvalidMass, NoSuchJoint, NotFinite, TooDeep, WrongLength};
        let with = |motion| vec![Joint { motion, ..fixed(None) }];
        assert!(matches!(violated(vec![fixed(Some(1)), fixed(Some(0))], vec![]), Some(CyclicJoints { joint: 0 })));
        assert!(matches!(
            violated(vec![fixed(None)], vec![particle(1, 1.0)]),
            Some(NoSuchJoint { joint: 1, joints: 1 })
        ));
        assert!(matches!(violated(vec![fixed(Some(7))], vec![]), Some(NoSuchJoint { joint: 7, joints: 1 })));
        assert!(matches!(violated(vec![fixed(None)], vec![particle(0, 0.0)]), Some(InvalidMass { part: 0, .. })));
        assert!(matches!(violated(with(JointMotion::Spherical), vec![]), Some(WrongLength { expected: 3, .. })));
        let mut far = fixed(None);
        far.offset[1] = f64::INFINITY;
        assert!(matches!(violated(vec![fixed(None), far], vec![]), Some(NotFinite { index: 4, .. })));
        let chain = |count: usize| (0..count).map(|joint| fixed(joint.checked_sub(1))).collect();
        assert!(violated(chain(DEEPEST), vec![]).is_none());
        assert!(matches!(violated(chain(DEEPEST + 1), vec![]), Some(TooDeep { joint: DEEPEST, .. })));
        let coordinate = super::Coordinate { name: "turn".into(), angular: true, position: 0.0, velocity: 0.0 };
        let axis = JointMotion::Revolute([0.0, 2.0, 0.0]);
        let joint = Joint { motion: axis, coordinates: vec![coordinate], ..fixed(None) };
        assert!(matches!(violated(vec![joint], vec![]), Some(AxisNotUnit { joint: 0, .. })));
    }
}
