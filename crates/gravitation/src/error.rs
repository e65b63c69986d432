//! What can be wrong with attracting bodies.

/// A condition that attracting bodies or their state violate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GravitationError {
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
    /// An infinite or NaN component.
    #[error("component {index} of `{quantity}` is {value}; it must be finite")]
    NotFinite {
        /// The name of the argument.
        quantity: &'static str,
        /// The component.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// 0 ≤ Gm < ∞ violated.
    #[error("the gravitational parameter of body {body} is {value} m³/s²; it must satisfy 0 ≤ Gm < ∞")]
    InvalidGravitationalParameter {
        /// The body's index.
        body: usize,
        /// The value given.
        value: f64,
    },
    /// 0 ≤ ε < ∞ violated.
    #[error("the softening length is {value} m; it must satisfy 0 ≤ ε < ∞")]
    InvalidSoftening {
        /// The value given.
        value: f64,
    },
    /// Two bodies in one place, or so near that the cube of their distance is no number any more, where
    /// nothing softens what one does to the other.
    #[error(
        "bodies {first} and {second} are in one place, where their attraction is infinite: separate them or soften the \
         attraction"
    )]
    CoincidentBodies {
        /// The first body's index.
        first: usize,
        /// The second body's index.
        second: usize,
    },
    /// An index beyond the last body.
    #[error("there is no body {body}: the number of bodies is {bodies}")]
    NoSuchBody {
        /// The index asked for.
        body: usize,
        /// The number of bodies.
        bodies: usize,
    },
    /// The central body has no mass: of a post-Newtonian term, or of planets.
    #[error("body {body} has no mass, so it cannot be a central body")]
    MasslessCentre {
        /// The body's index.
        body: usize,
    },
    /// A force that the map of Wisdom and Holman does not have.
    #[error("the map of Wisdom and Holman moves point masses by Newton's attraction alone; take {force} away")]
    NotKeplerian {
        /// The force: softening or the post-Newtonian term.
        force: &'static str,
    },
    /// Fewer than two bodies with mass, or a softened or relativistic attraction, where collisions are to be regularised.
    #[error("only two or more bodies with mass can be regularised, and only under Newton's attraction: {found}")]
    NotRegularisable {
        /// Which condition is violated, as in "a body has no mass".
        found: &'static str,
    },
    /// 0 < c < ∞ violated.
    #[error("the speed of light is {value} m/s; it must satisfy 0 < c < ∞")]
    InvalidSpeedOfLight {
        /// The value given.
        value: f64,
    },
    /// 0 ≤ r < ∞ violated.
    #[error("entry {body} of `{quantity}` is {value} m; it must satisfy 0 ≤ r < ∞")]
    InvalidRadius {
        /// The name of the argument.
        quantity: &'static str,
        /// The body's index.
        body: usize,
        /// The value given.
        value: f64,
    },
    /// Two bodies came nearer to each other than the sum of their radii.
    #[error(
        "bodies {first} and {second} collide: they come within {distance} m, and the sum of their radii is {contact} m"
    )]
    Collision {
        /// The first body's index.
        first: usize,
        /// The second body's index.
        second: usize,
        /// The least distance of their centres, m.
        distance: f64,
        /// The sum of their radii, m.
        contact: f64,
    },
    /// A planet came nearer to the central body than the run was told to follow it.
    #[error("body {body} comes within {distance} m of the central body; the least distance allowed is {least} m")]
    NearCentre {
        /// The body's index.
        body: usize,
        /// Its least distance, m.
        distance: f64,
        /// The least distance allowed, m.
        least: f64,
    },
}
