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
    /// The attracting centre of the post-Newtonian term has no mass.
    #[error("body {body} has no mass, so it cannot be the centre of a post-Newtonian term")]
    MasslessCentre {
        /// The body's index.
        body: usize,
    },
    /// A force that the map of Wisdom and Holman does not have.
    #[error("the map of Wisdom and Holman is of point masses that attract each other by Newton's law, without {force}")]
    NotKeplerian {
        /// What is on.
        force: &'static str,
    },
    /// Fewer than two bodies with mass, or a softened or relativistic attraction, where collisions are to be regularised.
    #[error("regularisation is of two or more bodies, all with mass, and of Newton's law alone: {found}")]
    NotRegularisable {
        /// What was found.
        found: &'static str,
    },
    /// 0 < c < ∞ violated.
    #[error("the speed of light is {value} m/s; it must satisfy 0 < c < ∞")]
    InvalidSpeedOfLight {
        /// The value given.
        value: f64,
    },
}
