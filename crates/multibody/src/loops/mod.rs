//! Closed loops: trees whose bodies, frames or coordinates are tied together, by multipliers on the tree.
//!
//! ```text
//! M v̇ = τ − b + Gᵀ λ        G v̇ = γ        (G M⁻¹ Gᵀ) λ = γ − G v̇₀
//! ```
//!
//! v̇₀ is the acceleration without the ties. M⁻¹ Gᵀ is found along the tree, one column a condition, so that m conditions on n
//! links cost O(n m + m³).
//!
//! Conditions that depend on others are found by a factorisation that reveals the rank. Accelerations are unique all the same;
//! of the multipliers those of least norm are given, each measured by the square root of its inertia.

mod closure;
mod evaluation;
mod motion;
mod projection;
mod solve;

pub use closure::{BodyPoint, LoopClosure};
pub use motion::ClosedMotion;
pub use solve::LoopWorkspace;

use crate::error::MultibodyError;
use crate::tree::RigidTree;

/// A tree with closures.
///
/// # Example
/// A parallelogram of massless cranks that carries a bar of 2 kg on two hinges: it swings as a pendulum of 1 m, and from the
/// horizontal it starts at g/l.
/// ```
/// use piola_multibody::{
///     BodyIndex, BodyInertia, BodyPoint, ClosedTree, JointKind, LoopClosure, RigidTree, TreeJoint,
/// };
/// let y = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
/// let mut builder = RigidTree::builder();
/// let left = builder.attach(BodyIndex::GROUND, TreeJoint::new("a", y), "left", BodyInertia::MASSLESS)?;
/// let knee = TreeJoint::new("b", y).at([1.0, 0.0, 0.0]);
/// let rod = BodyInertia::new(2.0, [0.0, 0.0, -0.5], [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.1]])?;
/// let bar = builder.attach(left, knee, "bar", rod)?;
/// let ground = TreeJoint::new("c", y).at([0.0, 0.0, -1.0]);
/// let tip = BodyInertia::particle(1e-9, [1.0, 0.0, 0.0])?;
/// let right = builder.attach(BodyIndex::GROUND, ground, "right", tip)?;
/// let mut closed = ClosedTree::new(builder.build()?);
/// let [first, second] = [BodyPoint::new(bar, [0.0, 0.0, -1.0]), BodyPoint::new(right, [1.0, 0.0, 0.0])];
/// closed.close("loop", LoopClosure::Point { first, second })?;
/// let mut work = closed.workspace();
/// let mut acceleration = [0.0_f64; 3];
/// closed.accelerations(&mut work, &[0.0; 3], &[0.0; 3], &[0.0; 3], 0.0, &mut acceleration)?;
/// assert!((acceleration[0] - 9.81).abs() < 1e-7 && (acceleration[2] - 9.81).abs() < 1e-7);
/// assert_eq!(work.rank(), 2); // of three conditions: the one across the plane holds anyway
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("closed kinematic chain", "loop closure", "constraint"))]
#[derive(Clone, Debug)]
pub struct ClosedTree {
    tree: RigidTree,
    closures: Vec<(String, LoopClosure)>,
    conditions: usize,
}

impl ClosedTree {
    /// A tree without closures.
    #[must_use]
    pub const fn new(tree: RigidTree) -> Self {
        Self { tree, closures: Vec::new(), conditions: 0 }
    }

    /// Adds a closure.
    ///
    /// # Errors
    /// [`MultibodyError::DuplicateName`], [`MultibodyError::NoSuchIndex`], [`MultibodyError::NotFinite`],
    /// [`MultibodyError::InvalidClosure`].
    pub fn close(&mut self, name: impl Into<String>, closure: LoopClosure) -> Result<(), MultibodyError> {
        let name = name.into();
        if self.closures.iter().any(|(other, _)| *other == name) {
            return Err(MultibodyError::DuplicateName { what: "closures", name });
        }
        closure.check(&name, &self.tree)?;
        self.conditions += closure.conditions();
        self.closures.push((name, closure));
        Ok(())
    }

    /// The tree.
    #[must_use]
    pub const fn tree(&self) -> &RigidTree {
        &self.tree
    }

    /// Sets gravity (m/s², space components).
    ///
    /// # Errors
    /// [`MultibodyError::NotFinite`].
    pub fn set_gravity(&mut self, gravity: [f64; 3]) -> Result<(), MultibodyError> {
        self.tree.set_gravity(gravity)
    }

    /// Gives a joint of the tree other dampers and friction.
    ///
    /// # Errors
    /// As [`RigidTree::set_friction`].
    pub fn set_friction(&mut self, joint: usize, damping: f64, friction: f64) -> Result<(), MultibodyError> {
        self.tree.set_friction(joint, damping, friction)
    }

    /// Gives a joint of the tree another spring.
    ///
    /// # Errors
    /// As [`RigidTree::set_spring`].
    pub fn set_spring(&mut self, joint: usize, stiffness: f64, rest: f64) -> Result<(), MultibodyError> {
        self.tree.set_spring(joint, stiffness, rest)
    }

    /// The conditions of all closures, m.
    #[must_use]
    pub const fn conditions(&self) -> usize {
        self.conditions
    }

    /// The closure that a condition belongs to.
    #[must_use]
    pub fn closure_of(&self, condition: usize) -> &str {
        let mut first = 0;
        for (name, closure) in &self.closures {
            first += closure.conditions();
            if condition < first {
                return name;
            }
        }
        ""
    }

    /// The first condition of a closure.
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchName`].
    pub fn first_condition(&self, name: &str) -> Result<usize, MultibodyError> {
        let mut first = 0;
        for (other, closure) in &self.closures {
            if other == name {
                return Ok(first);
            }
            first += closure.conditions();
        }
        Err(MultibodyError::NoSuchName { what: "closure", name: name.to_owned() })
    }
}
