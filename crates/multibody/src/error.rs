//! What can be wrong with a tree of bodies or its state: each variant names the violated condition.

use piola_kinematics::KinematicsError;
use piola_numerics::Real;

/// A condition that a tree of rigid bodies or its state violates.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MultibodyError {
    /// A number is infinite or NaN.
    #[error("component {index} of `{quantity}` is {value}; it must be finite")]
    NotFinite {
        /// The name of the argument.
        quantity: &'static str,
        /// The component, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A slice of the wrong length.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The name of the argument.
        quantity: &'static str,
        /// The length needed.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// Two bodies, two joints or two frames with one name.
    #[error("there are two {what} named `{name}`; names must differ")]
    DuplicateName {
        /// "bodies", "joints", "frames", "classes" or "closures".
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A name that nothing has.
    #[error("there is no {what} named `{name}`")]
    NoSuchName {
        /// "body", "joint", "frame", "closure"; in files also "link", "class" or "site".
        what: &'static str,
        /// The name asked for.
        name: String,
    },
    /// An index beyond the last.
    #[error("there is no {what} {index}: the tree has {count}")]
    NoSuchIndex {
        /// "body", "joint" or "frame".
        what: &'static str,
        /// The index asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// |axis| = 1 is violated.
    #[error("the axis of joint `{joint}` has length {length}; it must be a unit vector")]
    AxisNotUnit {
        /// The joint's name.
        joint: String,
        /// The length of the axis.
        length: f64,
    },
    /// A quantity of a joint outside its range.
    #[error("the {quantity} of joint `{joint}` is {value}; it must satisfy {condition}")]
    InvalidJointData {
        /// The joint's name.
        joint: String,
        /// What the value is.
        quantity: &'static str,
        /// The value.
        value: f64,
        /// The condition.
        condition: &'static str,
    },
    /// The mass or the inertia of a body violates a condition of mechanics.
    #[error("body `{body}`: {source}")]
    InvalidInertia {
        /// The body's name.
        body: String,
        /// The condition.
        source: KinematicsError,
    },
    /// A joint moves nothing that has inertia along its motion: its acceleration does not exist.
    #[error(
        "joint `{joint}` moves no inertia (reduced inertia {inertia} along its motion); \
         give a body beyond it mass, away from the axis of a rotation, or the joint a reflected inertia"
    )]
    NoInertia {
        /// The joint's name.
        joint: String,
        /// The reduced inertia, kg or kg m².
        inertia: f64,
    },
    /// A body is so light that a motion of it meets no inertia, although joints beyond its own carry mass.
    #[error(
        "a motion of body `{body}` by joint `{joint}` meets no inertia (reduced inertia {inertia}): the body itself has a mass \
         of {mass} kg, the joints beyond it leave it free, and closures do not count here; give the body mass and inertia \
         about all axes, or the joint a reflected inertia"
    )]
    TooLightBody {
        /// The body's name.
        body: String,
        /// The joint that moves it.
        joint: String,
        /// The body's own mass, kg.
        mass: f64,
        /// The reduced inertia, kg or kg m²: zero where rounding leaves none.
        inertia: f64,
    },
    /// 0 < w < ∞ is violated by the rate below which friction is smooth.
    #[error("the slip rate is {slip_rate}; it must satisfy 0 < x < ∞")]
    InvalidSlipRate {
        /// The rate, rad/s and m/s.
        slip_rate: f64,
    },
    /// |q| = 1 is violated by a quaternion of the configuration.
    #[error("the quaternion of joint `{joint}` has length {length}; it must be a unit quaternion")]
    NotUnitQuaternion {
        /// The joint's name.
        joint: String,
        /// The quaternion's length.
        length: f64,
    },
    /// A closure whose data violate a condition.
    #[error("the {quantity} of closure `{closure}` is {value}; it must satisfy {condition}")]
    InvalidClosure {
        /// The closure's name.
        closure: String,
        /// What the value is.
        quantity: &'static str,
        /// The value.
        value: f64,
        /// The condition.
        condition: &'static str,
    },
    /// Conditions of closures that depend on each other ask for different motions.
    #[error("closure `{closure}` (condition {condition}) contradicts the others by {excess:e}")]
    Contradiction {
        /// The closure's name.
        closure: String,
        /// The condition among all, from 0.
        condition: usize,
        /// What is left of the condition's right-hand side, over the square root of its inertia.
        excess: f64,
    },
    /// A motion reached a singular position, and was asked to stop there.
    #[error(
        "the position at t = {t} s is singular: condition {condition} of closure `{closure}` depends on others there, \
         and the motion may branch"
    )]
    SingularConstraint {
        /// The closure's name.
        closure: String,
        /// The condition among all, from 0.
        condition: usize,
        /// The time, s.
        t: f64,
    },
    /// No state near the given one satisfies the closures.
    #[error("no state near the given one closes `{closure}`: its residual is still {residual:e}")]
    NoClosedState {
        /// The closure that is worst.
        closure: String,
        /// Its residual.
        residual: f64,
    },
    /// A step of an implicit method did not converge.
    #[error("the equations of a step did not converge: the last correction is {correction:e}; make the step shorter")]
    NoConvergence {
        /// The last correction, of the size of the coordinates.
        correction: f64,
    },
    /// A condition of linear algebra.
    #[error(transparent)]
    Numerics(piola_numerics::NumericsError),
    /// The text of a robot's file violates a condition.
    #[error("line {line}: {fault}")]
    InFile {
        /// The line, from 1.
        line: usize,
        /// The condition.
        fault: FileFault,
    },
    /// A robot's file cannot be read.
    #[error("cannot read {path}: {reason}")]
    UnreadableFile {
        /// The file.
        path: String,
        /// The reason given by the system.
        reason: String,
    },
    /// A robot's file is longer than those that are read.
    #[error("{path} has more than {limit} bytes, the most that a robot's file may have")]
    FileTooLong {
        /// The file.
        path: String,
        /// The most bytes that are read.
        limit: u64,
    },
    /// A violated condition in one of many states.
    #[error("state {state}: {source}")]
    InState {
        /// The state, from 0.
        state: usize,
        /// The condition.
        source: Box<MultibodyError>,
    },
    /// A workspace that was made for another tree.
    #[error("the workspace was made for {found} links; this tree has {expected}")]
    OtherWorkspace {
        /// Links of the tree.
        expected: usize,
        /// Links of the workspace.
        found: usize,
    },
}

/// What is wrong at a line of a robot's file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FileFault {
    /// The text is no XML.
    #[error("{reason}")]
    Syntax {
        /// What the parser found.
        reason: String,
    },
    /// An element that has a meaning for mechanics which is not read.
    #[error("`{element}` is not supported")]
    Unsupported {
        /// The element.
        element: String,
    },
    /// An attribute or an element is missing.
    #[error("`{element}` has no `{what}`")]
    Missing {
        /// What is missing.
        what: &'static str,
        /// Where it is missing.
        element: String,
    },
    /// An attribute does not hold as many finite numbers as it should.
    #[error("`{attribute}` is \"{text}\", which are not the finite numbers needed")]
    NotNumbers {
        /// The attribute.
        attribute: &'static str,
        /// Its text.
        text: String,
    },
    /// A word that is not one of those that an attribute may have.
    #[error("`{attribute}` is \"{text}\"; it must be {valid}")]
    NoSuchWord {
        /// The attribute.
        attribute: &'static str,
        /// Its text.
        text: String,
        /// What it may be.
        valid: &'static str,
    },
    /// Two attributes that say the same thing.
    #[error("`{element}` has `{first}` and `{second}`; one of them is enough")]
    TwoAttributes {
        /// The element.
        element: String,
        /// One attribute.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A number outside its range.
    #[error("`{attribute}` is {value}; it must satisfy {condition}")]
    OutOfRange {
        /// The attribute.
        attribute: &'static str,
        /// Its value.
        value: f64,
        /// The condition.
        condition: &'static str,
    },
    /// A number that must not be negative.
    #[error("`{attribute}` is {value}; it must not be negative")]
    Negative {
        /// The attribute.
        attribute: &'static str,
        /// Its value.
        value: f64,
    },
    /// A link is the child of two joints.
    #[error("link `{link}` is the child of two joints; a tree has one, and a loop is a constraint")]
    TwoParents {
        /// The link.
        link: String,
    },
    /// Every link has a parent.
    #[error("no link is the root: the joints go round")]
    NoRoot,
    /// Two links have no parent.
    #[error("links `{first}` and `{second}` have no parent; a tree has one root")]
    TwoRoots {
        /// The first root.
        first: String,
        /// The second root.
        second: String,
    },
    /// Some links are not reached from the root.
    #[error("{links} links are joined in a circle that the root does not reach")]
    Cycle {
        /// How many.
        links: usize,
    },
    /// An element names something that does not exist, or violates a condition of trees.
    #[error("{source}")]
    Invalid {
        /// The condition.
        source: Box<MultibodyError>,
    },
}

/// found = expected.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn check_length(quantity: &'static str, expected: usize, found: usize) -> Result<(), MultibodyError> {
    if found == expected { Ok(()) } else { Err(MultibodyError::WrongLength { quantity, expected, found }) }
}

/// Whether all values are finite in all lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn all_finite<T: Real>(values: &[T]) -> bool {
    use piola_numerics::Mask;
    // 0 x is NaN unless x is finite. Eight sums, for registers of any width.
    let mut sums = [T::zero(); 8];
    let mut eights = values.chunks_exact(8);
    for eight in &mut eights {
        for (sum, &value) in sums.iter_mut().zip(eight) {
            *sum += value * T::zero();
        }
    }
    for &value in eights.remainder() {
        sums[0] += value * T::zero();
    }
    let mut finite = T::Mask::splat(true);
    for sum in sums {
        finite = finite & sum.is_finite();
    }
    finite.all()
}

/// |values| < ∞ in all lanes.
pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), MultibodyError> {
    use piola_numerics::Mask;
    let Some((index, entry)) = values.iter().enumerate().find(|(_, entry)| !entry.is_finite().all()) else {
        return Ok(());
    };
    let value = (0..T::LANES).map(|lane| entry.primal(lane)).find(|value| !value.is_finite());
    Err(MultibodyError::NotFinite { quantity, index, value: value.unwrap_or(f64::NAN) })
}
