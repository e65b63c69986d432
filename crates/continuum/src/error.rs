//! What can be wrong with the data of a continuum: each variant names the violated condition and holds the numbers.

use piola_numerics::Real;
use piola_tensor::TensorError;

/// A violated condition of continuum mechanics at a point.
///
/// A number that is not finite is [`NotFinite`](Self::NotFinite) wherever it was found; every other condition on a tensor
/// is wrapped.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContinuumError {
    /// A violated condition on a tensor.
    #[error(transparent)]
    Tensor(TensorError),
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
    /// A number is outside its bounds.
    #[error("{quantity} = {value:e} violates {bound}")]
    OutOfBounds {
        /// What the number is.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < horizon`.
        bound: &'static str,
    },
    /// 0 < det F is violated: the body is turned inside out or flattened.
    #[error("det F = {determinant:e} is not positive: the body is turned inside out or flattened")]
    NonPositiveJacobian {
        /// det F.
        determinant: f64,
    },
    /// 0 < det F holds, but det F is smaller than the smallest number.
    #[error("det F = 10^({logarithm}) is positive but too small for the scalar type")]
    VanishingJacobian {
        /// log₁₀ det F.
        logarithm: f64,
    },
    /// 0 < λ is violated for a principal stretch.
    #[error("principal stretch {index} is {value}, not positive")]
    NonPositiveStretch {
        /// Which stretch, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// λ₁ > λ₂ > λ₃ is violated where single principal axes are asked for.
    #[error("two of the principal stretches {stretches:?} are equal to rounding: the rates of their axes do not exist")]
    CoalescentStretches {
        /// The stretches.
        stretches: [f64; 3],
    },
    /// An eigenvalue of F is zero or negative where the principal logarithm is asked for.
    #[error("F has no real principal logarithm: an eigenvalue is zero or negative")]
    NoPrincipalLogarithm,
    /// 0 < |n| is violated: a normal has no direction.
    #[error("the normal is the zero vector, which has no direction")]
    ZeroNormal,
    /// 0 < |dev T| is violated where a ratio to it is asked for.
    #[error("the deviator is zero: a hydrostatic stress, here of mean {mean:e}, has no triaxiality")]
    ZeroDeviator {
        /// ⅓ tr T.
        mean: f64,
    },
}

impl From<TensorError> for ContinuumError {
    fn from(error: TensorError) -> Self {
        match error {
            TensorError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            other => Self::Tensor(other),
        }
    }
}

/// The first number that is infinite or NaN in any lane, by name and position.
#[inline]
pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), ContinuumError> {
    Ok(piola_tensor::internal::check_finite(quantity, values)?)
}

/// Refuses a number that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    quantity: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), ContinuumError> {
    check_finite(quantity, &[value])?;
    if holds { Ok(()) } else { Err(ContinuumError::OutOfBounds { quantity, value, bound }) }
}
