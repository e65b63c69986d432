//! The tables and keys themselves.

use super::{Absent, Key, Kind, Range, SceneKind, Table, Word, studies};
use crate::units::Dimension;

pub(super) const fn key(name: &'static str, kind: Kind, absent: Absent, doc: &'static str) -> Key {
    Key { name, kind, absent, only_for: &[], doc }
}

pub(super) const fn key_for(
    only_for: &'static [&'static str],
    name: &'static str,
    kind: Kind,
    absent: Absent,
    doc: &'static str,
) -> Key {
    Key { name, kind, absent, only_for, doc }
}

pub(super) const fn word(name: &'static str, doc: &'static str) -> Word {
    Word { name, doc }
}

pub(super) const fn quantity(dimension: Dimension, range: Range) -> Kind {
    Kind::Quantity(dimension, range)
}

const fn vector(dimension: Dimension) -> Kind {
    Kind::Numbers(dimension, &[3])
}

/// The kinds of scenes.
pub static SCENE_KINDS: [SceneKind; 5] = [
    motion("gravity", &["body"]),
    motion("mechanism", &["joint", "particle", "rigid_body"]),
    motion("central", &["body"]),
    study("wavefront", &["medium"]),
    study("room", &[]),
];

const fn motion(name: &'static str, lists: &'static [&'static str]) -> SceneKind {
    SceneKind { name, study: false, lists }
}

const fn study(name: &'static str, lists: &'static [&'static str]) -> SceneKind {
    SceneKind { name, study: true, lists }
}

/// A whole scene.
pub static SCENE: Table = Table {
    name: "scene",
    doc: "A scene has exactly one of the tables that say of what kind it is: `[gravity]`, `[mechanism]` and `[central]` move in time and need `[time]`; `[wavefront]` and `[room]` are studies without it.",
    keys: &[
        key(
            "name",
            Kind::Name,
            Absent::Optional,
            "Name of the scene, of its output folder and in its results. The file's name when absent.",
        ),
        key("title", Kind::Text, Absent::Optional, "Title of the figures."),
        key("gravity", Kind::Table(&GRAVITY), Absent::Optional, "Bodies that attract each other."),
        key("mechanism", Kind::Table(&MECHANISM), Absent::Optional, "Particles and rigid bodies on joints."),
        key("central", Kind::Table(&CENTRAL), Absent::Optional, "Bodies about a fixed centre of attraction."),
        key("wavefront", Kind::Table(&studies::WAVEFRONT), Absent::Optional, "Wave fronts and rays in a medium."),
        key("room", Kind::Table(&studies::ROOM), Absent::Optional, "First arrival of a signal in a room."),
        key("body", Kind::Tables(&BODY), Absent::Optional, "The bodies of `[gravity]` or `[central]`."),
        key(
            "joint",
            Kind::Tables(&JOINT),
            Absent::Optional,
            "The joints of a `[mechanism]`: a tree that grows from the ground.",
        ),
        key("particle", Kind::Tables(&PARTICLE), Absent::Optional, "Point masses of a `[mechanism]`."),
        key("rigid_body", Kind::Tables(&RIGID_BODY), Absent::Optional, "Rigid bodies of a `[mechanism]`."),
        key("medium", Kind::Tables(&studies::MEDIUM), Absent::Optional, "The parts of the medium of a `[wavefront]`."),
        key("time", Kind::Table(&TIME), Absent::Optional, "The span of time, which every motion has."),
        key(
            "integrator",
            Kind::Table(&INTEGRATOR),
            Absent::Optional,
            "How the equations are solved; chosen by the planner when absent.",
        ),
        key("output", Kind::Table(&OUTPUT), Absent::Optional, "What is written."),
        key("reference", Kind::Table(&REFERENCE), Absent::Optional, "What the result is compared with."),
    ],
};

static GRAVITY: Table = Table {
    name: "gravity",
    doc: "Bodies without extent that attract each other by Newton's law, in an inertial frame.",
    keys: &[
        key(
            "softening",
            quantity(Dimension::LENGTH, Range::NotNegative),
            Absent::Default("0.0"),
            "Length ε of 1/√(r² + ε²) in the potential; 0 for the true law.",
        ),
        key(
            "post_newtonian",
            Kind::Flag,
            Absent::Default("false"),
            "Whether the first post-Newtonian term of the central body acts: a force that depends on velocity.",
        ),
        key(
            "central_body",
            Kind::Name,
            Absent::Optional,
            "The body whose post-Newtonian term acts; the one with the largest `gm` when absent.",
        ),
    ],
};

static CENTRAL: Table = Table {
    name: "central",
    doc: "Bodies that do not attract each other, about a fixed centre of attraction at the origin.",
    keys: &[key(
        "gm",
        quantity(Dimension::GRAVITATIONAL_PARAMETER, Range::Positive),
        Absent::Required,
        "Gravitational parameter of the centre.",
    )],
};

static MECHANISM: Table = Table {
    name: "mechanism",
    doc: "Particles and rigid bodies on a tree of joints, without friction. The ground is named `ground`; z is up when gravity says so.",
    keys: &[key(
        "gravity",
        vector(Dimension::ACCELERATION),
        Absent::Default("[0.0, 0.0, -9.80665]"),
        "Uniform acceleration of gravity.",
    )],
};

static BODY: Table = Table {
    name: "body",
    doc: "A body without extent: in `[gravity]` with `gm` or `mass` and a state, in `[central]` with a state or orbital elements.",
    keys: &[
        key("name", Kind::Name, Absent::Required, "Name of the body, unlike any other."),
        key(
            "gm",
            quantity(Dimension::GRAVITATIONAL_PARAMETER, Range::Positive),
            Absent::Optional,
            "Gravitational parameter, known far better than the mass.",
        ),
        key(
            "mass",
            quantity(Dimension::MASS, Range::Positive),
            Absent::Optional,
            "Mass; either this or `gm`. Only scales energies in `[central]`, where it is 1 kg when absent.",
        ),
        key("position", vector(Dimension::LENGTH), Absent::Optional, "Position at the start."),
        key("velocity", vector(Dimension::SPEED), Absent::Optional, "Velocity at the start."),
        key(
            "semi_major_axis",
            quantity(Dimension::LENGTH, Range::Positive),
            Absent::Optional,
            "Semi-major axis of the orbit, instead of `position` and `velocity`.",
        ),
        key(
            "eccentricity",
            quantity(Dimension::NONE, Range::NotNegative),
            Absent::Optional,
            "Eccentricity of the orbit, less than 1.",
        ),
        key(
            "inclination",
            quantity(Dimension::ANGLE, Range::Any),
            Absent::Optional,
            "Inclination of the orbit to the x–y plane; 0 when absent.",
        ),
        key(
            "ascending_node",
            quantity(Dimension::ANGLE, Range::Any),
            Absent::Optional,
            "Longitude of the ascending node from the x axis; 0 when absent.",
        ),
        key(
            "argument_of_pericentre",
            quantity(Dimension::ANGLE, Range::Any),
            Absent::Optional,
            "Angle from the ascending node to the pericentre; 0 when absent.",
        ),
        key(
            "mean_anomaly",
            quantity(Dimension::ANGLE, Range::Any),
            Absent::Optional,
            "Mean anomaly at the start; 0, the pericentre, when absent.",
        ),
    ],
};

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

static JOINT: Table = Table {
    name: "joint",
    doc: "A joint between two frames. Its frame coincides with its parent's, moved by `offset`, when its coordinates are zero.",
    keys: &[
        key("name", Kind::Name, Absent::Required, "Name of the joint and of the frame that it carries."),
        key("parent", Kind::Name, Absent::Default("\"ground\""), "Joint whose frame carries this one."),
        key("type", Kind::Choice(&JOINT_TYPES), Absent::Required, "What it lets move."),
        key(
            "offset",
            vector(Dimension::LENGTH),
            Absent::Default("[0.0, 0.0, 0.0]"),
            "Place of the joint in its parent's frame.",
        ),
        key_for(ONE_AXIS, "axis", vector(Dimension::NONE), Absent::Required, "Direction of the axis, of any length."),
        key_for(
            &["universal"],
            "second_axis",
            vector(Dimension::NONE),
            Absent::Required,
            "Direction of the second axis after the first rotation.",
        ),
        key_for(
            &["revolute"],
            "angle",
            quantity(Dimension::ANGLE, Range::Any),
            Absent::Default("0.0"),
            "Angle at the start.",
        ),
        key_for(
            &["revolute"],
            "rate",
            quantity(Dimension::ANGULAR_RATE, Range::Any),
            Absent::Default("0.0"),
            "Rate of the angle at the start.",
        ),
        key_for(
            &["prismatic"],
            "displacement",
            quantity(Dimension::LENGTH, Range::Any),
            Absent::Default("0.0"),
            "Displacement at the start.",
        ),
        key_for(
            &["prismatic"],
            "speed",
            quantity(Dimension::SPEED, Range::Any),
            Absent::Default("0.0"),
            "Speed at the start.",
        ),
        key_for(
            &["free"],
            "shift",
            vector(Dimension::LENGTH),
            Absent::Default("[0.0, 0.0, 0.0]"),
            "Shift at the start.",
        ),
        key_for(
            &["free"],
            "velocity",
            vector(Dimension::SPEED),
            Absent::Default("[0.0, 0.0, 0.0]"),
            "Velocity of the shift at the start.",
        ),
        key_for(
            ROTATES,
            "angles",
            Kind::Numbers(Dimension::ANGLE, &[2, 3]),
            Absent::Required,
            "Angles at the start: two of a universal joint, three Eulerian angles otherwise.",
        ),
        key_for(
            ROTATES,
            "rates",
            Kind::Numbers(Dimension::ANGULAR_RATE, &[2, 3]),
            Absent::Optional,
            "Rates of the angles at the start; 0 when absent.",
        ),
    ],
};

static PARTICLE: Table = Table {
    name: "particle",
    doc: "A point mass that a joint carries.",
    keys: &[
        key("name", Kind::Name, Absent::Required, "Name, unlike any other."),
        key("joint", Kind::Name, Absent::Required, "Joint that carries it."),
        key("mass", quantity(Dimension::MASS, Range::Positive), Absent::Required, "Mass."),
        key("at", vector(Dimension::LENGTH), Absent::Default("[0.0, 0.0, 0.0]"), "Place in the joint's frame."),
    ],
};

static RIGID_BODY: Table = Table {
    name: "rigid_body",
    doc: "A rigid body that a joint carries.",
    keys: &[
        key("name", Kind::Name, Absent::Required, "Name, unlike any other."),
        key("joint", Kind::Name, Absent::Required, "Joint that carries it."),
        key("mass", quantity(Dimension::MASS, Range::Positive), Absent::Required, "Mass."),
        key(
            "inertia",
            Kind::Numbers(Dimension::INERTIA, &[3, 6, 9]),
            Absent::Required,
            "Inertia about the centre of mass in the joint's axes: principal moments, or 11, 22, 33, 12, 23, 13, or a full matrix by rows.",
        ),
        key(
            "at",
            vector(Dimension::LENGTH),
            Absent::Default("[0.0, 0.0, 0.0]"),
            "Place of the centre of mass in the joint's frame.",
        ),
    ],
};

static TIME: Table = Table {
    name: "time",
    doc: "The span of time. It ends at `end`, or after `revolutions` of the first body of `[central]`.",
    keys: &[
        key("start", quantity(Dimension::TIME, Range::Any), Absent::Default("0.0"), "Time at the start."),
        key("end", quantity(Dimension::TIME, Range::Any), Absent::Optional, "Time at the end; before the start for a run backwards in time."),
        key(
            "revolutions",
            quantity(Dimension::NONE, Range::Positive),
            Absent::Optional,
            "Periods of the first body instead of `end`, in `[central]` only.",
        ),
    ],
};

/// The methods of integration.
pub static METHODS: [Word; 10] = [
    word("auto", "chosen by the planner, which says why"),
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
];

static INTEGRATOR: Table = Table {
    name: "integrator",
    doc: "How the equations are solved.",
    keys: &[
        key("method", Kind::Choice(&METHODS), Absent::Default("\"auto\""), "Method of integration."),
        key(
            "step",
            quantity(Dimension::TIME, Range::Positive),
            Absent::Optional,
            "Step of a method of fixed step; chosen by the planner when absent.",
        ),
        key(
            "tolerance",
            quantity(Dimension::NONE, Range::Fraction),
            Absent::Optional,
            "Relative tolerance of a step of an adaptive method; 1e-12 when absent.",
        ),
    ],
};

static OUTPUT: Table = Table {
    name: "output",
    doc: "What is written. The summary always is.",
    keys: &[
        key(
            "folder",
            Kind::Text,
            Absent::Optional,
            "Folder of the results, relative to the current folder; `out/NAME` when absent.",
        ),
        key(
            "samples",
            Kind::Count { least: 2, most: 1_000_000 },
            Absent::Default("1001"),
            "Instants of a motion, evenly spread from start to end, at which the state is recorded. Those of the reference are added.",
        ),
        key("tables", Kind::Flag, Absent::Default("true"), "Whether CSV tables are written."),
        key("figures", Kind::Flag, Absent::Default("true"), "Whether SVG figures are drawn."),
    ],
};

/// Closed-form solutions that a result can be compared with.
static CLOSED_FORMS: [Word; 1] =
    [word("kepler", "elliptic motion about a fixed centre, by Kepler's equation from the rounded initial state")];

static REFERENCE: Table = Table {
    name: "reference",
    doc: "What the result is compared with: a table of positions, or a closed form.",
    keys: &[
        key(
            "file",
            Kind::Path,
            Absent::Optional,
            "Table with the columns `time_s`, `body`, `x_m`, `y_m`, `z_m`; lines that begin with `#` say where it comes from.",
        ),
        key("closed_form", Kind::Choice(&CLOSED_FORMS), Absent::Optional, "Closed form, instead of `file`."),
        key("label", Kind::Text, Absent::Optional, "What the reference is called in figures and on the terminal."),
        key(
            "relative_to",
            Kind::Name,
            Absent::Optional,
            "Body from which positions are measured: the relative error is that of the position relative to this body, over its distance from it. When absent, errors are divided by the largest distance of the reference from the origin; with a closed form, by the semi-major axis.",
        ),
    ],
};
