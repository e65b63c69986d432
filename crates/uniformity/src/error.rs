//! Violated conditions of uniform bodies: each variant names one and holds the numbers.

use piola_continuum::ContinuumError;
use piola_fields::FieldsError;
use piola_integrators::IntegratorsError;
use piola_numerics::linear::matrix3::determinant;
use piola_numerics::{Mask, Real};
use piola_solids::SolidsError;
use piola_tensor::{Symmetric, TensorError};

/// A violated condition on a uniformity map, a connection, a circuit or a laminated body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UniformityError {
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
    /// det K ≠ 0 is violated to rounding: the map is singular.
    #[error("K is singular at {place:?}: det K = {determinant:e} beside {scale:e}")]
    SingularMap {
        /// det K.
        determinant: f64,
        /// The volume of the box with edges as long as the rows of K.
        scale: f64,
        /// X.
        place: [f64; 3],
    },
    /// 0 < det K is violated: the map reverses the orientation.
    #[error("K reverses the orientation at {place:?}: det K = {determinant:e}")]
    OrientationReversing {
        /// det K.
        determinant: f64,
        /// X.
        place: [f64; 3],
    },
    /// A quantity is outside its bounds.
    #[error("{quantity} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The name of the quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < r`.
        bound: &'static str,
    },
    /// A circuit does not return to its first point.
    #[error("the circuit is open: it ends at {end:?}, {gap:e} m from its start {start:?}")]
    OpenCircuit {
        /// The first point.
        start: [f64; 3],
        /// The last point.
        end: [f64; 3],
        /// Their distance, m.
        gap: f64,
    },
    /// A piece of a curve does not begin where the piece before it ends.
    #[error("piece {piece} of the curve begins {gap:e} m from the end of the piece before it")]
    BrokenCurve {
        /// The piece, from 0.
        piece: usize,
        /// The distance, m.
        gap: f64,
    },
    /// A quadrature or a search ended before its tolerance was reached.
    #[error("{quantity}: error {error:e} where {allowed:e} is allowed")]
    NotConverged {
        /// What was sought.
        quantity: &'static str,
        /// The error that is left.
        error: f64,
        /// The error allowed.
        allowed: f64,
    },
    /// A matrix that is to span an algebra depends on those before it.
    #[error("matrix {index} of the basis depends on those before it: independent part {share:e}")]
    DependentBasis {
        /// Its index, from 0.
        index: usize,
        /// |part independent of the others| / |matrix|.
        share: f64,
    },
    /// The bracket of two matrices does not lie in their span: they are no Lie algebra.
    #[error("[A, B] of the matrices {first} and {second} leaves the span: part outside {share:e}")]
    NotAnAlgebra {
        /// The index of A, from 0.
        first: usize,
        /// The index of B.
        second: usize,
        /// |part outside the span| / (|A| |B|).
        share: f64,
    },
    /// The acceleration of a motion has no potential: it is no universal solution.
    #[error("the acceleration has no potential: {condition} is violated, {left:e} ≠ {right:e}")]
    NoAccelerationPotential {
        /// The condition on the parameters.
        condition: &'static str,
        /// Its left side.
        left: f64,
        /// Its right side.
        right: f64,
    },
    /// A transport along a curve failed.
    #[error("transport along piece {piece} of a curve: {source}")]
    Transport {
        /// The piece, from 0.
        piece: usize,
        /// Why.
        source: Box<IntegratorsError<UniformityError>>,
    },
    /// A field, a motion or a mesh is refused.
    #[error(transparent)]
    Fields(FieldsError),
    /// A deformation or a stress is refused.
    #[error(transparent)]
    Continuum(ContinuumError),
    /// A law refuses.
    #[error(transparent)]
    Solids(#[from] SolidsError),
    /// A tolerance of an integrator is refused.
    #[error(transparent)]
    Integrators(#[from] IntegratorsError),
}

impl From<FieldsError> for UniformityError {
    fn from(error: FieldsError) -> Self {
        match error {
            FieldsError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            FieldsError::WrongLength { quantity, found, expected } => Self::WrongLength { quantity, found, expected },
            other => Self::Fields(other),
        }
    }
}

impl From<ContinuumError> for UniformityError {
    fn from(error: ContinuumError) -> Self {
        match error {
            ContinuumError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            other => Self::Continuum(other),
        }
    }
}

impl From<TensorError> for UniformityError {
    fn from(error: TensorError) -> Self {
        ContinuumError::from(error).into()
    }
}

/// Refuses the first number that is infinite or NaN in any lane.
#[inline]
pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), UniformityError> {
    Ok(piola_tensor::internal::check_finite(quantity, values)?)
}

/// Refuses a value for which `holds` is false, or that is not finite.
pub(crate) fn check_bound(
    quantity: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), UniformityError> {
    if !value.is_finite() {
        return Err(UniformityError::NotFinite { quantity, index: 0, value });
    }
    if holds { Ok(()) } else { Err(UniformityError::OutOfBounds { quantity, value, bound }) }
}

/// The leading minors of a metric are positive in every lane.
pub(crate) fn check_metric<T: Real>(metric: &Symmetric<T>) -> Result<(), UniformityError> {
    check_finite("M", &metric.components)?;
    let m = metric.rows();
    let minors = [m[0][0], m[0][0] * m[1][1] - m[0][1] * m[1][0], determinant(m)];
    for (index, minor) in minors.into_iter().enumerate() {
        if !T::zero().less_than(minor).all() {
            let lane = (0..T::LANES).find(|&lane| minor.primal(lane) <= 0.0).unwrap_or(0);
            let (order, minor) = (index + 1, minor.primal(lane));
            return Err(TensorError::NotPositiveDefinite { quantity: "M", order, minor, scale: 1.0 }.into());
        }
    }
    Ok(())
}
