//! What can be wrong with a mechanism.

use piola_expression::ExpressionError;

/// A condition that the data of a mechanism violate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// A list of the wrong length.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The name of the list.
        quantity: &'static str,
        /// The length needed.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// An infinite or NaN number.
    #[error("component {index} of `{quantity}` is {value}; it must be finite")]
    NotFinite {
        /// The name of the quantity.
        quantity: &'static str,
        /// The component, counted over all joints or parts.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A checkpoint that another version of Piola made, whose steps may differ in their last bits.
    #[error("the checkpoint is of Piola {found}; this is Piola {expected}")]
    CheckpointOfOtherVersion {
        /// The version that made it.
        found: String,
        /// This version.
        expected: String,
    },
    /// A checkpoint of a run of another system or with other questions, by another method or at other instants.
    #[error("the checkpoint is of another run: its system, its questions, its method or its instants differ")]
    CheckpointOfOtherRun,
    /// A checkpoint whose contents do not have the fingerprint that was computed when it was made.
    #[error("the checkpoint was changed after it was made: its contents do not have the fingerprint that stands in it")]
    CheckpointChanged,
    /// |axis| = 1 violated.
    #[error("an axis of joint {joint} has the length {length}; it must be a unit vector")]
    AxisNotUnit {
        /// The index of the joint.
        joint: usize,
        /// The length of the axis.
        length: f64,
    },
    /// 0 < m < ∞ violated.
    #[error("the mass of part {part} is {value} kg; it must satisfy 0 < m < ∞")]
    InvalidMass {
        /// The index of the part.
        part: usize,
        /// The value given.
        value: f64,
    },
    /// An index beyond the last joint.
    #[error("there is no joint {joint}: the number of joints is {joints}")]
    NoSuchJoint {
        /// The index given.
        joint: usize,
        /// The number of joints.
        joints: usize,
    },
    /// Parents that do not lead to the ground.
    #[error("joint {joint} is on a cycle of joints; parents must lead to the ground")]
    CyclicJoints {
        /// The index of a joint that hangs on the cycle.
        joint: usize,
    },
    /// More joints on a path from the ground than the placement follows.
    #[error("joint {joint} is joint {depth} on its path from the ground; at most {most} are allowed")]
    TooDeep {
        /// The index of the joint.
        joint: usize,
        /// Joints on the path from the ground to it, itself included.
        depth: usize,
        /// The largest number allowed, [`DEEPEST`](crate::joints::DEEPEST).
        most: usize,
    },
    /// Nodes that are no expression.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// An index beyond the last coordinate.
    #[error("`{quantity}` has coordinate {coordinate}: the number of coordinates is {coordinates}")]
    NoSuchCoordinate {
        /// The name of what has it.
        quantity: &'static str,
        /// The index given.
        coordinate: usize,
        /// The number of coordinates.
        coordinates: usize,
    },
    /// A condition 0 ≤ x violated.
    #[error("`{quantity}` is {value}; it must be zero or more")]
    Negative {
        /// The name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A condition 0 < x violated.
    #[error("`{quantity}` is {value}; it must be greater than zero")]
    NotPositive {
        /// The name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// An expression of coordinates or rates where none may stand.
    #[error("`{quantity}` depends on coordinate {coordinate}; it may depend on the time alone")]
    DependsOnCoordinate {
        /// The name of what depends.
        quantity: &'static str,
        /// The index of the coordinate.
        coordinate: usize,
    },
    /// A method for H = T(p) + V(q) with another H.
    #[error("the method {method} needs H = T(p) + V(q); an implicit one as gauss-legendre-8 takes any H")]
    NotSeparable {
        /// The name of the method.
        method: String,
    },
    /// A method for q̈ = f(q) with an H whose equations have no such form.
    #[error(
        "the method {method} needs H = ½ p·W p + w·p + V(q) with a constant W; an explicit one as verner-98 takes any H"
    )]
    NoConstantInertia {
        /// The name of the method.
        method: String,
    },
    /// A closed form of a system that has none here.
    #[error(
        "the closed form is there for bodies on ellipses about a fixed centre, and for a symmetric top on one spherical joint with 0 < θ < π at the start, whose centre of mass is on the third axis of the joint, under gravity along −z alone: no force, no constraint"
    )]
    NoClosedForm,
    /// A direction that is no unit vector.
    #[error("the {quantity} has length {length}; it must be a unit vector")]
    NoUnitVector {
        /// What the direction is.
        quantity: &'static str,
        /// Its length.
        length: f64,
    },
    /// Rolling bodies beside constraints of other kinds.
    #[error(
        "the mechanism has constraints of type rolling and of other types; either all of its constraints are of type rolling, or none is"
    )]
    RollingWithOthers,
    /// A rate at the start that the rates which are free contradict.
    #[error(
        "the rate of `{coordinate}` is {given} at the start, but rolling without slip makes it {follows}: it follows \
         from the rates of the other coordinates"
    )]
    RateAgainstRolling {
        /// The name of the coordinate.
        coordinate: String,
        /// The rate given.
        given: f64,
        /// The rate that follows from the free ones.
        follows: f64,
    },
    /// A disc that lies flat on its plane at the start.
    #[error("the disc of `{constraint}` lies flat at the start: its axis is along the normal of the plane")]
    DiscFlat {
        /// The name of the constraint.
        constraint: String,
    },
    /// A method that constraints do not allow.
    #[error("the method {method} does not keep constraints: an adaptive one does, as dormand-prince-853")]
    ConstraintsNeedProjection {
        /// The name of the method.
        method: String,
    },
    /// An expression of rates where none may stand.
    #[error(
        "`{quantity}` depends on the rate of coordinate {coordinate}; it may depend on coordinates and on time alone"
    )]
    DependsOnRate {
        /// The name of what depends.
        quantity: &'static str,
        /// The index of the coordinate.
        coordinate: usize,
    },
}
