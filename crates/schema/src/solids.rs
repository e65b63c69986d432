//! The tables of studies of solids.

use super::Absent::{Default, Optional, Required};
use super::Kind::Count;
use super::Range::{Any, NotNegative, Positive};
use super::{Kind, Word, quantity, word};
use piola_document::table;
use piola_document::units::Dimension as D;

const fn pair(dimension: D) -> Kind {
    Kind::Numbers(dimension, &[2])
}

const PER_LENGTH: D = D::NONE.over(D::LENGTH);
const TWIST: D = D::ANGLE.over(D::LENGTH);

static LAWS: [Word; 5] = [
    word("neo-hookean", "½ μ (I₁ − 3), μ = `shear_modulus`"),
    word("mooney-rivlin", "`c10` (I₁ − 3) + `c01` (I₂ − 3), with 0 < `c10` + `c01`"),
    word("yeoh", "`c1` (I₁ − 3) + `c2` (I₁ − 3)² + `c3` (I₁ − 3)³"),
    word("gent", "−½ μ `limit` ln(1 − (I₁ − 3)/`limit`), μ = `shear_modulus`: I₁ − 3 stays below `limit`"),
    word("arruda-boyce", "eight chains of `links` links each, modulus `rubbery_modulus`: I₁ stays below 3 `links`"),
];

table! {
    /// The stored energy per volume of an incompressible isotropic solid, by the invariants I₁ = tr B and I₂ = tr B⁻¹.
    pub(super) static LAW = "law" {
        /// The energy.
        type: Kind::Choice(&LAWS), Required;
        /// Shear modulus μ.
        shear_modulus: quantity(D::PRESSURE, Positive), Required, only_for &["neo-hookean", "gent"];
        /// C₁₀.
        c10: quantity(D::PRESSURE, Any), Required, only_for &["mooney-rivlin"];
        /// C₀₁.
        c01: quantity(D::PRESSURE, Any), Required, only_for &["mooney-rivlin"];
        /// C₁, half the shear modulus.
        c1: quantity(D::PRESSURE, Positive), Required, only_for &["yeoh"];
        /// C₂, mostly negative.
        c2: quantity(D::PRESSURE, Any), Required, only_for &["yeoh"];
        /// C₃.
        c3: quantity(D::PRESSURE, Any), Required, only_for &["yeoh"];
        /// Jₘ, the limit of I₁ − 3.
        limit: quantity(D::NONE, Positive), Required, only_for &["gent"];
        /// n k θ, with n chains in a unit of volume.
        rubbery_modulus: quantity(D::PRESSURE, Positive), Required, only_for &["arruda-boyce"];
        /// Links of a chain, more than 1.
        links: quantity(D::NONE, Positive), Required, only_for &["arruda-boyce"];
    }
}

table! {
    /// A spherical shell of the `[law]`, inflated: the pressure inside over the stretch of the inner face, its limit
    /// points, all states under one pressure, and their stresses through the wall. The outer face is free.
    pub(super) static BALLOON = "balloon" {
        /// Radius of the inner face in the reference.
        inner_radius: quantity(D::LENGTH, Positive), Required;
        /// Radius of the outer face in the reference, more than the inner one.
        outer_radius: quantity(D::LENGTH, Positive), Required;
        /// The least and the greatest stretch of the inner face.
        stretch: pair(D::NONE), Default("[1.0, 5.0]");
        /// The pressure of the states that are sought; the limit points when absent.
        pressure: quantity(D::PRESSURE, Any), Optional;
        /// Points of the curve.
        points: Count { least: 16, most: 2000 }, Default("256");
    }
}

table! {
    /// A rod or a tube of the `[law]`, twisted, its curved faces free: once held at an axial stretch, once under an axial
    /// force. The held rod pushes against its ends, and the other one grows longer: Poynting's effect.
    pub(super) static TORSION = "torsion" {
        /// Radius of the inner face in the reference; 0 of a solid rod.
        inner_radius: quantity(D::LENGTH, NotNegative), Default("0.0");
        /// Radius of the outer face in the reference.
        outer_radius: quantity(D::LENGTH, Positive), Required;
        /// Largest twist, an angle per length of the reference.
        twist: quantity(TWIST, Positive), Required;
        /// Axial stretch of the rod that is held.
        axial_stretch: quantity(D::NONE, Positive), Default("1.0");
        /// Axial force on the rod that is not held.
        axial_force: quantity(D::FORCE, Any), Default("0.0");
        /// The torque of the states that are sought, under the axial force; the largest twist when absent.
        torque: quantity(D::MOMENT, Any), Optional;
        /// Points of the curves.
        points: Count { least: 16, most: 1000 }, Default("100");
    }
}

table! {
    /// A block of the `[law]`, bent by couples on two ends, its curved faces free.
    pub(super) static BENDING = "bending" {
        /// Thickness of the block, across the layers that are bent.
        thickness: quantity(D::LENGTH, Positive), Required;
        /// Length of the block, along the layers that are bent.
        length: quantity(D::LENGTH, Positive), Required;
        /// Height of the block, along the axis of bending.
        height: quantity(D::LENGTH, Positive), Required;
        /// Largest angle between the ends, at most a full turn.
        angle: quantity(D::ANGLE, Positive), Required;
        /// Stretch along the axis of bending.
        axial_stretch: quantity(D::NONE, Positive), Default("1.0");
        /// The moment of the states that are sought; the largest angle when absent.
        moment: quantity(D::MOMENT, Any), Optional;
        /// Points of the curve.
        points: Count { least: 16, most: 1000 }, Default("100");
    }
}

static DENSITIES: [Word; 2] = [
    word("uniform", "the same `density` everywhere"),
    word("core", "`burgers` in all about the axis, most of it within `core_radius`: density (b/π) c²/(r² + c²)²"),
];

table! {
    /// A crystal with screw dislocations along the z axis: Burgers vectors of circles in the plane z = 0, a circuit that
    /// does not close in the crystal, torsion, and whether the body is locally homogeneous.
    pub(super) static DISLOCATION = "dislocation" {
        /// How the dislocations are spread.
        type: Kind::Choice(&DENSITIES), Required;
        /// Burgers vector per area, negative of left-handed screws.
        density: quantity(PER_LENGTH, Any), Required, only_for &["uniform"];
        /// Burgers vector of all dislocations, negative of left-handed screws.
        burgers: quantity(D::LENGTH, Any), Required, only_for &["core"];
        /// Radius within which half of the dislocations are.
        core_radius: quantity(D::LENGTH, Positive), Required, only_for &["core"];
        /// Radii of the circuits.
        radii: Kind::Numbers(D::LENGTH, &[1, 2, 3, 4, 5, 6, 7, 8]), Required;
        /// Centre of the circuits.
        centre: pair(D::LENGTH), Default("[0.0, 0.0]");
        /// Relative torsion and curvature below which the body is called homogeneous.
        tolerance: quantity(D::NONE, Positive), Default("1e-9");
    }
}

table! {
    /// A tube of concentric layers of the `[law]`, each with natural lengths of its own: residual stress, and the stress
    /// under a pressure inside, beside a tube without residual stress. The outer face is free; under pressure the axial
    /// stretch stays that of the tube without loads.
    pub(super) static LAMINATED_TUBE = "laminated_tube" {
        /// Radius of the inner face in the reference.
        inner_radius: quantity(D::LENGTH, Positive), Required;
        /// Pressure inside.
        inner_pressure: quantity(D::PRESSURE, NotNegative), Required;
        /// Largest stretch of the inner face, over that without loads, at which states are sought.
        stretch: quantity(D::NONE, Positive), Default("2.0");
    }
}

table! {
    /// A layer of a `[laminated_tube]`, the innermost first. Its growths are natural lengths over lengths in the
    /// reference.
    pub(super) static LAYER = "layer" {
        /// Thickness in the reference.
        thickness: quantity(D::LENGTH, Positive), Required;
        /// Growth around the tube.
        hoop_growth: quantity(D::NONE, Positive), Default("1.0");
        /// Growth along the tube.
        axial_growth: quantity(D::NONE, Positive), Default("1.0");
        /// Growth across the layer.
        radial_growth: quantity(D::NONE, Positive), Default("1.0");
    }
}
