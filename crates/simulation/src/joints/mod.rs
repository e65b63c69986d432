//! Trees of joints with particles and rigid bodies: a placement map made of data.

mod anchor;
mod build;
mod independence;

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Holonomic, Placement};
use piola_numerics::Real;

use crate::constraints::Constraint;
use crate::forces::Force;
use crate::questions::MechanismQuestions;

pub use anchor::Anchor;
pub(crate) use build::finite;
pub use build::{Coordinate, DEEPEST, Joint, JointMotion, Part, PartKind};

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

/// A tree of joints as a placement map over any scalar.
///
/// ```text
/// frame(j) = frame(parent) ∘ offset ∘ motion(q_j)        part at y:  x = o + A y
/// ```
/// Frames are passed down the tree by value, so that a placement allocates nothing. Parts are placed joint by joint, the
/// parts of a joint before those of its children.
///
/// # Example
/// See [`Mechanism`], which makes one.
#[derive(Debug, Clone)]
pub struct JointTree {
    joints: Vec<Node>,
    roots: Vec<usize>,
    freedom: usize,
}

#[derive(Debug, Clone)]
struct Node {
    parent: Option<usize>,
    offset: [f64; 3],
    motion: JointMotion,
    /// Index of its first coordinate.
    first: usize,
    children: Vec<usize>,
    parts: Vec<Placed>,
}

/// A part in the frame of its joint.
#[derive(Debug, Clone)]
struct Placed {
    at: [f64; 3],
    kind: PartKind,
}

impl JointTree {
    /// The number of coordinates.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.freedom
    }

    /// Groups of coordinates that are dependent at `q`, by index: together they can change without moving anything with mass. A
    /// group of one coordinate moves nothing with mass by itself.
    ///
    /// ```text
    /// rank J = n,    J = ( √m ∂x/∂q ;  √M ∂ξ/∂q ;  √I ω_Δ )        W(3.4)
    /// ```
    /// The columns are scaled to unit length; singular values below 1e-10 count as zero. `q` has [`freedom`](Self::freedom)
    /// coordinates, in rad and m.
    #[must_use]
    pub fn dependent_coordinates(&self, q: &[f64]) -> Vec<Vec<usize>> {
        independence::dependent_coordinates(self, q)
    }

    fn place_joint<T: Real>(
        &self,
        joint: &Node,
        below: &Frame<T>,
        q: &impl Fn(usize) -> T,
        bodies: &mut impl Placement<T>,
    ) {
        let frame = joint.frame(below, q);
        for part in &joint.parts {
            let centre = frame.point(part.at);
            match &part.kind {
                PartKind::Particle(mass) => bodies.particle(*mass, centre),
                PartKind::Body(body) => bodies.body(body, centre, frame.attitude),
            }
        }
        for &child in &joint.children {
            self.place_joint(&self.joints[child], &frame, q, bodies);
        }
    }
}

/// A frame: its origin and its attitude in space.
struct Frame<T: Real> {
    origin: Vector3<T>,
    attitude: Attitude<T>,
}

impl<T: Real> Frame<T> {
    fn ground() -> Self {
        Self { origin: Vector3::zeros(), attitude: Attitude::identity() }
    }

    /// The place in space of a point of the frame.
    fn point(&self, at: [f64; 3]) -> Vector3<T> {
        self.origin + self.attitude.to_space(&constant(at))
    }
}

impl Node {
    /// The frame that the joint carries, on the frame of its parent.
    fn frame<T: Real>(&self, below: &Frame<T>, q: &impl Fn(usize) -> T) -> Frame<T> {
        let q_j = |i: usize| q(self.first + i);
        let mut origin = below.point(self.offset);
        let mut attitude = below.attitude;
        match &self.motion {
            JointMotion::Fixed => {}
            JointMotion::Revolute(axis) => attitude = attitude.product(about(*axis, q_j(0))),
            JointMotion::Prismatic(axis) => {
                let shift = q_j(0);
                origin += attitude.to_space(&constant(*axis).map(|x: T| x * shift));
            }
            JointMotion::Universal(first, second) => {
                attitude = attitude.product(about(*first, q_j(0))).product(about(*second, q_j(1)));
            }
            JointMotion::Spherical => attitude = attitude.product(Attitude::from_euler_zyz([q_j(0), q_j(1), q_j(2)])),
            JointMotion::Free => {
                origin += attitude.to_space(&Vector3::new(q_j(0), q_j(1), q_j(2)));
                attitude = attitude.product(Attitude::from_euler_zyz([q_j(3), q_j(4), q_j(5)]));
            }
        }
        Frame { origin, attitude }
    }
}

impl Holonomic for JointTree {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let ground = Frame::ground();
        for &root in &self.roots {
            self.place_joint(&self.joints[root], &ground, &|i| q[i], bodies);
        }
    }
}

fn constant<T: Real>(vector: [f64; 3]) -> Vector3<T> {
    Vector3::from(vector.map(T::lit))
}

/// Rotation by an angle about a unit axis.
fn about<T: Real>(axis: [f64; 3], angle: T) -> Attitude<T> {
    let (s, c) = (angle * T::lit(0.5)).sin_cos();
    let [x, y, z] = axis.map(|x| T::lit(x) * s);
    Attitude { w: c, x, y, z }
}
