//! The state of a run, updated with compensation, and what an observer sees of it.

use core::ops::ControlFlow;

use piola_numerics::Real;

use crate::IntegrationError;
use crate::field::largest_lane;

/// A time and a state, each with the rounding error that the last updates left behind.
///
/// Updates are compensated: the low part of every increment is carried to the next step, so that after N
/// steps the rounding error of the sum is of the order of one ulp instead of √N or N.
///
/// # Example
/// ```
/// use piola_integrators::State;
/// let state = State::new(0.0, vec![1.0, 0.0])?;
/// assert_eq!(state.values, [1.0, 0.0]);
/// # Ok::<(), piola_integrators::IntegrationError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct State<T = f64> {
    /// The time t, s.
    pub time: f64,
    /// The components y; for a mechanical system positions first, then velocities or momenta.
    pub values: Vec<T>,
    /// What rounding left of the last updates: y + carry is the compensated state.
    pub(crate) carry: Vec<T>,
    pub(crate) time_carry: f64,
}

impl<T: Real> State<T> {
    /// A state at a time.
    ///
    /// # Errors
    /// [`IntegrationError::NonFiniteTime`], [`IntegrationError::NonFiniteState`].
    pub fn new(time: f64, values: Vec<T>) -> Result<Self, IntegrationError> {
        if !time.is_finite() {
            return Err(IntegrationError::NonFiniteTime { time });
        }
        for (index, &value) in values.iter().enumerate() {
            let magnitude = largest_lane(value);
            if !magnitude.is_finite() {
                return Err(IntegrationError::NonFiniteState { index, value: magnitude });
            }
        }
        let carry = vec![T::zero(); values.len()];
        Ok(Self { time, values, carry, time_carry: 0.0 })
    }

    pub(crate) fn advance_time(&mut self, step: f64) {
        let increment = step + self.time_carry;
        let sum = self.time + increment;
        self.time_carry = increment - (sum - self.time);
        self.time = sum;
    }

    pub(crate) fn set_time(&mut self, time: f64) {
        self.time = time;
        self.time_carry = 0.0;
    }
}

/// Adds an increment to y and keeps in `carry` what rounding lost (Kahan's compensated update).
#[inline(always)]
pub(crate) fn compensated_add<T: Real>(y: &mut T, carry: &mut T, increment: T) {
    let increment = increment + *carry;
    let sum = *y + increment;
    *carry = increment - (sum - *y);
    *y = sum;
}

/// One accepted step, as its observer sees it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a, T = f64> {
    /// The number of the step, from 1.
    pub number: u64,
    /// The time at its end, s.
    pub time: f64,
    /// The state at its end.
    pub values: &'a [T],
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Ending {
    /// The end time was reached.
    Reached,
    /// The observer asked to stop.
    Stopped,
    /// The event of this index ended the run.
    Event(usize),
}

/// What a run cost and how it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Accepted steps.
    pub steps: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    /// Evaluations of the field (of the force, for separable systems).
    pub evaluations: u64,
    /// How it ended.
    pub ending: Ending,
}

impl Report {
    pub(crate) const fn begin() -> Self {
        Self { steps: 0, rejected: 0, evaluations: 0, ending: Ending::Reached }
    }
    /// This run followed by another.
    #[must_use]
    pub const fn then(self, next: Self) -> Self {
        Self {
            steps: self.steps + next.steps,
            rejected: self.rejected + next.rejected,
            evaluations: self.evaluations + next.evaluations,
            ending: next.ending,
        }
    }
}

/// The observer that watches nothing and never stops a run.
pub fn unobserved<T>(_step: Step<'_, T>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Splits [start, end] into the fewest equal steps no longer than `step`; backwards in time if end < start.
pub(crate) fn equal_steps(start: f64, end: f64, step: f64) -> (u64, f64) {
    let span = end - start;
    // A span that is a whole number of steps but for rounding is not given one more.
    let count = (span.abs() / step * (1.0 - 4.0 * f64::EPSILON)).ceil().max(0.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count: not negative, and the cast saturates"
    )]
    let steps = count as u64;
    (steps, if steps == 0 { 0.0 } else { span / count })
}

pub(crate) fn check_step<E>(step: f64) -> Result<(), IntegrationError<E>> {
    if 0.0 < step && step < f64::INFINITY { Ok(()) } else { Err(IntegrationError::InvalidStep { step }) }
}

pub(crate) fn check_run<T, E>(expected: usize, state: &State<T>, end: f64) -> Result<(), IntegrationError<E>> {
    if state.values.len() != expected {
        return Err(IntegrationError::DimensionMismatch { expected, found: state.values.len() });
    }
    if !end.is_finite() {
        return Err(IntegrationError::NonFiniteTime { time: end });
    }
    Ok(())
}

pub(crate) fn check_finite<T: Real, E>(time: f64, rate: &[T]) -> Result<(), IntegrationError<E>> {
    match rate.iter().position(|&x| !largest_lane(x).is_finite()) {
        None => Ok(()),
        Some(index) => Err(IntegrationError::NonFiniteRate { time, index }),
    }
}
