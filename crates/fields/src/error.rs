//! What can be wrong with fields and bodies: each variant names the violated condition and holds the numbers.

use piola_continuum::ContinuumError;
use piola_numerics::Real;
use piola_tensor::TensorError;

/// A violated condition on fields, coordinates, regions and meshes.
///
/// A number that is not finite is [`NotFinite`](Self::NotFinite) wherever it was found; every other condition at a point
/// is wrapped.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldsError {
    /// A violated condition of mechanics at a point.
    #[error(transparent)]
    Continuum(ContinuumError),
    /// A number is infinite or NaN.
    #[error("{quantity}[{index}] = {value} is not finite")]
    NotFinite {
        /// What the number is.
        quantity: &'static str,
        /// Its position, in row-major order for a matrix.
        index: usize,
        /// The number itself.
        value: f64,
    },
    /// The degree of a quadrature is above the limit.
    #[error("the quadrature degree {degree} is too high: the highest is {limit}")]
    DegreeTooHigh {
        /// The degree that was asked for.
        degree: usize,
        /// The highest degree.
        limit: usize,
    },
    /// 0 < x is violated for a length or another quantity.
    #[error("{quantity} {index} is {value}, not positive")]
    NotPositive {
        /// Which quantity.
        quantity: &'static str,
        /// Its index where there are several, otherwise 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An integrand is infinite or NaN at a point of the quadrature.
    #[error("component {component} of the integrand is {value} at {position:?}")]
    IntegrandNotFinite {
        /// The place.
        position: [f64; 3],
        /// Which component, in the order of storage.
        component: usize,
        /// Its value.
        value: f64,
    },
    /// No rule up to the highest degree gives an integral to the tolerance.
    #[error("the integral has the error estimate {error:e} at degree {degree}, above the tolerance {tolerance:e}")]
    IntegralNotConverged {
        /// Difference of the two best rules.
        error: f64,
        /// The tolerance.
        tolerance: f64,
        /// The degree of the best rule.
        degree: usize,
    },
    /// A mesh has no elements.
    #[error("the mesh has no elements")]
    EmptyMesh,
    /// An element names a vertex that does not exist.
    #[error("element {element} names vertex {vertex}, but there are only {count}")]
    NoSuchVertex {
        /// The element.
        element: usize,
        /// The vertex that it names.
        vertex: usize,
        /// The number of vertices.
        count: usize,
    },
    /// An element names a vertex twice.
    #[error("element {element} names vertex {vertex} twice")]
    RepeatedVertex {
        /// The element.
        element: usize,
        /// The vertex.
        vertex: usize,
    },
    /// A vertex belongs to no element.
    #[error("vertex {vertex} belongs to no element")]
    UnusedVertex {
        /// The vertex.
        vertex: usize,
    },
    /// 0 < V is violated for an element: it is turned inside out.
    #[error("element {element} is turned inside out: its volume is {volume:e} m³")]
    InvertedElement {
        /// The element.
        element: usize,
        /// Its volume with sign, m³.
        volume: f64,
    },
    /// An element has no volume within rounding, or a volume that is no number.
    #[error("element {element} is flat: its volume is {volume:e} m³, with a longest edge of {longest_edge:e} m")]
    FlatElement {
        /// The element.
        element: usize,
        /// Its volume, m³.
        volume: f64,
        /// Its longest edge, m.
        longest_edge: f64,
    },
    /// Two elements lie on the same side of a face, or more than two meet there.
    #[error("elements {elements:?} lie on the same side of the face with vertices {face:?}")]
    OverlappingElements {
        /// The vertices of the face.
        face: [usize; 3],
        /// The elements.
        elements: [usize; 2],
    },
    /// 0 < m is violated for a mass, or it is no number.
    #[error("mass {index} is {mass} kg, not positive")]
    NonPositiveMass {
        /// Which mass: the number of the node or of the element.
        index: usize,
        /// The mass, kg.
        mass: f64,
    },
    /// 0 ≤ c is violated for the damping of a node.
    #[error("the damping of node {node} is {damping} kg/s, which is negative")]
    NegativeDamping {
        /// The node.
        node: usize,
        /// Its damping, kg/s.
        damping: f64,
    },
    /// A list has the wrong length.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// What the list is.
        quantity: &'static str,
        /// Its length.
        found: usize,
        /// The length that is expected.
        expected: usize,
    },
    /// No particle is found at a place, or none for certain.
    #[error(
        "no particle at the place {place:?} could be certified: the best candidate, {best:?}, misses it by \
         {residual:e} m (Newton steps: {iterations}; det F = {determinant:e}; the relative change of F nearby is \
         {change:e} and must be at most 1/2)"
    )]
    InversionFailed {
        /// The place x, m.
        place: [f64; 3],
        /// The best X, m.
        best: [f64; 3],
        /// |x − x(X, t)|, m.
        residual: f64,
        /// det F there.
        determinant: f64,
        /// |1 − F⁻¹(X) F(Y)| of Y near X, infinite when the steps ran out before it was computed.
        change: f64,
        /// Newton steps taken.
        iterations: usize,
    },
    /// A list that must increase does not.
    #[error("{quantity}[{index}] = {value} is not above the entry before it, {previous}")]
    NotIncreasing {
        /// What the list is.
        quantity: &'static str,
        /// The index of the offending entry.
        index: usize,
        /// The entry before.
        previous: f64,
        /// The entry.
        value: f64,
    },
    /// 0 < det F is violated at a corner of a cell of samples.
    #[error("cell {cell:?} is folded at time index {time}: det F = {determinant:e} at a corner")]
    FoldedCell {
        /// The cell, from 0 along each axis.
        cell: [usize; 3],
        /// The index of the time.
        time: usize,
        /// det F by the edges that meet at the corner.
        determinant: f64,
    },
    /// A particle or time lies outside the samples.
    #[error("{value} lies outside the {quantity}, which reach from {low} to {high}")]
    OutsideSamples {
        /// Along which samples.
        quantity: &'static str,
        /// The coordinate or time.
        value: f64,
        /// The first sample.
        low: f64,
        /// The last sample.
        high: f64,
    },
    /// A particle that does not exist.
    #[error("particle {particle} does not exist: the number of particles is {count}")]
    NoSuchParticle {
        /// The index, from 0.
        particle: usize,
        /// The number of particles.
        count: usize,
    },
    /// A point where coordinates have no basis: an axis, a pole or a place outside their range.
    #[error("the coordinates have no basis at {coordinates:?}: the volume element there is {volume_element:e}")]
    SingularCoordinates {
        /// The coordinates.
        coordinates: [f64; 3],
        /// det ∂x/∂q, or the radius that is not positive.
        volume_element: f64,
    },
    /// gᵢ·gⱼ = 0 is violated where physical components are asked for.
    #[error("coordinate lines {row} and {column} are not orthogonal: the cosine between them is {cosine:e}")]
    NotOrthogonal {
        /// i, from 0.
        row: usize,
        /// j, from 0.
        column: usize,
        /// cos ∠(gᵢ, gⱼ).
        cosine: f64,
    },
}

impl From<ContinuumError> for FieldsError {
    fn from(error: ContinuumError) -> Self {
        match error {
            ContinuumError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            other => Self::Continuum(other),
        }
    }
}

impl From<TensorError> for FieldsError {
    fn from(error: TensorError) -> Self {
        ContinuumError::from(error).into()
    }
}

/// The first number that is infinite or NaN in any lane, by name and position.
#[inline]
pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), FieldsError> {
    Ok(piola_tensor::internal::check_finite(quantity, values)?)
}
