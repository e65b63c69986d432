//! The keys of forces and constraints on mechanisms.

use piola_document::table;
use piola_document::units::Dimension as D;

use super::Absent::{Default, Optional, Required};
use super::Kind::{Name, Text};
use super::Range::{Any, NotNegative, Positive};
use super::{Kind, Word, quantity, word};

/// Stiffness, N/m.
const STIFFNESS: D = D::FORCE.over(D::LENGTH);
/// Damping and linear drag, N s/m.
const DAMPING: D = D::FORCE.over(D::SPEED);
/// Stiffness of a torsion spring, N m/rad.
const TORSIONAL_STIFFNESS: D = D::MOMENT.over(D::ANGLE);
/// Damping of a rotation, N m s/rad.
const TORSIONAL_DAMPING: D = D::MOMENT.over(D::ANGULAR_RATE);

/// The kinds of forces.
static FORCE_TYPES: [Word; 9] = [
    word("spring", "a spring with a damper between two points: ½ k (r − l)² is stored, −c ṙ acts along the line"),
    word("joint-spring", "a spring with a damper on a coordinate that is a length"),
    word("torsion-spring", "a spring with a damper on a coordinate that is an angle"),
    word("drag", "−(`linear` + `quadratic` |u|) u on a point, u its velocity in the medium"),
    word("uniform-field", "an acceleration of a part, or of all parts: gravity besides gravity"),
    word("constant-force", "one force in space on a point"),
    word("central-field", "attraction of a part, or of all parts, by a fixed centre: −m `gm`/r is stored"),
    word("motor", "a generalised force on a coordinate, by an expression of coordinates, rates and t"),
    word("potential", "stored energy, by an expression of coordinates and t; the forces are its exact derivatives"),
];

const LENGTH_SPRINGS: &[&str] = &["spring", "joint-spring"];
const ON_COORDINATES: &[&str] = &["joint-spring", "torsion-spring", "motor"];
const ON_PARTS: &[&str] = &["drag", "uniform-field", "constant-force", "central-field"];
const BETWEEN: &[&str] = &["spring"];

table! {
    /// A force on a `[mechanism]` besides gravity. What it stores belongs to the energy; what it takes or gives is counted as
    /// its work W, and the run reports the drift of E − W. A point is given by a joint, a particle or a rigid body, in whose
    /// frame `at` counts from its place; `ground` is at rest. A coordinate is named as in `coordinates.csv`: `elbow`, or
    /// `pivot.angles[0]`.
    ///
    /// An expression has numbers with units in brackets, as `2 [N m]`, numbers of `[parameters]`, coordinates by name,
    /// `rate(elbow)`, the time `t`, `pi`, the signs + - * / ^ and brackets, and sqrt, exp, ln, sin, cos, tan, asin, acos, atan,
    /// sinh, cosh, tanh, abs, sign, atan2, min, max. Dimensions are checked, angles counting as pure numbers. Names with spaces
    /// or hyphens stand between backquotes.
    pub(super) static FORCE = "force" {
        /// Name, unlike any other force.
        name: Name, Required;
        /// The law of the force.
        type: Kind::Choice(&FORCE_TYPES), Required;
        /// The joint, particle or rigid body that has the first end, or `ground`.
        from: Name, Required, only_for BETWEEN;
        /// The first end in its frame.
        from_at: Kind::Numbers(D::LENGTH, &[3]), Default("[0.0, 0.0, 0.0]"), only_for BETWEEN;
        /// The joint, particle or rigid body that has the second end, or `ground`.
        to: Name, Required, only_for BETWEEN;
        /// The second end in its frame.
        to_at: Kind::Numbers(D::LENGTH, &[3]), Default("[0.0, 0.0, 0.0]"), only_for BETWEEN;
        /// The coordinate on which it acts.
        coordinate: Text, Required, only_for ON_COORDINATES;
        /// Stiffness k.
        stiffness: quantity(STIFFNESS, NotNegative), Default("0.0"), only_for LENGTH_SPRINGS;
        /// Stiffness k of a rotation.
        torsional_stiffness: quantity(TORSIONAL_STIFFNESS, NotNegative), Default("0.0"), only_for &["torsion-spring"];
        /// Distance r of the ends at which the spring is without force.
        length: quantity(D::LENGTH, NotNegative), Default("0.0"), only_for BETWEEN;
        /// The coordinate at which the spring is without force.
        rest: quantity(D::LENGTH, Any), Default("0.0"), only_for &["joint-spring"];
        /// The coordinate at which the spring is without moment.
        rest_angle: quantity(D::ANGLE, Any), Default("0.0"), only_for &["torsion-spring"];
        /// Damping c.
        damping: quantity(DAMPING, NotNegative), Default("0.0"), only_for LENGTH_SPRINGS;
        /// Damping c of a rotation.
        torsional_damping: quantity(TORSIONAL_DAMPING, NotNegative), Default("0.0"), only_for &["torsion-spring"];
        /// The joint, particle or rigid body on which it acts; all particles and rigid bodies when absent.
        part: Name, Optional, only_for ON_PARTS;
        /// The point on which it acts, in the frame of `part`.
        at: Kind::Numbers(D::LENGTH, &[3]), Default("[0.0, 0.0, 0.0]"), only_for &["drag", "constant-force"];
        /// Coefficient of the speed.
        linear: quantity(DAMPING, NotNegative), Default("0.0"), only_for &["drag"];
        /// Coefficient of the square of the speed: ½ ρ C A.
        quadratic: quantity(D::MASS.over(D::LENGTH), NotNegative), Default("0.0"), only_for &["drag"];
        /// Velocity of the medium.
        wind: Kind::Numbers(D::SPEED, &[3]), Default("[0.0, 0.0, 0.0]"), only_for &["drag"];
        /// Acceleration by the field.
        acceleration: Kind::Numbers(D::ACCELERATION, &[3]), Required, only_for &["uniform-field"];
        /// The force, which keeps its direction in space.
        force: Kind::Numbers(D::FORCE, &[3]), Required, only_for &["constant-force"];
        /// The centre.
        centre: Kind::Numbers(D::LENGTH, &[3]), Default("[0.0, 0.0, 0.0]"), only_for &["central-field"];
        /// Gravitational parameter of the centre, negative of one that repels.
        gm: quantity(D::GRAVITATIONAL_PARAMETER, Any), Required, only_for &["central-field"];
        /// The generalised force: N on a length, N m on an angle.
        drive: Text, Required, only_for &["motor"];
        /// The stored energy, J.
        energy: Text, Required, only_for &["potential"];
    }
}

/// The kinds of constraints.
static CONSTRAINT_TYPES: [Word; 4] = [
    word("distance", "two points stay at one distance, as the ends of a rod without mass"),
    word("loop", "two points are one: a joint that closes a loop"),
    word(
        "rolling",
        "a sphere, or with `axis` a thin disc, rolls without slip on the plane on which it stands at the start; rates of lengths follow from those of angles, as the velocity of the centre from the turn; stands beside no other type",
    ),
    word("prescribed", "a coordinate moves as an expression of the time says; its drive does work"),
];

const TIES: &[&str] = &["distance", "loop"];

table! {
    /// A constraint on a `[mechanism]` besides its joints. The motion starts at the nearest state that satisfies all constraints, but
    /// for `rolling`: there the rates that are not free follow from the others, and one that is given otherwise is refused.
    /// Constraints that depend on others, as the third direction of a plane loop, do no harm.
    /// Their forces in `constraints.csv` are then not unique: the least are written. A singular position that the motion goes
    /// through, as a parallelogram on one line, stands in `summary.json`; such a run needs `integrator.tolerance = 1e-10`.
    pub(super) static CONSTRAINT = "constraint" {
        /// Name, unlike any other constraint.
        name: Name, Required;
        /// What it holds.
        type: Kind::Choice(&CONSTRAINT_TYPES), Required;
        /// The joint, particle or rigid body that has the first point, or `ground`.
        from: Name, Required, only_for TIES;
        /// The first point in its frame.
        from_at: Kind::Numbers(D::LENGTH, &[3]), Default("[0.0, 0.0, 0.0]"), only_for TIES;
        /// The joint, particle or rigid body that has the second point, or `ground`.
        to: Name, Required, only_for TIES;
        /// The second point in its frame.
        to_at: Kind::Numbers(D::LENGTH, &[3]), Default("[0.0, 0.0, 0.0]"), only_for TIES;
        /// The distance; that at the start when absent.
        length: quantity(D::LENGTH, Positive), Optional, only_for &["distance"];
        /// The joint, particle or rigid body whose place is the centre of the sphere or disc.
        body: Name, Required, only_for &["rolling"];
        /// The centre in its frame.
        centre_at: Kind::Numbers(D::LENGTH, &[3]), Default("[0.0, 0.0, 0.0]"), only_for &["rolling"];
        /// The radius.
        radius: quantity(D::LENGTH, Positive), Required, only_for &["rolling"];
        /// The axis of a disc in the frame of `body`, of any length; a sphere has none.
        axis: Kind::Numbers(D::NONE, &[3]), Optional, only_for &["rolling"];
        /// The normal of the plane in space, of any length, to the side of the body.
        normal: Kind::Numbers(D::NONE, &[3]), Default("[0.0, 0.0, 1.0]"), only_for &["rolling"];
        /// The coordinate that is prescribed.
        coordinate: Text, Required, only_for &["prescribed"];
        /// Its value, an expression of `t`.
        motion: Text, Required, only_for &["prescribed"];
    }
}
