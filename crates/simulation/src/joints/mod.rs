//! Trees of joints with particles and rigid bodies: a placement map made of data.

mod anchor;
mod build;
mod independence;
mod islands;
mod mechanism;
mod reduction;
mod top;

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Holonomic, Placement};
use piola_numerics::Real;

pub use anchor::Anchor;
pub(crate) use build::finite;
pub use build::{Coordinate, DEEPEST, Joint, JointMotion, Part, PartKind};
pub use islands::Island;
pub use mechanism::{Mechanism, PartName};
pub use reduction::Reduction;
pub(crate) use top::ClosedTop;

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
        q: &dyn Fn(usize) -> T,
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
    fn frame<T: Real>(&self, below: &Frame<T>, q: &dyn Fn(usize) -> T) -> Frame<T> {
        let q_j = |i: usize| q(self.first + i);
        // Displacements and turns are collected first: over derivatives each product of attitudes is much code.
        let mut shift = constant(self.offset);
        let (mut axes, mut angles): ([Option<&[f64; 3]>; 2], _) = ([None; 2], None);
        match &self.motion {
            JointMotion::Fixed => {}
            JointMotion::Revolute(axis) => axes[0] = Some(axis),
            JointMotion::Prismatic(axis) => {
                let along = q_j(0);
                shift += constant(*axis).map(|x: T| x * along);
            }
            JointMotion::Universal(first, second) => axes = [Some(first), Some(second)],
            JointMotion::Spherical => angles = Some(0),
            JointMotion::Free => {
                shift += Vector3::new(q_j(0), q_j(1), q_j(2));
                angles = Some(3);
            }
        }
        let origin = below.origin + below.attitude.to_space(&shift);
        let mut attitude = below.attitude;
        for (i, axis) in axes.into_iter().flatten().enumerate() {
            attitude = attitude.product(about(*axis, q_j(i)));
        }
        if let Some(first) = angles {
            attitude = attitude.product(Attitude::from_euler_zyz([q_j(first), q_j(first + 1), q_j(first + 2)]));
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
