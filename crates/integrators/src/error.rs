//! What can go wrong while stepping in time.

use core::convert::Infallible;

/// Why a run did not start or did not reach its end.
///
/// A run that fails keeps what it had computed: the [`State`](crate::State) stands at the last accepted
/// step, and the observer has seen every step before it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegratorsError<E = Infallible> {
    /// The state does not fit the field.
    #[error("the field has dimension {expected}, but the state has {found} components")]
    DimensionMismatch {
        /// The field's dimension.
        expected: usize,
        /// The number of components of the state.
        found: usize,
    },
    /// A time, or the time between start and end, that is infinite or NaN.
    #[error("the time {time} is not finite")]
    NonFiniteTime {
        /// The time given.
        time: f64,
    },
    /// A component of the state a run starts from that is infinite or NaN.
    #[error("component {index} of the state is {value}; every component must be finite")]
    NonFiniteState {
        /// The component's index.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A time step that violates 0 < h < ∞.
    #[error("the time step {step} must satisfy 0 < h < ∞")]
    InvalidStep {
        /// The step given.
        step: f64,
    },
    /// A tolerance that violates 0 ≤ tolerance < 1, or both tolerances zero.
    #[error(
        "the relative tolerance {relative} and the absolute tolerance {absolute} must be finite, not negative and not both zero, and the relative one below 1"
    )]
    InvalidTolerance {
        /// The relative tolerance given.
        relative: f64,
        /// The absolute tolerance given.
        absolute: f64,
    },
    /// The field refused to be evaluated; for an adaptive method: however small the step.
    #[error("the field could not be evaluated at time {time}: {source}")]
    Field {
        /// The time of the evaluation.
        time: f64,
        /// What the field said.
        source: E,
    },
    /// The rate became infinite or NaN; for an adaptive method: however small the step.
    #[error("the rate of component {index} is not finite at time {time}")]
    NonFiniteRate {
        /// The time of the last accepted step.
        time: f64,
        /// The first component concerned.
        index: usize,
    },
    /// The step shrank until it no longer advances the time.
    #[error("the step {step} no longer advances the time {time}: the field may be singular there")]
    StepTooSmall {
        /// The time of the last accepted step.
        time: f64,
        /// The last step tried.
        step: f64,
    },
    /// The limit on the number of steps was reached.
    #[error("{steps} steps were taken and only time {time} was reached; allow more steps or a larger tolerance")]
    TooManySteps {
        /// The time reached.
        time: f64,
        /// The number of steps taken.
        steps: u64,
    },
    /// The stages of an implicit step did not converge.
    #[error(
        "the stages of the step from time {time} did not converge in {iterations} iterations (last change {change:e} of the increment): take a step smaller than {step}"
    )]
    StagesDiverged {
        /// The time at the start of the step.
        time: f64,
        /// The step.
        step: f64,
        /// Iterations made.
        iterations: usize,
        /// The last change of the stages, relative to the increment.
        change: f64,
    },
    /// The function of an event is NaN.
    #[error("the function of event {event} is NaN at time {time}")]
    InvalidEvent {
        /// The index of the event in the list given.
        event: usize,
        /// The time.
        time: f64,
    },
    /// Dense output was asked for outside the step it belongs to.
    #[error("time {time} lies outside the step [{start}, {end}]: dense output never extrapolates")]
    OutsideStep {
        /// The time asked for.
        time: f64,
        /// One end of the step.
        start: f64,
        /// The other end.
        end: f64,
    },
}

impl IntegratorsError<Infallible> {
    /// The same error where the field can fail.
    #[must_use]
    pub fn with_field_error<E>(self) -> IntegratorsError<E> {
        match self {
            Self::DimensionMismatch { expected, found } => IntegratorsError::DimensionMismatch { expected, found },
            Self::NonFiniteTime { time } => IntegratorsError::NonFiniteTime { time },
            Self::NonFiniteState { index, value } => IntegratorsError::NonFiniteState { index, value },
            Self::InvalidStep { step } => IntegratorsError::InvalidStep { step },
            Self::InvalidTolerance { relative, absolute } => IntegratorsError::InvalidTolerance { relative, absolute },
            Self::Field { source, .. } => match source {},
            Self::NonFiniteRate { time, index } => IntegratorsError::NonFiniteRate { time, index },
            Self::StepTooSmall { time, step } => IntegratorsError::StepTooSmall { time, step },
            Self::TooManySteps { time, steps } => IntegratorsError::TooManySteps { time, steps },
            Self::StagesDiverged { time, step, iterations, change } => {
                IntegratorsError::StagesDiverged { time, step, iterations, change }
            }
            Self::InvalidEvent { event, time } => IntegratorsError::InvalidEvent { event, time },
            Self::OutsideStep { time, start, end } => IntegratorsError::OutsideStep { time, start, end },
        }
    }
}
