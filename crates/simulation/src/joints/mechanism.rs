//! A mechanism: a tree of joints with names, a start, and what acts on it and holds it.

use super::JointTree;
use crate::constraints::Constraint;
use crate::forces::Force;
use crate::questions::MechanismQuestions;

/// A mechanism: its joints, the names of its parts and coordinates, its state at the start.
///
/// # Example
/// ```
/// use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
/// // A pendulum of 2 m that turns about y, at rest 0.1 rad from its lowest place.
/// let turn = Coordinate { name: "turn".into(), angular: true, position: 0.1, velocity: 0.0 };
/// let motion = JointMotion::Revolute([0.0, 1.0, 0.0]);
/// let joint = Joint { parent: None, offset: [0.0; 3], motion, coordinates: vec![turn] };
/// let bob = Part { joint: 0, name: "bob".into(), at: [0.0, 0.0, -2.0], kind: PartKind::Particle(3.0) };
/// let pendulum = Mechanism::new(vec![joint], vec![bob], [0.0, 0.0, -9.81])?;
/// assert_eq!((pendulum.tree.freedom(), pendulum.parts[0].mass), (1, 3.0));
/// assert!(pendulum.tree.dependent_coordinates(&pendulum.position).is_empty());
/// # Ok::<(), piola_simulation::SimulationError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// The placement map.
    pub tree: JointTree,
    /// Names of the parts, in the order in which the tree places them.
    pub parts: Vec<PartName>,
    /// Names of the coordinates: `upper`, `pivot.angles[0]`.
    pub coordinates: Vec<String>,
    /// Whether each coordinate is an angle (rad) rather than a length (m).
    pub angular: Vec<bool>,
    /// Acceleration of gravity, m/s².
    pub gravity: [f64; 3],
    /// Coordinates at the start.
    pub position: Vec<f64>,
    /// Their rates at the start.
    pub velocity: Vec<f64>,
    /// What acts besides gravity; [`with_forces`](Self::with_forces) checks and sets it.
    pub forces: Vec<Force>,
    /// What holds it; [`with_constraints`](Self::with_constraints) checks and sets it.
    pub constraints: Vec<Constraint>,
    /// Whether an adaptive method integrates each of the [islands](Self::islands) by itself, with steps of its own, and whether steps
    /// evaluate the [reduced](Self::reduction) tree.
    pub simplify: bool,
    /// Whether reactions are recorded.
    pub reactions: bool,
    /// What is asked besides the motion.
    pub questions: MechanismQuestions,
}

/// A part with its mass.
///
/// # Example
/// See [`Mechanism`].
#[derive(Debug, Clone, PartialEq)]
pub struct PartName {
    /// Name.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Whether it has an attitude.
    pub rigid: bool,
}
