//! What can go wrong while stepping in time.

use core::convert::Infallible;

/// Why a run did not start or did not reach its end.
///
/// A run that fails keeps what it had computed: the [`State`](crate::State) stands at the last accepted
/// step, and the observer has seen every step before it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegratorsError<E = Infallible> {
    /// A state, or the memory for one, does not fit the field.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The name of the argument.
        quantity: &'static str,
        /// The number of entries it must have: the field's dimension.
        expected: usize,
        /// The number of entries it has.
        found: usize,
    },
    /// An entry of a sparse matrix lies outside of it.
    #[error(
        "`{quantity}` has an entry in row {row}, column {column}; it has {dimension} rows and columns, counted from 0"
    )]
    OutsideMatrix {
        /// The name of the argument.
        quantity: &'static str,
        /// The entry's row, counted from 0.
        row: usize,
        /// The entry's column, counted from 0.
        column: usize,
        /// The number of rows and of columns.
        dimension: usize,
    },
    /// A [`Checkpoint`](crate::Checkpoint) that another method made.
    #[error("the checkpoint was made by `{found}`; `{expected}` cannot continue it")]
    WrongMethod {
        /// The method that was to continue the run.
        expected: &'static str,
        /// The method that made the checkpoint.
        found: &'static str,
    },
    /// A number that should be a row of a matrix is none.
    #[error("entry {index} of `{quantity}` is {value}; a row is a whole number, at least 0 and below {dimension}")]
    InvalidRow {
        /// The name of the argument.
        quantity: &'static str,
        /// The index of the number, counted from 0.
        index: usize,
        /// The number.
        value: f64,
        /// The number of rows.
        dimension: usize,
    },
    /// A number is infinite or NaN: a time or a state that was given, or a rate or a state that a step led to.
    ///
    /// An adaptive method returns the latter only where no shorter step avoids it.
    #[error("entry {index} of `{quantity}` is {value}{}, which is not a finite number", at(*t))]
    NotFinite {
        /// The name of the argument, or of what was computed, such as `rate`.
        quantity: &'static str,
        /// The index of the first such entry, counted from 0.
        index: usize,
        /// The entry.
        value: f64,
        /// The time of the last complete step where a step led to the number; none where it was given.
        t: Option<f64>,
    },
    /// Numbers that should be an element of a Lie group are none: a quaternion whose length is not one.
    #[error("the state is off its group by {defect:e} from entry {index} on: a quaternion there must have length one")]
    OutsideGroup {
        /// The index of the first number of the part that is off, counted from 0.
        index: usize,
        /// By how much; for a quaternion |q| − 1, to first order.
        defect: f64,
    },
    /// A spectral radius at infinity that violates 0 ≤ ρ∞ ≤ 1.
    #[error("the spectral radius at infinity {spectral_radius} must satisfy 0 ≤ ρ∞ ≤ 1")]
    InvalidDamping {
        /// The radius given.
        spectral_radius: f64,
    },
    /// A time step that violates 0 < h < ∞.
    #[error("the time step {step} must satisfy 0 < h < ∞")]
    InvalidStep {
        /// The step given.
        step: f64,
    },
    /// A number that must be positive.
    #[error("`{quantity}` is {value}, which is not positive")]
    NotPositive {
        /// The name of the argument.
        quantity: &'static str,
        /// The number given.
        value: f64,
    },
    /// A field in (q, p) whose dimension is odd.
    #[error("the dimension {dimension} is odd: a field in (q, p) has two equal halves")]
    OddDimension {
        /// The dimension of the field.
        dimension: usize,
    },
    /// Accelerations that depend on velocities, given to a Nyström pair.
    #[error("the accelerations depend on velocities: a Nyström pair is for q̈ = f(t, q)")]
    VelocityDependent,
    /// A tolerance that violates 0 ≤ tolerance < 1, or both tolerances zero.
    #[error(
        "the relative tolerance {relative} and the absolute tolerance {absolute} must be finite, not negative and not \
         both zero; the relative tolerance must be below 1"
    )]
    InvalidTolerance {
        /// The relative tolerance given.
        relative: f64,
        /// The absolute tolerance given.
        absolute: f64,
    },
    /// The field refused to be evaluated; for an adaptive method: however small the step.
    #[error("the field could not be evaluated at t = {t}: {source}")]
    Field {
        /// The time of the evaluation.
        t: f64,
        /// What the field said.
        source: E,
    },
    /// The step shrank until it no longer advances the time.
    #[error("the step {step} no longer advances t = {t}: the field may be singular there")]
    StepTooSmall {
        /// The time of the last accepted step.
        t: f64,
        /// The last step tried.
        step: f64,
    },
    /// The limit on the number of steps was reached.
    #[error(
        "the run reached its limit on the number of steps, {steps}, at t = {t}: allow more steps or a larger tolerance"
    )]
    TooManySteps {
        /// The time reached.
        t: f64,
        /// The number of steps taken.
        steps: u64,
    },
    /// The stages of an implicit step did not converge.
    #[error(
        "the stages of the step from t = {t} did not converge in {iterations} iterations (the last one changed the \
         increment by the fraction {change:e}): take a step smaller than {step}"
    )]
    StagesDiverged {
        /// The time at the start of the step.
        t: f64,
        /// The step.
        step: f64,
        /// Iterations made.
        iterations: usize,
        /// The last change of the stages, relative to the increment.
        change: f64,
    },
    /// The matrix of Newton's iteration is singular, however small the step.
    #[error("the matrix of the step {step} from t = {t} is singular: its pivot {pivot} is zero or not finite")]
    SingularMatrix {
        /// The time at the start of the step.
        t: f64,
        /// The step.
        step: f64,
        /// The index of the pivot, counted from 0.
        pivot: usize,
    },
    /// A constrained system whose differentiation index is above two.
    #[error(
        "component {component} has the differentiation index {index} at t = {t}; it must be 1 or 2: differentiate the \
         constraints until it is, or give constraints on velocities"
    )]
    IndexTooHigh {
        /// The component, counted from 0: a reaction.
        component: usize,
        /// Its index.
        index: u32,
        /// The time at which it was found.
        t: f64,
    },
    /// The function of an event is NaN.
    #[error("the function of event {event} is NaN at t = {t}")]
    InvalidEvent {
        /// The index of the event in the list given.
        event: usize,
        /// The time.
        t: f64,
    },
    /// Dense output was asked for outside the step it belongs to.
    #[error("t = {t} lies outside the step [{start}, {end}]: dense output never extrapolates")]
    OutsideStep {
        /// The time asked for.
        t: f64,
        /// One end of the step.
        start: f64,
        /// The other end.
        end: f64,
    },
}

/// " at t = …", where a time is known.
fn at(t: Option<f64>) -> String {
    t.map(|t| format!(" at t = {t}")).unwrap_or_default()
}

impl IntegratorsError<Infallible> {
    /// The same error where the field can fail.
    #[must_use]
    pub fn with_field_error<E>(self) -> IntegratorsError<E> {
        match self {
            Self::WrongLength { quantity, expected, found } => {
                IntegratorsError::WrongLength { quantity, expected, found }
            }
            Self::OutsideMatrix { quantity, row, column, dimension } => {
                IntegratorsError::OutsideMatrix { quantity, row, column, dimension }
            }
            Self::WrongMethod { expected, found } => IntegratorsError::WrongMethod { expected, found },
            Self::InvalidRow { quantity, index, value, dimension } => {
                IntegratorsError::InvalidRow { quantity, index, value, dimension }
            }
            Self::NotFinite { quantity, index, value, t } => IntegratorsError::NotFinite { quantity, index, value, t },
            Self::OutsideGroup { index, defect } => IntegratorsError::OutsideGroup { index, defect },
            Self::InvalidDamping { spectral_radius } => IntegratorsError::InvalidDamping { spectral_radius },
            Self::NotPositive { quantity, value } => IntegratorsError::NotPositive { quantity, value },
            Self::VelocityDependent => IntegratorsError::VelocityDependent,
            Self::OddDimension { dimension } => IntegratorsError::OddDimension { dimension },
            Self::InvalidStep { step } => IntegratorsError::InvalidStep { step },
            Self::InvalidTolerance { relative, absolute } => IntegratorsError::InvalidTolerance { relative, absolute },
            Self::Field { source, .. } => match source {},
            Self::StepTooSmall { t, step } => IntegratorsError::StepTooSmall { t, step },
            Self::TooManySteps { t, steps } => IntegratorsError::TooManySteps { t, steps },
            Self::StagesDiverged { t, step, iterations, change } => {
                IntegratorsError::StagesDiverged { t, step, iterations, change }
            }
            Self::SingularMatrix { t, step, pivot } => IntegratorsError::SingularMatrix { t, step, pivot },
            Self::IndexTooHigh { component, index, t } => IntegratorsError::IndexTooHigh { component, index, t },
            Self::InvalidEvent { event, t } => IntegratorsError::InvalidEvent { event, t },
            Self::OutsideStep { t, start, end } => IntegratorsError::OutsideStep { t, start, end },
        }
    }
}
