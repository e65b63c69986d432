//! The tables of robots.

use piola_document::table;
use piola_document::units::Dimension as D;

use super::Absent::{Default, Optional, Required};
use super::Kind::{Flag, Name, Path, Text};
use super::Range::{Any, NotNegative, Positive};
use super::{Kind, Word, quantity, word};

const fn vector(dimension: D) -> Kind {
    Kind::Numbers(dimension, &[3])
}

static BASES: [Word; 2] =
    [word("fixed", "the root stands on the ground"), word("free", "the root moves: `position`, `attitude` and rates")];

static INERTIAS: [Word; 2] = [
    word("checked", "inertias that are physically impossible are refused, with the line"),
    word("as-given", "inertias are used as the file has them"),
];

static SINGULAR: [Word; 2] = [
    word("pass", "the motion goes on along the branch of its velocity; the summary lists the positions"),
    word("stop", "the run ends before the first of them, as failed"),
];

static JOINT_FORCES: [Word; 2] = [
    word(
        "file",
        "springs, dampers and Coulomb friction act as the file gives them, unless a `[[drive]]` replaces them",
    ),
    word("none", "those of the file do not act; a `[[drive]]` may still give some"),
];

table! {
    /// A tree of rigid bodies from a URDF or MJCF file, with the span of time in `[time]`. `[integrator]` may have a
    /// `tolerance`, 1e-9 when absent: relative, and absolute in m, rad, m/s and rad/s. Limits of joints are not enforced: the
    /// summary names the joints that leave them. Motors of the file are not driven.
    pub(super) static ROBOT = "robot" {
        /// The URDF or MJCF file, relative to the file that names it. MJCF is what has `mujoco` as its first element.
        file: Path, Required;
        /// How the root of a URDF file stands. An MJCF file says it itself.
        base: Kind::Choice(&BASES), Default("\"fixed\"");
        /// Whether inertias of the file are checked.
        inertias: Kind::Choice(&INERTIAS), Default("\"checked\"");
        /// Uniform acceleration of gravity; when absent that of the MJCF file, or `[0, 0, -9.80665]` with a URDF file.
        gravity: vector(D::ACCELERATION), Optional;
        /// Place of a free root at the start.
        position: vector(D::LENGTH), Default("[0.0, 0.0, 0.0]");
        /// Attitude of a free root at the start: roll, pitch and yaw as in the file.
        attitude: vector(D::ANGLE), Default("[0.0, 0.0, 0.0]");
        /// Velocity of the origin of a free root at the start, along its own axes.
        velocity: vector(D::SPEED), Default("[0.0, 0.0, 0.0]");
        /// Angular velocity of a free root at the start, about its own axes.
        angular_velocity: vector(D::ANGULAR_RATE), Default("[0.0, 0.0, 0.0]");
        /// Whether the springs, dampers and friction that the file gives its joints act. Reflected inertias (`armature`) always do.
        joint_forces: Kind::Choice(&JOINT_FORCES), Default("\"file\"");
        /// Rate w of a joint, rad/s or m/s, below which Coulomb friction f is smoothed: −f tanh(v/w). A joint that ought to stick
        /// creeps, slower than w while its load is below 0.76 f. A smaller rate takes smaller steps.
        slip_rate: quantity(D::NONE, Positive), Default("0.01");
        /// Positions in which closures depend on each other.
        singular_positions: Kind::Choice(&SINGULAR), Default("\"pass\"");
        /// Whether the motion is written as `motion.gltf`, for viewers of glTF 2.0.
        animation: Flag, Default("false");
    }
}

table! {
    /// A joint of the file: where it starts and what drives it. Joints without a table start where the file places them
    /// (URDF: at zero), at rest, with the damping, friction and springs of the file. Numbers without a unit are in SI units.
    pub(super) static DRIVE = "drive" {
        /// The joint's name in the file.
        name: Text, Required;
        /// Angle of a rotating joint at the start.
        angle: quantity(D::ANGLE, Any), Optional;
        /// Its rate.
        rate: quantity(D::ANGULAR_RATE, Any), Optional;
        /// Displacement of a sliding joint at the start.
        displacement: quantity(D::LENGTH, Any), Optional;
        /// Its speed.
        speed: quantity(D::SPEED, Any), Optional;
        /// Constant torque of a rotating joint.
        torque: quantity(D::MOMENT, Any), Optional;
        /// Constant force of a sliding joint.
        force: quantity(D::FORCE, Any), Optional;
        /// Viscous damping, N m s or N s/m; that of the file when absent.
        damping: quantity(D::NONE, NotNegative), Optional;
        /// Coulomb friction, N m or N; that of the file when absent.
        friction: quantity(D::NONE, NotNegative), Optional;
        /// Stiffness of a spring, N m/rad or N/m; that of the file when absent.
        stiffness: quantity(D::NONE, NotNegative), Optional;
        /// Coordinate, rad or m, at which the spring is at rest; that of the file when absent.
        rest: quantity(D::NONE, Any), Optional;
        /// Whether the joint stays as it starts.
        locked: Flag, Default("false");
    }
}

static CLOSURES: [Word; 3] = [
    word("point", "two points coincide: three conditions"),
    word("hinge", "two points coincide and two axes are parallel: five conditions"),
    word(
        "frame",
        "the axes of both links coincide at two points: seven conditions, six of them independent; the start decides which way round it closes",
    ),
];

table! {
    /// A loop of links of a `[robot]`, closed where its tree is cut.
    pub(super) static CLOSURE = "closure" {
        /// Name, unlike any other.
        name: Name, Required;
        /// What coincides.
        type: Kind::Choice(&CLOSURES), Default("\"point\"");
        /// A link of the file, or `ground`.
        first: Text, Required;
        /// The point on it, in its frame.
        first_at: vector(D::LENGTH), Default("[0.0, 0.0, 0.0]");
        /// The axis on it, in its frame, of any length.
        first_axis: vector(D::NONE), Default("[0.0, 0.0, 1.0]"), only_for &["hinge"];
        /// Another link of the file, or `ground`.
        second: Text, Required;
        /// The point on it, in its frame.
        second_at: vector(D::LENGTH), Default("[0.0, 0.0, 0.0]");
        /// The axis on it, in its frame, of any length.
        second_axis: vector(D::NONE), Default("[0.0, 0.0, 1.0]"), only_for &["hinge"];
    }
}
