//! Violated conditions of laws of solids: each variant names one.

#[cfg(feature = "batch")]
use piola_batch::BatchError;
use piola_continuum::ContinuumError;
use piola_tensor::TensorError;

/// A violated condition of a law of a solid or of a constraint.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidsError {
    /// A parameter is infinite or NaN.
    #[error("{law}: {parameter} = {value} is not finite")]
    NotFinite {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter is outside its bounds.
    #[error("{law}: {parameter} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < μ`.
        bound: &'static str,
    },
    /// The deformation is beyond the limit of the law.
    #[error("{law}: {quantity} = {value:e} is not below its limit {limit:e}")]
    BeyondLimit {
        /// The law.
        law: &'static str,
        /// The limited quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its upper limit.
        limit: f64,
    },
    /// The law has no limit here, but the result overflows the scalar.
    #[error("`{answer}` overflows the scalar type at this deformation")]
    Overflow {
        /// The requested quantity.
        answer: &'static str,
    },
    /// A constraint is not the same for all observers: its reaction is not symmetric.
    #[error(
        "the constraint depends on the observer: its reaction has a skew part of {skew:e}, with a largest entry of \
         {size:e}"
    )]
    ConstraintDependsOnObserver {
        /// The largest entry of the skew part of F (∂μ/∂F)ᵀ.
        skew: f64,
        /// The largest entry of F (∂μ/∂F)ᵀ.
        size: f64,
    },
    /// A constraint follows from others.
    #[error("constraint {index} is redundant: rank {rank} of {count} (independent part {share:e})")]
    RedundantConstraint {
        /// The constraint, from 0.
        index: usize,
        /// How many are independent.
        rank: usize,
        /// How many there are.
        count: usize,
        /// The part of its reaction independent of the others', as a share of it.
        share: f64,
    },
    /// Constraints contradict one another.
    #[error("constraint {index} contradicts the others (residual {residual:e})")]
    InconsistentConstraints {
        /// The constraint, from 0.
        index: usize,
        /// Its value less the one that follows from the others.
        residual: f64,
    },
    /// The deformation violates a constraint.
    #[error("the deformation violates constraint {index}: its value is {value:e}, beyond the tolerance {tolerance:e}")]
    ConstraintViolated {
        /// The constraint, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// The largest modulus allowed.
        tolerance: f64,
    },
    /// Conditions on the stress do not determine the multiplier of a constraint.
    #[error(
        "the conditions do not determine the multiplier of constraint {index}: their rank is {rank}, the number of \
         multipliers {count}"
    )]
    UndeterminedMultiplier {
        /// The constraint, from 0.
        index: usize,
        /// How many multipliers they determine.
        rank: usize,
        /// How many there are.
        count: usize,
    },
    /// No multipliers satisfy a condition on the stress.
    #[error("no reaction satisfies condition {index} (residual {residual:e} Pa)")]
    ImpossibleCondition {
        /// The condition, from 0.
        index: usize,
        /// Its left side minus its right, Pa.
        residual: f64,
    },
    /// Points of a batch are bad; the outputs of all others are computed.
    #[cfg(feature = "batch")]
    #[error("{} of {count} points failed: {}", points.len(), first_of(points))]
    BadPoints {
        /// All bad points, in order.
        points: Vec<BadPoint>,
        /// The number of points of the batch.
        count: usize,
        /// How many good points took the slow path of the analysis of the stretches.
        slow_path: usize,
    },
    /// The deformation or stress itself is refused.
    #[error(transparent)]
    Continuum(#[from] ContinuumError),
    /// A view of a batch is refused.
    #[cfg(feature = "batch")]
    #[error(transparent)]
    Batch(BatchError),
}

impl From<TensorError> for SolidsError {
    fn from(error: TensorError) -> Self {
        ContinuumError::from(error).into()
    }
}

#[cfg(feature = "batch")]
impl From<BatchError> for SolidsError {
    fn from(error: BatchError) -> Self {
        match error {
            BatchError::Continuum(error) => error.into(),
            BatchError::NotFinite { quantity, index, value } => {
                ContinuumError::NotFinite { quantity, index, value }.into()
            }
            other => Self::Batch(other),
        }
    }
}

#[cfg(feature = "batch")]
/// A point of a batch at which something is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct BadPoint {
    /// Which point, from 0.
    pub index: usize,
    /// The error of the law, or of the constructor of a single deformation.
    pub error: SolidsError,
}

/// The first bad point in words.
#[cfg(feature = "batch")]
fn first_of(points: &[BadPoint]) -> String {
    points.first().map_or_else(String::new, |point| format!("at point {}, {}", point.index, point.error))
}

/// Refuses a parameter that is not finite.
pub(crate) fn check_finite(law: &'static str, parameter: &'static str, value: f64) -> Result<(), SolidsError> {
    if value.is_finite() { Ok(()) } else { Err(SolidsError::NotFinite { law, parameter, value }) }
}

/// Refuses a parameter that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), SolidsError> {
    check_finite(law, parameter, value)?;
    if holds { Ok(()) } else { Err(SolidsError::OutOfBounds { law, parameter, value, bound }) }
}
