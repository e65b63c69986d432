//! The tables of studies.

use piola_document::table;
use piola_document::units::Dimension as D;

use super::Absent::{Default, Optional, Required};
use super::Range::{Any, Positive};
use super::{Kind, Word, quantity, word};

const fn pair(dimension: D) -> Kind {
    Kind::Numbers(dimension, &[2])
}

const INVERSE_LENGTH: D = D::NONE.over(D::LENGTH);
const FREQUENCY: D = D::NONE.over(D::TIME);

static SOURCES: [Word; 2] =
    [word("plane", "a straight front of some width"), word("point", "all directions, or some, from one place")];

static KEPT: [Word; 2] = [
    word("all", "fronts keep all their sheets, swallow-tails among them"),
    word("first", "of each front only what arrives first"),
];

table! {
    /// Wave fronts in a plane medium of refractive index n(x, y) from a source, with rays and caustics. Fronts are
    /// levels of the optical length ∫ n ds; divided by the speed of light it is the time of travel.
    pub(super) static WAVEFRONT = "wavefront" {
        /// The source.
        type: Kind::Choice(&SOURCES), Required;
        /// The source, or the middle of a plane one.
        position: pair(D::LENGTH), Default("[0.0, 0.0]");
        /// Direction of the rays at the source, of any length.
        direction: pair(D::NONE), Default("[1.0, 0.0]"), only_for &["plane"];
        /// Width of the source.
        width: quantity(D::LENGTH, Positive), Required, only_for &["plane"];
        /// First direction, from the x axis.
        from: quantity(D::ANGLE, Any), Default("0.0"), only_for &["point"];
        /// Last direction, at most a full turn after the first; a full turn when absent.
        to: quantity(D::ANGLE, Any), Optional, only_for &["point"];
        /// Optical length ∫ n ds to which rays are followed.
        length: quantity(D::LENGTH, Positive), Required;
        /// Number of fronts, evenly spread over the length.
        fronts: Kind::Count { least: 1, most: 500 }, Default("30");
        /// Number of rays to begin with.
        rays: Kind::Count { least: 3, most: 20_000 }, Default("401");
        /// Largest distance of neighbours on a front, beyond which rays are added; 1/200 of the length when absent.
        spacing: quantity(D::LENGTH, Positive), Optional;
        /// The sheets that are kept of a front that folds.
        keep: Kind::Choice(&KEPT), Default("\"all\"");
    }
}

static MEDIA: [Word; 4] = [
    word("uniform", "n = `index`"),
    word("gaussian", "n = 1 + `amplitude` exp(−r²/`radius`²), r from `centre`"),
    word("luneburg", "n = √(2 − r²/`radius`²) within `radius` of `centre`, 1 outside"),
    word("layers", "n = `index` + `gradient` (y − `height`)"),
];

table! {
    /// A part of the medium. The refractive index is the product of those of all parts.
    pub(super) static MEDIUM = "medium" {
        /// The law of the index.
        type: Kind::Choice(&MEDIA), Required;
        /// Index, at `height` where it varies.
        index: quantity(D::NONE, Positive), Default("1.0"), only_for &["uniform", "layers"];
        /// Centre of the lens.
        centre: pair(D::LENGTH), Default("[0.0, 0.0]"), only_for &["gaussian", "luneburg"];
        /// Radius of the lens.
        radius: quantity(D::LENGTH, Positive), Required, only_for &["gaussian", "luneburg"];
        /// Index at the centre less one, greater than −1.
        amplitude: quantity(D::NONE, Any), Required, only_for &["gaussian"];
        /// Change of the index with y.
        gradient: quantity(INVERSE_LENGTH, Any), Required, only_for &["layers"];
        /// Height y at which the index is `index`.
        height: quantity(D::LENGTH, Any), Default("0.0"), only_for &["layers"];
    }
}

static OUTLINES: [Word; 2] = [
    word("ellipse", "(x/a)² + (y/b)² = 1"),
    word("superellipse", "(x/a)ⁿ + (y/b)ⁿ = 1 with an even `exponent` n: nearer to a rectangle the larger it is"),
];

static SIGNALS: [Word; 2] = [word("wall", "everywhere on the wall at once"), word("circle", "on a circle in the room")];

table! {
    /// A signal in a room: the time u(x, y) of its first arrival, |∇u| = 1/speed, with u = 0 where it starts.
    pub(super) static ROOM = "room" {
        /// The outline of the room about the origin.
        type: Kind::Choice(&OUTLINES), Required;
        /// Semi-axes a and b, along x and y.
        semi_axes: pair(D::LENGTH), Required;
        /// The exponent, an even number.
        exponent: Kind::Count { least: 2, most: 12 }, Default("4"), only_for &["superellipse"];
        /// Speed of the signal at the origin.
        speed: quantity(D::SPEED, Positive), Required;
        /// Gradient of the speed, which must be positive in the whole room.
        speed_gradient: pair(FREQUENCY), Default("[0.0, 0.0]");
        /// Where the signal starts.
        signal: Kind::Choice(&SIGNALS), Default("\"wall\"");
        /// Centre of the circle.
        centre: pair(D::LENGTH), Default("[0.0, 0.0]");
        /// Radius of the circle.
        radius: quantity(D::LENGTH, Positive), Optional;
        /// Largest error of interpolation between characteristics; 1/2000 of the shorter semi-axis when absent.
        resolution: quantity(D::LENGTH, Positive), Optional;
        /// Points of the grid along the longer axis.
        grid: Kind::Count { least: 16, most: 400 }, Default("161");
    }
}
