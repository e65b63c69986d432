//! The tables of fields on a box.

use piola_document::table;
use piola_document::units::Dimension as D;

use super::Absent::{Default, Optional, Required};
use super::Range::{Any, Fraction, NotNegative, Positive};
use super::{Kind, Word, quantity, word};

/// A number for each axis of a rectangle or of a box.
const fn each_axis(dimension: D) -> Kind {
    Kind::Numbers(dimension, &[2, 3])
}

const FORCE_PER_VOLUME: D = D::PRESSURE.over(D::LENGTH);
const FORCE_PER_LENGTH: D = D::FORCE.over(D::LENGTH);
const VISCOSITY: D = D::PRESSURE.times(D::TIME);
const DENSITY: D = D::MASS.over(D::LENGTH.power(3));
const DRAG: D = DENSITY.over(D::TIME);

static TYPES: [Word; 3] = [
    word("static", "the displacement of an elastic body in equilibrium, 0 = Lu + f"),
    word("motion", "the motion of an elastic body, ρ ∂²u/∂t² + c ∂u/∂t = Lu + f, each mode by its exact solution"),
    word("flow", "the creeping flow of a viscous fluid, 0 = Lv + f, and the map of its particles"),
];

static WALLS: [Word; 2] = [
    word("sliding", "no displacement normal to the walls, no shear stress on them"),
    word(
        "guided",
        "no displacement along the walls, no normal derivative of the normal one: the walls move along their normals",
    ),
];

static LOCATIONS: [Word; 2] = [
    word("cells", "at the centres of cells, like the voxels of an image"),
    word("nodes", "from wall to wall, the first and the last on the walls"),
];

const ON_A_GRID: &[&str] = &["static", "flow"];
const ELASTIC: &[&str] = &["static", "motion"];
const IN_TIME: &[&str] = &["motion", "flow"];

table! {
    /// Elastic or viscous fields on a rectangle (two `sides`, plane strain, each force and energy for a unit of depth) or a
    /// box (three), as sums of the eigenfunctions of Lu = μΔu + (λ + μ)∇(∇·u). An elastic body has `young_modulus` and
    /// `poisson_ratio`, or `first_lame_parameter` λ and `shear_modulus` μ.
    pub(super) static BOX = "box" {
        /// The field.
        type: Kind::Choice(&TYPES), Required;
        /// Sides of the rectangle or the box, which has a corner at the origin.
        sides: each_axis(D::LENGTH), Required;
        /// What the walls hold.
        walls: Kind::Choice(&WALLS), Default("\"sliding\"");
        /// Points of the grid along each axis.
        points: each_axis(D::NONE), Required, only_for ON_A_GRID;
        /// Where the points are.
        location: Kind::Choice(&LOCATIONS), Default("\"cells\""), only_for ON_A_GRID;
        /// Highest index of the modes along each axis. A `motion` needs it; on a grid it is the highest that the grid can
        /// tell apart when absent.
        modes: each_axis(D::NONE), Optional;
        /// Young's modulus.
        young_modulus: quantity(D::PRESSURE, Positive), Optional, only_for ELASTIC;
        /// Poisson's ratio, more than −1 and less than ½.
        poisson_ratio: quantity(D::NONE, Any), Optional, only_for ELASTIC;
        /// λ, with 0 < λ + 2μ.
        first_lame_parameter: quantity(D::PRESSURE, Any), Optional, only_for ELASTIC;
        /// μ.
        shear_modulus: quantity(D::PRESSURE, Positive), Optional, only_for ELASTIC;
        /// Viscosity μ of the fluid.
        shear_viscosity: quantity(VISCOSITY, Positive), Required, only_for &["flow"];
        /// Viscosity λ of the fluid, with 0 < λ + 2μ.
        second_viscosity: quantity(VISCOSITY, Any), Default("0.0"), only_for &["flow"];
        /// Density ρ.
        density: quantity(DENSITY, Positive), Required, only_for &["motion"];
        /// Drag c: a force per volume over velocity.
        drag: quantity(DRAG, NotNegative), Default("0.0"), only_for &["motion"];
        /// Time from the start to the end.
        duration: quantity(D::TIME, Positive), Required, only_for IN_TIME;
        /// Time between the instants that are recorded; 1/200 of the duration when absent.
        interval: quantity(D::TIME, Positive), Optional, only_for &["motion"];
        /// Step of the flow; half of the time in which the fastest particle crosses a spacing when absent.
        step: quantity(D::TIME, Positive), Optional, only_for &["flow"];
        /// Least det(1 − ∇u) of a displacement; before it falls below, the displacement is put away and a new one begins.
        least_jacobian: quantity(D::NONE, Fraction), Default("0.5"), only_for &["flow"];
    }
}

static LOADS: [Word; 5] = [
    word("uniform", "the same `force_per_volume` everywhere"),
    word("gaussian", "`force_per_volume` exp(−r²/`radius`²), r from `at`"),
    word(
        "mode",
        "one mode: component a is `force_per_volume` a times sines and cosines of π i x/L with the `indices` i",
    ),
    word("point", "a `force` at one place of a box, spread over the length of the shortest wave"),
    word("line", "a `force_per_length` along a line across a rectangle, spread likewise"),
];

table! {
    /// A force on the body in a `[box]`. All loads act together. In a `motion` each acts between two instants, with a factor
    /// c₀ + c₁ τ + c₂ τ² + c₃ τ³ that depends on the share τ of its time that has passed.
    pub(super) static LOAD = "load" {
        /// The form of the force.
        type: Kind::Choice(&LOADS), Required;
        /// Force per volume; of a mode, the amplitude of each component.
        force_per_volume: each_axis(FORCE_PER_VOLUME), Required, only_for &["uniform", "gaussian", "mode"];
        /// The force.
        force: each_axis(D::FORCE), Required, only_for &["point"];
        /// The force for a unit of depth.
        force_per_length: each_axis(FORCE_PER_LENGTH), Required, only_for &["line"];
        /// Its place in the box.
        at: each_axis(D::LENGTH), Required, only_for &["gaussian", "point", "line"];
        /// Distance at which the force has fallen to 1/e.
        radius: quantity(D::LENGTH, Positive), Required, only_for &["gaussian"];
        /// Indices of the mode. A component vanishes when it has a sine of the index 0.
        indices: each_axis(D::NONE), Required, only_for &["mode"];
        /// Time at which the force begins, in a `motion`.
        from: quantity(D::TIME, NotNegative), Default("0.0");
        /// Time at which the force ends, in a `motion`; its end when absent.
        until: quantity(D::TIME, Positive), Optional;
        /// The coefficients c₀, c₁, … of the factor over time, in a `motion`.
        course: Kind::Numbers(D::NONE, &[1, 2, 3, 4]), Default("[1.0]");
    }
}

static STARTS: [Word; 2] = [
    word("mode", "one mode: component a is the amplitude a times sines and cosines of π i x/L with the `indices` i"),
    word("gaussian", "the amplitudes times exp(−r²/`radius`²), r from `at`"),
];

table! {
    /// A part of the state from which a `[box]` of the type `motion` starts: a displacement or a velocity. The parts add up;
    /// the body is at rest without any.
    pub(super) static START = "start" {
        /// The form of the part.
        type: Kind::Choice(&STARTS), Required;
        /// The displacement; either this or `velocity`.
        displacement: each_axis(D::LENGTH), Optional;
        /// The velocity.
        velocity: each_axis(D::SPEED), Optional;
        /// Its place in the box.
        at: each_axis(D::LENGTH), Required, only_for &["gaussian"];
        /// Distance at which it has fallen to 1/e.
        radius: quantity(D::LENGTH, Positive), Required, only_for &["gaussian"];
        /// Indices of the mode. A component vanishes when it has a sine of the index 0.
        indices: each_axis(D::NONE), Required, only_for &["mode"];
    }
}

table! {
    /// A place in a `[box]`: its displacement is recorded, in a `flow` where its particle was at first.
    pub(super) static PROBE = "probe" {
        /// Name, unlike any other.
        name: Kind::Name, Required;
        /// The place.
        at: each_axis(D::LENGTH), Required;
    }
}
