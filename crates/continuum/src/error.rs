//! What can be wrong with the data of a continuum: each variant names the violated condition and holds the numbers.

use piola_numerics::{Mask, Real};

/// A violated condition of continuum mechanics.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContinuumError {
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
    /// 0 < det F is violated: the body is turned inside out or flattened.
    #[error("det F = {determinant:e} is not positive: the body is turned inside out or flattened")]
    NonPositiveJacobian {
        /// det F.
        determinant: f64,
    },
    /// 0 < det F holds, but det F is smaller than the smallest number.
    #[error("det F = 10^({logarithm}) is positive but below the range of the scalar")]
    VanishingJacobian {
        /// log₁₀ det F.
        logarithm: f64,
    },
    /// `T_ij` = `T_ji` is violated.
    #[error(
        "{quantity} is not symmetric: entries ({row},{column}) and ({column},{row}) differ by {difference:e}, \
         more than rounding of its largest entry {scale:e}"
    )]
    NotSymmetric {
        /// What should be symmetric.
        quantity: &'static str,
        /// Row of the entry above the diagonal, from 0.
        row: usize,
        /// Column of that entry, from 0.
        column: usize,
        /// `T_ij − T_ji`.
        difference: f64,
        /// The largest entry.
        scale: f64,
    },
    /// `W_ij` = −`W_ji` is violated.
    #[error(
        "not skew: entries ({row},{column}) and ({column},{row}) add up to {sum:e}, \
         more than rounding of the largest entry {scale:e}"
    )]
    NotSkew {
        /// Row of the entry on or above the diagonal, from 0.
        row: usize,
        /// Column of that entry, from 0.
        column: usize,
        /// `W_ij + W_ji`.
        sum: f64,
        /// The largest entry.
        scale: f64,
    },
    /// `C_ijkl` = `C_jikl` or `C_ijkl` = `C_ijlk` is violated.
    #[error(
        "a fourth-order tensor lacks a minor symmetry: entry {entry:?} differs by {difference:e} from the one with \
         two indices exchanged, more than rounding of the largest entry {scale:e}"
    )]
    NotMinorSymmetric {
        /// Indices i, j, k, l of the entry, from 0.
        entry: [usize; 4],
        /// The difference.
        difference: f64,
        /// The largest entry.
        scale: f64,
    },
    /// `C_ijkl` = `C_klij` is violated.
    #[error(
        "a fourth-order tensor lacks the major symmetry: entry {entry:?} differs by {difference:e} from the one with \
         the pairs exchanged, more than rounding of the largest entry {scale:e}"
    )]
    NotMajorSymmetric {
        /// Indices i, j, k, l of the entry, from 0.
        entry: [usize; 4],
        /// `C_ijkl − C_klij`.
        difference: f64,
        /// The largest entry.
        scale: f64,
    },
    /// det A ≠ 0 is violated for a tensor that should be inverted.
    #[error("the tensor is singular: divided by {scale:e} its determinant, or a pivot, is {relative_determinant:e}")]
    SingularTensor {
        /// The determinant, or the pivot, of A/scale.
        relative_determinant: f64,
        /// The size of the components of A, a power of two.
        scale: f64,
    },
    /// `QᵀQ` = 1 or 0 < det Q is violated for what should be a rotation.
    #[error("not a rotation: QᵀQ − 1 has an entry {defect:e}, det Q = {determinant}")]
    NotARotation {
        /// The largest entry of `QᵀQ` − 1 in modulus.
        defect: f64,
        /// det Q.
        determinant: f64,
    },
    /// 0 < λ is violated for a principal stretch.
    #[error("principal stretch {index} is {value}, not positive")]
    NonPositiveStretch {
        /// Which stretch, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A tensor that belongs to a deformation has a negative leading minor.
    #[error(
        "{quantity} is not positive definite: its leading minor of order {order} is {minor:e} when its entries are divided by {scale:e}"
    )]
    NotPositiveDefinite {
        /// The tensor, for a strain the squared length that it stands for.
        quantity: &'static str,
        /// 1, 2 or 3: how many rows the minor has.
        order: usize,
        /// The minor of the tensor divided by `scale`.
        minor: f64,
        /// The largest entry.
        scale: f64,
    },
    /// λ₁ > λ₂ > λ₃ is violated where single principal axes are asked for.
    #[error("the principal stretches {stretches:?} coalesce to rounding: their axes have no rate")]
    CoalescentStretches {
        /// The stretches.
        stretches: [f64; 3],
    },
    /// An eigenvalue of F is zero or negative where the principal logarithm is asked for.
    #[error("F has no real principal logarithm: an eigenvalue is zero or negative")]
    NoPrincipalLogarithm,
    /// 0 < |n| is violated: a normal has no direction.
    #[error("the zero vector has no direction: it is no normal")]
    ZeroNormal,
    /// A number is not between its bounds.
    #[error("{quantity} = {value} is not between {least} and {largest}")]
    OutOfRange {
        /// What the number is.
        quantity: &'static str,
        /// The number itself.
        value: f64,
        /// The lower bound.
        least: f64,
        /// The upper bound.
        largest: f64,
    },
    /// 0 < |dev T| is violated where a ratio to it is asked for.
    #[error("the deviator is zero: a stress of mean {mean:e} in all directions has no triaxiality")]
    ZeroDeviator {
        /// ⅓ tr T.
        mean: f64,
    },
    /// The degree of a quadrature is above the limit.
    #[error("quadrature of degree {degree} is asked for; the highest is {limit}")]
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
    NonFiniteIntegrand {
        /// The place.
        position: [f64; 3],
        /// Which component, in the order of storage.
        component: usize,
        /// Its value.
        value: f64,
    },
    /// No rule up to the highest degree gives an integral to the tolerance.
    #[error("the integral is uncertain by {error:e} at degree {degree}, more than the tolerance {tolerance:e}")]
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
    #[error("element {element} is turned inside out: its volume is {volume:e}")]
    InvertedElement {
        /// The element.
        element: usize,
        /// Its volume with sign, m³.
        volume: f64,
    },
    /// An element has no volume within rounding, or a volume that is no number.
    #[error("element {element} is flat: its volume is {volume:e} with an edge of {longest_edge:e}")]
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
    #[error("mass {index} is {mass}, not positive")]
    NonPositiveMass {
        /// Which mass: the number of the node or of the element.
        index: usize,
        /// The mass, kg.
        mass: f64,
    },
    /// 0 ≤ c is violated for the damping of a node.
    #[error("damping of node {node} is {damping}, negative")]
    NegativeDamping {
        /// The node.
        node: usize,
        /// Its damping, kg/s.
        damping: f64,
    },
    /// A list has the wrong length.
    #[error("{quantity} has length {found}; {expected} is expected")]
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
        "no certain particle at {place:?}: the best, {best:?}, misses it by {residual:e} after {iterations} steps \
         (det F = {determinant:e}, the relative change of F nearby, {change:e}, must be at most 1/2)"
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
    #[error("{quantity}[{index}] = {value} does not exceed the one before, {previous}")]
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
    #[error("cell {cell:?} is folded at time {time}: det F = {determinant:e} at a corner")]
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
    #[error("particle {particle} does not exist: there are {count}")]
    NoSuchParticle {
        /// The index, from 0.
        particle: usize,
        /// The number of particles.
        count: usize,
    },
    /// A point where coordinates have no basis: an axis, a pole or a place outside their range.
    #[error("the coordinates {coordinates:?} have no basis there: volume element {volume_element:e}")]
    SingularCoordinates {
        /// The coordinates.
        coordinates: [f64; 3],
        /// det ∂x/∂q, or the radius that is not positive.
        volume_element: f64,
    },
    /// gᵢ·gⱼ = 0 is violated where physical components are asked for.
    #[error("the coordinate lines {row} and {column} are not orthogonal: the cosine between them is {cosine:e}")]
    NotOrthogonal {
        /// i, from 0.
        row: usize,
        /// j, from 0.
        column: usize,
        /// cos ∠(gᵢ, gⱼ).
        cosine: f64,
    },
    /// Points of a batch are bad; the outputs of all others are computed.
    #[error("{} of {count} points are bad: {}", points.len(), first_of(points))]
    BadPoints {
        /// All bad points, in order.
        points: Vec<crate::batch::BadPoint>,
        /// The number of points of the batch.
        count: usize,
        /// How many good points took the slow path of the analysis of the stretches.
        slow_path: usize,
    },
    /// A quantity of a batch has no value at a point.
    #[error(transparent)]
    Refused(#[from] crate::batch::Refusal),
}

/// The first bad point in words.
fn first_of(points: &[crate::batch::BadPoint]) -> String {
    points.first().map_or_else(String::new, |point| format!("at point {}, {}", point.index, point.error))
}

/// The first number that is infinite or NaN in any lane, by name and position.
#[inline]
pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), ContinuumError> {
    for (index, value) in values.iter().enumerate() {
        if !value.is_finite().all() {
            let lane = (0..T::LANES).find(|&lane| !value.primal(lane).is_finite()).unwrap_or(0);
            return Err(ContinuumError::NotFinite { quantity, index, value: value.primal(lane) });
        }
    }
    Ok(())
}
