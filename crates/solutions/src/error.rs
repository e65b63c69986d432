//! Violated conditions of exact solutions: each variant names one.

use piola_continuum::ContinuumError;
use piola_fields::FieldsError;
use piola_numerics::NumericsError;
use piola_solids::SolidsError;
use piola_tensor::TensorError;

/// A violated condition of an exact solution or of its loads.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolutionsError {
    /// A number is infinite or NaN.
    #[error("{quantity}[{index}] = {value} is not finite")]
    NotFinite {
        /// What the number is.
        quantity: &'static str,
        /// Its position.
        index: usize,
        /// The number itself.
        value: f64,
    },
    /// A quantity is outside its bounds.
    #[error("{quantity} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < R`.
        bound: &'static str,
    },
    /// The constants of a family change volumes.
    #[error(
        "{family}: {constraint} is violated: the left side is {value:e}; with the other constants {constant} = {nearest:e}"
    )]
    ConstraintViolated {
        /// The family.
        family: &'static str,
        /// The constraint, such as `A (B E − C D) = 1`.
        constraint: &'static str,
        /// Its left side.
        value: f64,
        /// The constant to change.
        constant: &'static str,
        /// The value of the constant that satisfies the constraint.
        nearest: f64,
    },
    /// The map is not defined at a particle: a radicand is not positive.
    #[error(
        "the map leaves its domain at the reference coordinate {coordinate:e}: {quantity} = {value:e} violates {bound}"
    )]
    OutsideDomain {
        /// The quantity that must be positive, such as `A R² + B`.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The condition, such as `0 < A R² + B`.
        bound: &'static str,
        /// The reference coordinate, m.
        coordinate: f64,
    },
    /// No state of the range carries the load: it is beyond a limit point.
    #[error("{load} = {value:e} is beyond the limit point {limit:e}, at {parameter} = {at:e}")]
    BeyondLimitPoint {
        /// The load.
        load: &'static str,
        /// Its value.
        value: f64,
        /// The load of the nearest limit point.
        limit: f64,
        /// The parameter of the curve.
        parameter: &'static str,
        /// Its value at the limit point.
        at: f64,
    },
    /// No state of the range carries the load: it is beyond the ends of the range.
    #[error("{load} = {value:e} is not reached for {parameter} from {low:e} to {high:e}: the nearest is {nearest:e}")]
    NotReached {
        /// The load.
        load: &'static str,
        /// Its value.
        value: f64,
        /// The nearest load of the range.
        nearest: f64,
        /// The parameter of the curve.
        parameter: &'static str,
        /// One end of the range.
        low: f64,
        /// The other end.
        high: f64,
    },
    /// Newton's iteration ended away from a solution.
    #[error("no state found that carries {load}: {residual:e} of it is left after {iterations} iterations")]
    NotConverged {
        /// The loads that are prescribed.
        load: &'static str,
        /// The loads found less those prescribed, relative to the scale of the loads.
        residual: f64,
        /// Iterations.
        iterations: usize,
    },
    /// An integral is not as accurate as it must be.
    #[error("the integral of {quantity} is uncertain by {error:e} beside {size:e}")]
    IntegralNotConverged {
        /// The integrand.
        quantity: &'static str,
        /// The estimated error.
        error: f64,
        /// ∫ |f|.
        size: f64,
    },
    /// The acceleration of a motion has no potential: no pressure balances it.
    #[error("the acceleration has no potential at t = {t:e}: {condition} is violated by {residual:e} beside {scale:e}")]
    NoPotential {
        /// The condition.
        condition: &'static str,
        /// Its left side less its right.
        residual: f64,
        /// The sum of the moduli of its terms.
        scale: f64,
        /// The time, s.
        t: f64,
    },
    /// A motion does not return: no turning point lies within the range.
    #[error(
        "the motion is not periodic: from the stretch {start:e} it does not turn before {reached:e}, where {energy:e} J is left to move"
    )]
    NotPeriodic {
        /// The stretch at the start.
        start: f64,
        /// The end of the range of stretches.
        reached: f64,
        /// The kinetic energy there, J (of a tube J/m).
        energy: f64,
    },
    /// A deformation or stress is refused.
    #[error(transparent)]
    Continuum(ContinuumError),
    /// A field or a point is refused.
    #[error(transparent)]
    Fields(FieldsError),
    /// The law refuses.
    #[error(transparent)]
    Solids(SolidsError),
    /// A linear system is singular.
    #[error(transparent)]
    Numerics(NumericsError),
}

impl From<ContinuumError> for SolutionsError {
    fn from(error: ContinuumError) -> Self {
        match error {
            ContinuumError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            other => Self::Continuum(other),
        }
    }
}

impl From<FieldsError> for SolutionsError {
    fn from(error: FieldsError) -> Self {
        match error {
            FieldsError::Continuum(error) => error.into(),
            FieldsError::NotFinite { quantity, index, value } => Self::NotFinite { quantity, index, value },
            other => Self::Fields(other),
        }
    }
}

impl From<SolidsError> for SolutionsError {
    fn from(error: SolidsError) -> Self {
        match error {
            SolidsError::Continuum(error) => error.into(),
            other => Self::Solids(other),
        }
    }
}

impl From<TensorError> for SolutionsError {
    fn from(error: TensorError) -> Self {
        ContinuumError::from(error).into()
    }
}

impl From<NumericsError> for SolutionsError {
    fn from(error: NumericsError) -> Self {
        Self::Numerics(error)
    }
}

/// Refuses numbers that are not finite, by name and position.
pub(crate) fn check_finite(quantity: &'static str, values: &[f64]) -> Result<(), SolutionsError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(SolutionsError::NotFinite { quantity, index, value: values[index] }),
        None => Ok(()),
    }
}

/// Refuses a quantity that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    quantity: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), SolutionsError> {
    check_finite(quantity, &[value])?;
    if holds { Ok(()) } else { Err(SolutionsError::OutOfBounds { quantity, value, bound }) }
}
