//! What can be wrong with kinematic data: each variant names the violated condition and holds the numbers.

/// A violated condition of kinematic data.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KinematicsError {
    /// A number is infinite or NaN.
    #[error("{quantity}[{index}] = {value} is not finite")]
    NotFinite {
        /// What the number is.
        quantity: &'static str,
        /// Its position in row-major order.
        index: usize,
        /// The number itself.
        value: f64,
    },
    /// 0 < mass is violated.
    #[error("mass {mass} kg is not positive")]
    NonPositiveMass {
        /// The mass, in kg.
        mass: f64,
    },
    /// 0 < size is violated for a length of a solid.
    #[error("{quantity} = {value} m is not positive")]
    NonPositiveSize {
        /// Which length.
        quantity: &'static str,
        /// Its value, in m.
        value: f64,
    },
    /// `I_ij` = `I_ji` is violated.
    #[error(
        "inertia tensor is not symmetric: entries ({row},{column}) and ({column},{row}) differ by {difference} kg m²"
    )]
    InertiaNotSymmetric {
        /// Row of the entry above the diagonal, from 0.
        row: usize,
        /// Column of that entry, from 0.
        column: usize,
        /// `I_ij − I_ji`, in kg m².
        difference: f64,
    },
    /// 0 < I₁ is violated: no solid has such an inertia tensor. A body without extent about an axis, such
    /// as a thin rod, has no attitude about that axis: place it as two or three particles instead.
    #[error(
        "principal moments {principal_moments:?} kg m² are not all positive; \
         place a body without thickness as particles"
    )]
    InertiaNotPositiveDefinite {
        /// Principal moments I₁ ≤ I₂ ≤ I₃, in kg m².
        principal_moments: [f64; 3],
    },
    /// I₃ ≤ I₁ + I₂ is violated: no distribution of mass has such an inertia tensor.
    #[error(
        "principal moments violate the triangle inequality: {} exceeds {} + {} kg m²",
        principal_moments[2], principal_moments[0], principal_moments[1]
    )]
    InertiaTriangleInequality {
        /// Principal moments I₁ ≤ I₂ ≤ I₃, in kg m².
        principal_moments: [f64; 3],
    },
    /// The inertia of a symmetric top is symmetric about its axis: violated beyond rounding.
    #[error("the inertia is not symmetric about the axis {axis:?}: its entries there differ by {difference} kg m²")]
    NotSymmetricAbout {
        /// The axis, in body components.
        axis: [f64; 3],
        /// The largest difference of an entry from that of a symmetric body, in kg m².
        difference: f64,
    },
    /// A quaternion or an axis has no direction.
    #[error("{quantity} has length {length}, which gives no direction")]
    NoDirection {
        /// What the vector is.
        quantity: &'static str,
        /// Its length.
        length: f64,
    },
    /// |q| = 1 is violated beyond rounding.
    #[error("quaternion of length {length} is not a unit quaternion")]
    NotUnitQuaternion {
        /// Its length.
        length: f64,
    },
    /// Q Qᵀ = 1, det Q = 1 is violated beyond rounding.
    #[error("matrix is not a rotation: the largest entry of Q Qᵀ − 1 is {deviation}, det Q = {determinant}")]
    NotRotation {
        /// Largest entry of Q Qᵀ − 1.
        deviation: f64,
        /// det Q.
        determinant: f64,
    },
    /// cond W < 1/ε is violated: at a gimbal point the rates of Eulerian angles do not exist.
    #[error("the second angle, {theta2} rad, is at a gimbal point (condition number {condition_number})")]
    GimbalPoint {
        /// θ² (rad).
        theta2: f64,
        /// cond W.
        condition_number: f64,
    },
    /// 2 ≤ threshold < ∞ is violated: below it every chart would have to be left at some attitude.
    #[error("the condition number at which to leave a chart is {threshold}; it must be finite and at least {least}")]
    ConditionThreshold {
        /// The threshold given.
        threshold: f64,
        /// What it must at least be.
        least: f64,
    },
    /// 0 < volume is violated by the vertices of a solid.
    #[error("the vertices span the volume {volume} m³, which is zero to rounding")]
    NoVolume {
        /// The volume, in m³.
        volume: f64,
    },
    /// index < number of vertices is violated by a triangle.
    #[error("corner {corner} of triangle {triangle} is vertex {index}, but there are {vertices} vertices")]
    MeshIndex {
        /// The triangle, from 0.
        triangle: usize,
        /// Its corner, from 0.
        corner: usize,
        /// The index given.
        index: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A triangle has the same vertex at two corners.
    #[error("triangle {triangle} has one vertex at two corners: {vertices:?}")]
    MeshTriangle {
        /// The triangle, from 0.
        triangle: usize,
        /// Its vertices.
        vertices: [usize; 3],
    },
    /// ∂(surface) = 0 is violated: an edge belongs to an odd number of triangles, as at the rim of a hole.
    #[error("mesh is not closed: triangle {triangle} has no neighbour at the edge {edge:?}")]
    MeshNotClosed {
        /// The two vertices, ascending.
        edge: (usize, usize),
        /// A triangle at the edge, from 0.
        triangle: usize,
    },
    /// Two triangles pass their common edge in the same direction: one of them is turned inside out.
    #[error(
        "triangles {triangles:?} have opposite orientations: both run along the edge {edge:?} in the same direction"
    )]
    MeshOrientation {
        /// The two vertices, ascending.
        edge: (usize, usize),
        /// The two triangles, from 0.
        triangles: (usize, usize),
    },
    /// 0 < volume is violated because all triangles are turned inside out.
    #[error("mesh encloses the volume {volume} m³: its triangles are turned inside out")]
    MeshInverted {
        /// The signed volume, in m³.
        volume: f64,
    },
    /// A system has no particles.
    #[error("the system has no particles")]
    NoParticles,
    /// Two sequences that describe the same things differ in length.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// What is counted.
        quantity: &'static str,
        /// How many are needed.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// direction < number of coordinates is violated (the time of a time-dependent system counts as one
    /// more coordinate, after the others).
    #[error("direction {direction} does not exist: the number of directions is {directions}")]
    NoSuchDirection {
        /// The direction asked for, from 0.
        direction: usize,
        /// How many there are.
        directions: usize,
    },
    /// rank ∂(placement)/∂q = n is violated: some combination of the coordinates moves nothing.
    #[error("coordinates {coordinates:?} (from 0) are dependent: the placement has rank {rank}")]
    DependentCoordinates {
        /// The coordinates that take part in a motion of the coordinates which moves nothing, from 0.
        coordinates: Vec<usize>,
        /// Rank of the placement's Jacobian.
        rank: usize,
    },
}

/// 0 < mass < ∞.
pub(crate) fn positive_mass(mass: f64) -> Result<(), KinematicsError> {
    finite("mass", &[mass])?;
    if mass <= 0.0 {
        return Err(KinematicsError::NonPositiveMass { mass });
    }
    Ok(())
}

/// |values| < ∞ in all lanes.
pub(crate) fn finite<T: piola_numerics::Real>(quantity: &'static str, values: &[T]) -> Result<(), KinematicsError> {
    match crate::vector::first_non_finite(values) {
        None => Ok(()),
        Some((index, value)) => Err(KinematicsError::NotFinite { quantity, index, value }),
    }
}

/// found = expected.
pub(crate) fn length(quantity: &'static str, found: usize, expected: usize) -> Result<(), KinematicsError> {
    if found == expected { Ok(()) } else { Err(KinematicsError::WrongLength { quantity, expected, found }) }
}
