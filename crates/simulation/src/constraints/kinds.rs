//! Constraints as data.

use crate::expression::Expression;
use crate::joints::Anchor;

/// A constraint with its name.
///
/// # Example
/// See [`Mechanism::with_constraints`](crate::joints::Mechanism::with_constraints).
#[derive(Debug, Clone, PartialEq)]
pub struct Constraint {
    /// Name.
    pub name: String,
    /// What it holds.
    pub kind: ConstraintKind,
}

/// Kinds of constraints.
///
/// # Example
/// See [`Mechanism::with_constraints`](crate::joints::Mechanism::with_constraints).
#[derive(Debug, Clone, PartialEq)]
pub enum ConstraintKind {
    /// A massless rod between two points: φ = (|x₂ − x₁|² − l²)/(2 l).
    Distance {
        /// Its ends.
        ends: [Anchor; 2],
        /// Its length l, m, greater than zero.
        length: f64,
    },
    /// A closed loop: two points are one, φ = x₂ − x₁.
    Loop {
        /// The points.
        ends: [Anchor; 2],
    },
    /// A sphere or a thin disc that rolls on a plane, on which it stands at the start: the velocity of its material point in contact is
    /// zero.
    Rolling {
        /// Its centre.
        centre: Anchor,
        /// Radius R, m, greater than zero.
        radius: f64,
        /// The axis of a disc, a unit vector in the frame of its joint; none of a sphere.
        axis: Option<[f64; 3]>,
        /// The normal of the plane in space, a unit vector that points to the side of the body.
        normal: [f64; 3],
    },
    /// A coordinate that moves as prescribed: φ = q − f(t).
    Prescribed {
        /// The coordinate.
        coordinate: usize,
        /// f, an expression of the time.
        motion: Expression,
    },
}
