//! Points that joints carry, to which forces and constraints are tied.

use nalgebra::Vector3;
use piola_kinematics::Attitude;
use piola_numerics::Real;

use super::{Frame, JointTree, build};
use crate::SimulationError;

/// A point fixed in the frame of a joint, or in the ground.
///
/// # Example
/// See [`JointTree::anchor`].
#[derive(Debug, Clone, PartialEq)]
pub struct Anchor {
    /// Joints from the ground to the one that carries the point.
    path: Vec<usize>,
    /// The point in the frame of the last one.
    at: [f64; 3],
}

impl Anchor {
    /// Gives the joints other numbers.
    pub(super) fn renumber(&mut self, number: &dyn Fn(usize) -> usize) {
        for joint in &mut self.path {
            *joint = number(*joint);
        }
    }
}

impl JointTree {
    /// The point `at` (m) in the frame of a joint, or of the ground.
    ///
    /// # Errors
    /// [`SimulationError::NoSuchJoint`], [`SimulationError::NotFinite`].
    ///
    /// # Example
    /// The end of a rod of 2 m, a right angle from its lowest place.
    /// ```
    /// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
    /// let turn = Coordinate { name: "turn".into(), angular: true, position: 0.1, velocity: 0.0 };
    /// let motion = JointMotion::Revolute([0.0, -1.0, 0.0]);
    /// let joint = Joint { parent: None, offset: [0.0; 3], motion, coordinates: vec![turn] };
    /// let bob = Part { joint: 0, name: "bob".into(), at: [0.0, 0.0, -2.0], kind: PartKind::Particle(3.0) };
    /// let pendulum = Mechanism::new(vec![joint], vec![bob], [0.0, 0.0, -9.81])?;
    /// let end = pendulum.tree.anchor(Some(0), [0.0, 0.0, -2.0])?;
    /// let place = pendulum.tree.place_of(&end, &|_| std::f64::consts::FRAC_PI_2);
    /// assert!((place.x - 2.0).abs() < 1e-15 && place.z.abs() < 1e-15);
    /// # Ok::<(), piola_simulation::SimulationError>(())
    /// ```
    pub fn anchor(&self, joint: Option<usize>, at: [f64; 3]) -> Result<Anchor, SimulationError> {
        build::finite("at", at)?;
        let mut path = Vec::new();
        let mut next = joint;
        while let Some(joint) = next {
            let node = self.joints.get(joint);
            let node = node.ok_or(SimulationError::NoSuchJoint { joint, joints: self.joints.len() })?;
            path.push(joint);
            next = node.parent;
        }
        path.reverse();
        Ok(Anchor { path, at })
    }

    /// Whether an anchor is one of this tree, by the number of joints.
    pub(crate) fn holds(&self, anchor: &Anchor) -> Result<(), SimulationError> {
        let joints = self.joints.len();
        match anchor.path.iter().find(|joint| joints <= **joint) {
            Some(&joint) => Err(SimulationError::NoSuchJoint { joint, joints }),
            None => Ok(()),
        }
    }

    /// The place of an anchor in space, m, where `q` gives the coordinates by index.
    pub fn place_of<T: Real>(&self, anchor: &Anchor, q: &dyn Fn(usize) -> T) -> Vector3<T> {
        self.frame_of(anchor, q).0
    }

    /// The place of an anchor and the attitude of its joint, where `q` gives the coordinates by index.
    pub(crate) fn frame_of<T: Real>(&self, anchor: &Anchor, q: &dyn Fn(usize) -> T) -> (Vector3<T>, Attitude<T>) {
        let mut frame = Frame::ground();
        for &joint in &anchor.path {
            frame = self.joints[joint].frame(&frame, q);
        }
        (frame.point(anchor.at), frame.attitude)
    }

    /// Coordinates that move an anchor, by index.
    pub fn coordinates_of<'t>(&'t self, anchor: &'t Anchor) -> impl Iterator<Item = usize> + 't {
        anchor.path.iter().flat_map(|&joint| {
            let node = &self.joints[joint];
            node.first..node.first + node.motion.freedom()
        })
    }
}
