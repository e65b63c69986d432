//! What explicit pairs of formulas with adaptive steps share: the loop over the steps, the first step, the sums.
//!
//! ```text
//! h ← h · clamp(0.7 / e^(1/p), 1/3, 6)
//! ```
//!
//! with the error e of a step over what the tolerance allows. A step of e > 1 is made again.

mod dense;
mod first_step;
mod pair;
mod rows;
mod runge_kutta;
mod with_events;

use core::ops::ControlFlow;

use piola_numerics::Real;

pub use self::dense::DenseStep;
pub(crate) use self::first_step::Guess;
pub use self::pair::RungeKuttaCoefficients;
pub(crate) use self::pair::{Rows, Weights};
pub use self::pair::{RungeKutta, RungeKuttaPair};
pub(crate) use self::rows::{combine, row, row_mut, weighted_sums};
use crate::accepted::AcceptedStep;
use crate::checkpoint::{Checkpoint, RunSoFar};
use crate::events::Stop;
use crate::{Ending, IntegratorsError, Report, State};

/// The part of the largest step allowed that is taken.
///
/// At the usual 0.9 every fourth step of a double pendulum or an eccentric orbit is rejected. At 0.7 few are,
/// and for the same error at the end 23 % fewer evaluations are made (order eight, mean over double pendulum, e = 0.7 and
/// e = 0.99, tolerances from 1e-7 to 1e-13).
const SAFETY: f64 = 0.7;

/// Bounds that a user sets on the steps of a run.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The first step tried, s; estimated when none.
    pub first_step: Option<f64>,
    /// The longest step, s.
    pub longest_step: f64,
    /// The most steps of one run.
    pub most_steps: u64,
}

impl Limits {
    /// No bounds.
    #[must_use]
    pub const fn none() -> Self {
        Self { first_step: None, longest_step: f64::INFINITY, most_steps: u64::MAX }
    }
}

/// A pair of explicit formulas, with the memory of its run, for fields F.
pub trait EmbeddedPair<T: Real, F> {
    /// Why the field can fail.
    type Error;

    /// What the user allows.
    fn limits(&self) -> Limits;

    /// Checks the state, makes the first rate, and returns the first step to try. A run that is resumed takes the rate from the
    /// checkpoint.
    ///
    /// # Errors
    /// Whatever is refused at the start of a run.
    fn begin(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        resumed: Option<&Checkpoint<T>>,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<Self::Error>>;

    /// Makes the stages of a step and its end; returns the error over the tolerance.
    ///
    /// # Errors
    /// Whatever keeps a stage from being evaluated; a shorter step may then be tried.
    fn attempt(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<Self::Error>>;

    /// e^(1/p) of an error that falls with the power p of the step: by square roots, which are rounded in the same way on
    /// every machine.
    fn root(error: f64) -> f64;

    /// Moves the state to the end of the step; its start is kept.
    fn accept(&mut self, state: &mut State<T>);

    /// Makes ready for the next step: its first stage may be known.
    ///
    /// # Errors
    /// Whatever keeps the first stage from being evaluated.
    fn advance(
        &mut self,
        field: &mut F,
        state: &State<T>,
        report: &mut Report,
    ) -> Result<(), IntegratorsError<Self::Error>>;
}

/// An accepted step that can be asked for the state within it.
pub(crate) trait Dense<T, E> {
    fn at(&mut self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError<E>>;
    /// Evaluations made for it.
    fn evaluations(&self) -> u64;
}

/// Ends a run as an observer or an event asks: the state is moved to the time of the end.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn settle<T: Real, E>(
    verdict: Result<ControlFlow<Stop>, IntegratorsError<E>>,
    dense: &mut impl Dense<T, E>,
    state: &mut State<T>,
    report: &mut Report,
) -> Result<ControlFlow<Ending>, IntegratorsError<E>> {
    if let Ok(ControlFlow::Break((Some(time), _))) = verdict {
        dense.at(time, &mut state.values)?;
        state.carry.fill(T::zero());
        state.set_time(time);
    }
    report.evaluations += dense.evaluations();
    Ok(match verdict? {
        ControlFlow::Break((_, ending)) => ControlFlow::Break(ending),
        ControlFlow::Continue(()) => ControlFlow::Continue(()),
    })
}

/// The loop of all runs. `inspect` sees each accepted step and may end the run.
///
/// # Errors
/// As the pair and `inspect`; a step that is too small; too many steps.
pub fn follow<T: Real, F, P: EmbeddedPair<T, F>>(
    pair: &mut P,
    field: &mut F,
    state: &mut State<T>,
    end: f64,
    resumed: Option<&Checkpoint<T>>,
    inspect: &mut impl FnMut(
        &mut P,
        &mut F,
        &mut State<T>,
        AcceptedStep,
        &mut Report,
    ) -> Result<ControlFlow<Ending>, IntegratorsError<P::Error>>,
) -> Result<Report, IntegratorsError<P::Error>> {
    let mut report = resumed.map_or(Report::begin(), |checkpoint| checkpoint.report.continued());
    let mut step = pair.begin(field, state, end, resumed, &mut report)?;
    let span = end - state.time;
    let direction = span.signum();
    if span.abs() <= 0.0 {
        return Ok(report);
    }
    let Limits { longest_step, most_steps, .. } = pair.limits();
    let mut just_rejected = false;
    // Why the last trial could not be made at all, if it could not.
    let mut obstacle = None;
    loop {
        if most_steps <= report.steps {
            return Err(IntegratorsError::TooManySteps { t: state.time, steps: report.steps });
        }
        let remaining = state.remaining(end);
        step = step.min(longest_step);
        // A last step may be longer by one hundredth, rather than leave a tiny one behind.
        let last = remaining.abs() <= (1.01 * step).min(longest_step);
        let h = if last { remaining } else { direction * step };
        let stuck = h.abs() <= 2.0 * f64::EPSILON * state.time.abs();
        if stuck && !last || h.abs() <= 0.0 {
            return Err(obstacle.unwrap_or(IntegratorsError::StepTooSmall { t: state.time, step: h }));
        }

        let error = match pair.attempt(field, state, h, &mut report) {
            Ok(error) => error,
            Err(refusal) => {
                // A stage left the field's domain: a shorter step may stay in it.
                obstacle = Some(refusal);
                f64::INFINITY
            }
        };
        let factor = (SAFETY / P::root(error)).clamp(1.0 / 3.0, 6.0);
        if error.is_nan() || 1.0 < error {
            report.rejected += 1;
            if error.is_finite() {
                obstacle = None;
                step = h.abs() * factor;
            } else {
                step = 0.1 * h.abs();
            }
            just_rejected = true;
            continue;
        }
        obstacle = None;
        step = h.abs() * if just_rejected { factor.min(1.0) } else { factor };
        just_rejected = false;

        let start_time = state.time;
        pair.accept(state);
        if last {
            state.set_time(end);
        } else {
            state.advance_time(h);
        }
        report.steps += 1;
        let progress = RunSoFar { report, time_carry: state.time_carry, start: start_time, next: step, best: step };
        let accepted = AcceptedStep { number: report.steps, start: start_time, end: state.time, length: h, progress };
        if let ControlFlow::Break(ending) = inspect(pair, field, state, accepted, &mut report)? {
            report.ending = ending;
            return Ok(report);
        }
        if last {
            return Ok(report);
        }
        pair.advance(field, state, &mut report)?;
    }
}

/// How a user bounds the steps of a method that has the fields `tolerance` and `limits`.
#[doc(hidden)]
#[macro_export]
macro_rules! limits_of_steps {
    () => {
        /// Sets the first step tried, s; by default it is estimated.
        ///
        /// # Errors
        /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
        pub fn with_first_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
            $crate::internal::check_step(step)?;
            self.limits.first_step = Some(step);
            Ok(self)
        }

        /// Bounds every step, s; by default steps are not bounded.
        ///
        /// # Errors
        /// [`IntegratorsError::InvalidStep`] unless 0 < step; ∞ is no bound.
        pub fn with_longest_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
            self.limits.longest_step = $crate::internal::check_longest(step)?;
            Ok(self)
        }

        /// Bounds the number of steps of one run; by default it is not bounded.
        #[must_use]
        pub const fn with_most_steps(mut self, steps: u64) -> Self {
            self.limits.most_steps = steps;
            self
        }

        /// The tolerance.
        #[must_use]
        pub const fn tolerance(&self) -> Tolerance {
            self.tolerance
        }
    };
}
