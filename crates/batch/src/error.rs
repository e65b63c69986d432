//! What can be wrong with a batch: each variant names the violated condition and holds the numbers.

use piola_continuum::ContinuumError;
use piola_tensor::TensorError;

use crate::Refusal;

/// A violated condition of a batch or of one of its points.
///
/// A number that is not finite is [`NotFinite`](Self::NotFinite) wherever it was found; every other condition at a point
/// is wrapped.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BatchError {
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
    /// Points of a batch are bad; the outputs of all others are computed.
    #[error("{} of {count} points failed: {}", points.len(), first_of(points))]
    BadPoints {
        /// All bad points, in order.
        points: Vec<BadPoint>,
        /// The number of points of the batch.
        count: usize,
        /// How many good points took the slow path of the analysis of the stretches.
        slow_path: usize,
    },
    /// A quantity of a batch has no value at a point.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl From<ContinuumError> for BatchError {
    fn from(error: ContinuumError) -> Self {
        match error {
            ContinuumError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            other => Self::Continuum(other),
        }
    }
}

impl From<TensorError> for BatchError {
    fn from(error: TensorError) -> Self {
        ContinuumError::from(error).into()
    }
}

/// A point of a batch at which something is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct BadPoint {
    /// Which point, from 0.
    pub index: usize,
    /// The violated condition, as the constructor of a single point reports it.
    pub error: BatchError,
}

/// The first bad point in words.
fn first_of(points: &[BadPoint]) -> String {
    points.first().map_or_else(String::new, |point| format!("at point {}, {}", point.index, point.error))
}
