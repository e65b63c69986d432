//! The tables of studies.

use super::tables::{key, key_for, quantity, word};
use super::{Absent, Kind, Range, Table, Word};
use crate::units::Dimension;

const fn pair(dimension: Dimension) -> Kind {
    Kind::Numbers(dimension, &[2])
}

const INVERSE_LENGTH: Dimension = Dimension::NONE.over(Dimension::LENGTH);

static SOURCES: [Word; 2] =
    [word("plane", "a straight front of some width"), word("point", "all directions, or some, from one place")];

static KEPT: [Word; 2] = [
    word("all", "fronts keep all their sheets, swallow-tails among them"),
    word("first", "of each front only what arrives first"),
];

pub(super) static WAVEFRONT: Table = Table {
    name: "wavefront",
    doc: "Wave fronts in a plane medium of refractive index n(x, y) from a source, with rays and caustics. Fronts are levels of the optical length ∫ n ds; divided by the speed of light it is the time of travel.",
    keys: &[
        key("type", Kind::Choice(&SOURCES), Absent::Required, "The source."),
        key(
            "position",
            pair(Dimension::LENGTH),
            Absent::Default("[0.0, 0.0]"),
            "The source, or the middle of a plane one.",
        ),
        key_for(
            &["plane"],
            "direction",
            pair(Dimension::NONE),
            Absent::Default("[1.0, 0.0]"),
            "Direction of the rays at the source, of any length.",
        ),
        key_for(
            &["plane"],
            "width",
            quantity(Dimension::LENGTH, Range::Positive),
            Absent::Required,
            "Width of the source.",
        ),
        key_for(
            &["point"],
            "from",
            quantity(Dimension::ANGLE, Range::Any),
            Absent::Default("0.0"),
            "First direction, from the x axis.",
        ),
        key_for(
            &["point"],
            "to",
            quantity(Dimension::ANGLE, Range::Any),
            Absent::Optional,
            "Last direction, at most a full turn after the first; a full turn when absent.",
        ),
        key(
            "length",
            quantity(Dimension::LENGTH, Range::Positive),
            Absent::Required,
            "Optical length ∫ n ds to which rays are followed.",
        ),
        key(
            "fronts",
            Kind::Count { least: 1, most: 500 },
            Absent::Default("30"),
            "Number of fronts, evenly spread over the length.",
        ),
        key("rays", Kind::Count { least: 3, most: 20_000 }, Absent::Default("401"), "Number of rays to begin with."),
        key(
            "spacing",
            quantity(Dimension::LENGTH, Range::Positive),
            Absent::Optional,
            "Largest distance of neighbours on a front, beyond which rays are added; 1/200 of the length when absent.",
        ),
        key("keep", Kind::Choice(&KEPT), Absent::Default("\"all\""), "What is kept of fronts that fold."),
    ],
};

static MEDIA: [Word; 4] = [
    word("uniform", "n = `index`"),
    word("gaussian", "n = 1 + `amplitude` exp(−r²/`radius`²), r from `centre`"),
    word("luneburg", "n = √(2 − r²/`radius`²) within `radius` of `centre`, 1 outside"),
    word("layers", "n = `index` + `gradient` (y − `height`)"),
];

pub(super) static MEDIUM: Table = Table {
    name: "medium",
    doc: "A part of the medium. The refractive index is the product of those of all parts.",
    keys: &[
        key("type", Kind::Choice(&MEDIA), Absent::Required, "The law of the index."),
        key_for(
            &["uniform", "layers"],
            "index",
            quantity(Dimension::NONE, Range::Positive),
            Absent::Default("1.0"),
            "Index, at `height` where it varies.",
        ),
        key_for(
            &["gaussian", "luneburg"],
            "centre",
            pair(Dimension::LENGTH),
            Absent::Default("[0.0, 0.0]"),
            "Centre of the lens.",
        ),
        key_for(
            &["gaussian", "luneburg"],
            "radius",
            quantity(Dimension::LENGTH, Range::Positive),
            Absent::Required,
            "Radius of the lens.",
        ),
        key_for(
            &["gaussian"],
            "amplitude",
            quantity(Dimension::NONE, Range::Any),
            Absent::Required,
            "Index at the centre less one, greater than −1.",
        ),
        key_for(
            &["layers"],
            "gradient",
            quantity(INVERSE_LENGTH, Range::Any),
            Absent::Required,
            "Change of the index with y.",
        ),
        key_for(
            &["layers"],
            "height",
            quantity(Dimension::LENGTH, Range::Any),
            Absent::Default("0.0"),
            "Height y at which the index is `index`.",
        ),
    ],
};

static OUTLINES: [Word; 2] = [
    word("ellipse", "(x/a)² + (y/b)² = 1"),
    word("superellipse", "(x/a)ⁿ + (y/b)ⁿ = 1 with an even `exponent` n: nearer to a rectangle the larger it is"),
];

static SIGNALS: [Word; 2] = [word("wall", "everywhere on the wall at once"), word("circle", "on a circle in the room")];

pub(super) static ROOM: Table = Table {
    name: "room",
    doc: "A signal in a room: the time u(x, y) of its first arrival, |∇u| = 1/speed, with u = 0 where it starts.",
    keys: &[
        key("type", Kind::Choice(&OUTLINES), Absent::Required, "The outline of the room about the origin."),
        key("semi_axes", pair(Dimension::LENGTH), Absent::Required, "Semi-axes a and b, along x and y."),
        key_for(
            &["superellipse"],
            "exponent",
            Kind::Count { least: 2, most: 12 },
            Absent::Default("4"),
            "The exponent, an even number.",
        ),
        key(
            "speed",
            quantity(Dimension::SPEED, Range::Positive),
            Absent::Required,
            "Speed of the signal at the origin.",
        ),
        key(
            "speed_gradient",
            pair(Dimension::NONE.over(Dimension::TIME)),
            Absent::Default("[0.0, 0.0]"),
            "Gradient of the speed, which must be positive in the whole room.",
        ),
        key("signal", Kind::Choice(&SIGNALS), Absent::Default("\"wall\""), "Where the signal starts."),
        key("centre", pair(Dimension::LENGTH), Absent::Default("[0.0, 0.0]"), "Centre of the circle."),
        key("radius", quantity(Dimension::LENGTH, Range::Positive), Absent::Optional, "Radius of the circle."),
        key(
            "resolution",
            quantity(Dimension::LENGTH, Range::Positive),
            Absent::Optional,
            "Largest error of interpolation between characteristics; 1/2000 of the shorter semi-axis when absent.",
        ),
        key(
            "grid",
            Kind::Count { least: 16, most: 400 },
            Absent::Default("161"),
            "Points of the grid along the longer axis.",
        ),
    ],
};
