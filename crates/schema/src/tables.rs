//! The tables and keys themselves.

use piola_document::table;
use piola_document::units::Dimension as D;

use super::Absent::{Default, Optional, Required};
use super::Kind::{Flag, Name, Path, Text, Texts};
use super::Range::{Any, Fraction, NotNegative, Positive};
use super::{Kind, SceneKind, Word, boxes, forces, phase, quantity, robot, solids, studies, word};

const fn vector(dimension: D) -> Kind {
    Kind::Numbers(dimension, &[3])
}

/// The kinds of scenes.
pub static SCENE_KINDS: [SceneKind; 13] = [
    motion("gravity", &["body"]),
    motion("mechanism", &["joint", "particle", "rigid_body", "force", "constraint", "parameters", "questions"]),
    motion("central", &["body"]),
    motion("hamiltonian", &["coordinate", "parameters", "questions", "bracket", "new_coordinate"]),
    study("wavefront", &["medium"]),
    study("room", &[]),
    study("balloon", &["law"]),
    study("torsion", &["law"]),
    study("bending", &["law"]),
    study("dislocation", &[]),
    study("laminated_tube", &["law", "layer"]),
    study("box", &["load", "start", "probe"]),
    study("robot", &["drive", "closure"]),
];

const fn motion(name: &'static str, lists: &'static [&'static str]) -> SceneKind {
    SceneKind { name, study: false, lists }
}

const fn study(name: &'static str, lists: &'static [&'static str]) -> SceneKind {
    SceneKind { name, study: true, lists }
}

table! {
    /// A scene has exactly one of the tables that say of what kind it is: `[gravity]`, `[mechanism]`, `[central]`,
    /// `[hamiltonian]` and `[robot]` move in time and need `[time]`; all others are studies without it. A `[box]` has its times in
    /// its own table.
    pub static SCENE = "scene" {
        /// Version of the format that the file is written in.
        format: Kind::Count { least: 1, most: 1 }, Default("1");
        /// Files with parts of the scene, relative to the file that names them; its own values hold over theirs.
        include: Texts, Optional;
        /// Name of the scene, of its output folder and in its results. The file's name when absent.
        name: Name, Optional;
        /// Title of the figures.
        title: Text, Optional;
        /// Bodies that attract each other.
        gravity: Kind::Table(&GRAVITY), Optional;
        /// Particles and rigid bodies on joints.
        mechanism: Kind::Table(&MECHANISM), Optional;
        /// Bodies about a fixed centre of attraction.
        central: Kind::Table(&CENTRAL), Optional;
        /// Coordinates and momenta under a Hamiltonian that is an expression.
        hamiltonian: Kind::Table(&phase::HAMILTONIAN), Optional;
        /// Wave fronts and rays in a medium.
        wavefront: Kind::Table(&studies::WAVEFRONT), Optional;
        /// First arrival of a signal in a room.
        room: Kind::Table(&studies::ROOM), Optional;
        /// Inflation of a spherical shell.
        balloon: Kind::Table(&solids::BALLOON), Optional;
        /// A twisted rod or tube.
        torsion: Kind::Table(&solids::TORSION), Optional;
        /// A bent block.
        bending: Kind::Table(&solids::BENDING), Optional;
        /// A crystal with screw dislocations.
        dislocation: Kind::Table(&solids::DISLOCATION), Optional;
        /// A tube with residual stress.
        laminated_tube: Kind::Table(&solids::LAMINATED_TUBE), Optional;
        /// The law of a `[balloon]`, `[torsion]`, `[bending]` or `[laminated_tube]`.
        law: Kind::Table(&solids::LAW), Optional;
        /// The layers of a `[laminated_tube]`, from the innermost.
        layer: Kind::Tables(&solids::LAYER), Optional;
        /// Elastic or viscous fields on a rectangle or a box.
        box: Kind::Table(&boxes::BOX), Optional;
        /// The forces on the body in a `[box]`.
        load: Kind::Tables(&boxes::LOAD), Optional;
        /// The state from which a `[box]` of the type `motion` starts.
        start: Kind::Tables(&boxes::START), Optional;
        /// Places in a `[box]` at which the result is recorded.
        probe: Kind::Tables(&boxes::PROBE), Optional;
        /// A tree of rigid bodies from a URDF or MJCF file.
        robot: Kind::Table(&robot::ROBOT), Optional;
        /// Joints of a `[robot]`: where they start and what drives them.
        drive: Kind::Tables(&robot::DRIVE), Optional;
        /// Closed loops of a `[robot]`.
        closure: Kind::Tables(&robot::CLOSURE), Optional;
        /// The bodies of `[gravity]` or `[central]`.
        body: Kind::Tables(&BODY), Optional;
        /// The joints of a `[mechanism]`: a tree that grows from the ground.
        joint: Kind::Tables(&JOINT), Optional;
        /// Point masses of a `[mechanism]`.
        particle: Kind::Tables(&PARTICLE), Optional;
        /// Rigid bodies of a `[mechanism]`.
        rigid_body: Kind::Tables(&RIGID_BODY), Optional;
        /// The coordinates of a `[hamiltonian]`.
        coordinate: Kind::Tables(&phase::COORDINATE), Optional;
        /// Poisson brackets to be evaluated along the motion of a `[hamiltonian]`.
        bracket: Kind::Tables(&phase::BRACKET), Optional;
        /// A change of variables of a `[hamiltonian]`, tested for being canonical.
        new_coordinate: Kind::Tables(&phase::NEW_COORDINATE), Optional;
        /// What is asked of a `[mechanism]` or a `[hamiltonian]` besides its motion.
        questions: Kind::Table(&phase::QUESTIONS), Optional;
        /// What acts on a `[mechanism]` besides gravity.
        force: Kind::Tables(&forces::FORCE), Optional;
        /// What holds a `[mechanism]` besides its joints.
        constraint: Kind::Tables(&forces::CONSTRAINT), Optional;
        /// Numbers with names for expressions; `--set parameters.NAME=VALUE` changes one.
        parameters: Kind::Parameters, Optional;
        /// The parts of the medium of a `[wavefront]`.
        medium: Kind::Tables(&studies::MEDIUM), Optional;
        /// The span of time, which every motion has.
        time: Kind::Table(&TIME), Optional;
        /// How the equations are solved; chosen by the planner when absent.
        integrator: Kind::Table(&INTEGRATOR), Optional;
        /// The files that are written.
        output: Kind::Table(&OUTPUT), Optional;
        /// The reference for the result.
        reference: Kind::Table(&REFERENCE), Optional;
    }
}

table! {
    /// Bodies without extent that attract each other by Newton's law, in an inertial frame.
    static GRAVITY = "gravity" {
        /// Length ε of 1/√(r² + ε²) in the potential; 0 for the true law.
        softening: quantity(D::LENGTH, NotNegative), Default("0.0");
        /// Whether the first post-Newtonian term of the central body acts: a force that depends on velocity.
        post_newtonian: Flag, Default("false");
        /// The body whose post-Newtonian term acts; the one with the largest `gm` when absent.
        central_body: Name, Optional;
    }
}

table! {
    /// Bodies that do not attract each other, about a fixed centre of attraction at the origin.
    static CENTRAL = "central" {
        /// Gravitational parameter of the centre.
        gm: quantity(D::GRAVITATIONAL_PARAMETER, Positive), Required;
    }
}

table! {
    /// Particles and rigid bodies on a tree of joints. The ground is named `ground`; z is up when gravity says so. Besides
    /// gravity only what the `[[force]]` tables say acts on it.
    static MECHANISM = "mechanism" {
        /// Uniform acceleration of gravity.
        gravity: vector(D::ACCELERATION), Default("[0.0, 0.0, -9.80665]");
    }
}

table! {
    /// A body without extent: in `[gravity]` with `gm` or `mass` and a state, in `[central]` with a state or orbital
    /// elements.
    static BODY = "body" {
        /// Name of the body, unlike any other.
        name: Name, Required;
        /// Gravitational parameter, known far better than the mass.
        gm: quantity(D::GRAVITATIONAL_PARAMETER, Positive), Optional;
        /// Mass; either this or `gm`. Only scales energies in `[central]`, where it is 1 kg when absent.
        mass: quantity(D::MASS, Positive), Optional;
        /// Position at the start.
        position: vector(D::LENGTH), Optional;
        /// Velocity at the start.
        velocity: vector(D::SPEED), Optional;
        /// Semi-major axis of the orbit, instead of `position` and `velocity`.
        semi_major_axis: quantity(D::LENGTH, Positive), Optional;
        /// Eccentricity of the orbit, less than 1.
        eccentricity: quantity(D::NONE, NotNegative), Optional;
        /// Inclination of the orbit to the x–y plane; 0 when absent.
        inclination: quantity(D::ANGLE, Any), Optional;
        /// Longitude of the ascending node from the x axis; 0 when absent.
        ascending_node: quantity(D::ANGLE, Any), Optional;
        /// Angle from the ascending node to the pericentre; 0 when absent.
        argument_of_pericentre: quantity(D::ANGLE, Any), Optional;
        /// Mean anomaly at the start; 0, the pericentre, when absent.
        mean_anomaly: quantity(D::ANGLE, Any), Optional;
    }
}

/// The kinds of joints.
pub static JOINT_TYPES: [Word; 6] = [
    word("fixed", "no freedom: a frame of its own at an offset"),
    word("revolute", "rotation by `angle` about `axis`"),
    word("prismatic", "shift by `displacement` along `axis`"),
    word("universal", "rotation by `angles[0]` about `axis`, then by `angles[1]` about `second_axis` carried along"),
    word(
        "spherical",
        "rotation by the Eulerian angles z–y–z in `angles`; singular where the second is a multiple of 180°",
    ),
    word("free", "shift by `shift` along the axes of the parent, then rotation as `spherical`"),
];

const ONE_AXIS: &[&str] = &["revolute", "prismatic", "universal"];
const ROTATES: &[&str] = &["universal", "spherical", "free"];

table! {
    /// A joint between two frames. Its frame coincides with its parent's, moved by `offset`, when its coordinates are
    /// zero.
    static JOINT = "joint" {
        /// Name of the joint and of the frame that it carries.
        name: Name, Required;
        /// Joint whose frame carries this one.
        parent: Name, Default("\"ground\"");
        /// The freedom it gives.
        type: Kind::Choice(&JOINT_TYPES), Required;
        /// Place of the joint in its parent's frame.
        offset: vector(D::LENGTH), Default("[0.0, 0.0, 0.0]");
        /// Direction of the axis, of any length.
        axis: vector(D::NONE), Required, only_for ONE_AXIS;
        /// Direction of the second axis after the first rotation.
        second_axis: vector(D::NONE), Required, only_for &["universal"];
        /// Angle at the start.
        angle: quantity(D::ANGLE, Any), Default("0.0"), only_for &["revolute"];
        /// Rate of the angle at the start.
        rate: quantity(D::ANGULAR_RATE, Any), Default("0.0"), only_for &["revolute"];
        /// Displacement at the start.
        displacement: quantity(D::LENGTH, Any), Default("0.0"), only_for &["prismatic"];
        /// Speed at the start.
        speed: quantity(D::SPEED, Any), Default("0.0"), only_for &["prismatic"];
        /// Shift at the start.
        shift: vector(D::LENGTH), Default("[0.0, 0.0, 0.0]"), only_for &["free"];
        /// Velocity of the shift at the start.
        velocity: vector(D::SPEED), Default("[0.0, 0.0, 0.0]"), only_for &["free"];
        /// Angles at the start: two of a universal joint, three Eulerian angles otherwise.
        angles: Kind::Numbers(D::ANGLE, &[2, 3]), Required, only_for ROTATES;
        /// Rates of the angles at the start; 0 when absent.
        rates: Kind::Numbers(D::ANGULAR_RATE, &[2, 3]), Optional, only_for ROTATES;
    }
}

table! {
    /// A point mass that a joint carries.
    static PARTICLE = "particle" {
        /// Name, unlike any other.
        name: Name, Required;
        /// Joint that carries it.
        joint: Name, Required;
        /// Mass.
        mass: quantity(D::MASS, Positive), Required;
        /// Place in the joint's frame.
        at: vector(D::LENGTH), Default("[0.0, 0.0, 0.0]");
    }
}

table! {
    /// A rigid body that a joint carries.
    static RIGID_BODY = "rigid_body" {
        /// Name, unlike any other.
        name: Name, Required;
        /// Joint that carries it.
        joint: Name, Required;
        /// Mass.
        mass: quantity(D::MASS, Positive), Required;
        /// Inertia about the centre of mass in the joint's axes: principal moments, or 11, 22, 33, 12, 23, 13, or a
        /// full matrix by rows.
        inertia: Kind::Numbers(D::INERTIA, &[3, 6, 9]), Required;
        /// Place of the centre of mass in the joint's frame.
        at: vector(D::LENGTH), Default("[0.0, 0.0, 0.0]");
    }
}

table! {
    /// The span of time. It ends at `end`, or after `revolutions` of the first body of `[central]`.
    static TIME = "time" {
        /// Time at the start.
        start: quantity(D::TIME, Any), Default("0.0");
        /// Time at the end; before the start for a run backwards in time.
        end: quantity(D::TIME, Any), Optional;
        /// Periods of the first body instead of `end`, in `[central]` only.
        revolutions: quantity(D::NONE, Positive), Optional;
    }
}

/// The methods of integration.
pub static METHODS: [Word; 14] = [
    word(
        "auto",
        "chosen by the planner, which says why; ellipses of `[central]` and a heavy symmetric top take their closed forms, unless `step`, `tolerance` or `closed_form` of `[reference]` is given",
    ),
    word(
        "composition-2",
        "symmetric symplectic composition of order 2, explicit, fixed step; forces must not depend on velocity",
    ),
    word("composition-4", "the same of order 4"),
    word("composition-6", "the same of order 6"),
    word("composition-8", "the same of order 8"),
    word("gauss-legendre-2", "Gauss–Legendre collocation of order 2, implicit, symplectic, fixed step"),
    word("gauss-legendre-4", "the same of order 4"),
    word("gauss-legendre-6", "the same of order 6"),
    word("gauss-legendre-8", "the same of order 8"),
    word("dormand-prince-853", "explicit Runge–Kutta of order 8(5,3), adaptive step"),
    word("verner-98", "explicit Runge–Kutta of order 9(8), adaptive step"),
    word("nystrom-86", "explicit Nyström of order 8(6), adaptive step; forces must not depend on velocity"),
    word("nystrom-1210", "the same of order 12(10)"),
    word(
        "closed-form",
        "Kepler's motion or that of Lagrange's top at every instant, without steps: for ellipses of `[central]`, or one body of a `[mechanism]` on a spherical joint, symmetric about its third axis with the centre of mass on it, the second angle between 0 and π at the start, under gravity along −z alone, without `[[force]]` and `[[constraint]]`",
    ),
];

table! {
    /// How the equations are solved.
    static INTEGRATOR = "integrator" {
        /// Method of integration.
        method: Kind::Choice(&METHODS), Default("\"auto\"");
        /// Step of a method of fixed step; chosen by the planner when absent.
        step: quantity(D::TIME, Positive), Optional;
        /// Relative tolerance of a step of an adaptive method, at least 4.5e-16. When absent, 1e-12 for a `method` that is named, and for
        /// bodies that attract each other where none dominates; else one at which the errors of the method are about those of rounding.
        /// The plan shows it.
        tolerance: quantity(D::NONE, Fraction), Optional;
        /// Whether steps see of a `[mechanism]` only what moves: adaptive methods integrate independent parts by themselves, each with
        /// steps of its own; parts that stand still are left out, and fixed joints are merged with those that carry them.
        simplify: Flag, Default("true");
    }
}

table! {
    /// The files that are written. The summary always is.
    static OUTPUT = "output" {
        /// Folder of the results, relative to the current folder; `out/NAME` when absent.
        folder: Text, Optional;
        /// Instants of a motion, evenly spread from start to end, at which the state is recorded. Those of the
        /// reference are added.
        samples: Kind::Count { least: 2, most: 1_000_000 }, Default("1001");
        /// Whether CSV tables are written.
        tables: Flag, Default("true");
        /// Whether SVG figures are drawn.
        figures: Flag, Default("true");
        /// Whether the forces and moments that hold the parts of a `[mechanism]`, and the forces of its constraints and drives,
        /// are recorded.
        reactions: Flag, Default("false");
    }
}

/// Closed-form solutions that a result can be compared with.
static CLOSED_FORMS: [Word; 1] =
    [word("kepler", "elliptic motion about a fixed centre, by Kepler's equation from the rounded initial state")];

table! {
    /// The reference for the result: a table of positions, or a closed form.
    static REFERENCE = "reference" {
        /// Table with the columns `time_s`, `body`, `x_m`, `y_m`, `z_m`; lines that begin with `#` say where it comes
        /// from.
        file: Path, Optional;
        /// Closed form, instead of `file`.
        closed_form: Kind::Choice(&CLOSED_FORMS), Optional;
        /// Name of the reference in figures and on the terminal.
        label: Text, Optional;
        /// Body from which positions are measured: the relative error is that of the position relative to this body,
        /// over its distance from it. When absent, errors are divided by the largest distance of the reference from the
        /// origin; with a closed form, by the semi-major axis.
        relative_to: Name, Optional;
    }
}
