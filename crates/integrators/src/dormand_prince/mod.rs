//! Dormand–Prince 8(5,3): an adaptive explicit Runge–Kutta method of order eight with dense output of order
//! seven and events.
//!
//! The step is chosen so that the local error, estimated by two embedded formulas of orders five and three,
//! stays below the [`Tolerance`]. Dense output costs three more evaluations, made only for the steps where it
//! is asked for, and never extrapolates.
//!
//! # When?
//! For smooth fields that are not stiff, at tolerances from 1e-6 to rounding: close encounters, driven and
//! damped systems, trajectories at prescribed times. For millions of revolutions prefer a symplectic method.
//!
//! # References
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.4–II.6, II.10.

#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
pub(crate) mod coefficients;
mod dense;
mod first_step;
mod stages;
mod with_events;

use core::ops::ControlFlow;

use piola_numerics::Real;

pub use dense::DenseStep;

use crate::accepted::AcceptedStep;
use crate::events::{Stop, stopped_by};
use crate::state::{check_finite, check_longest, check_run};
use crate::{Field, IntegratorsError, Report, State, Tolerance};

/// The adaptive method of order 8(5,3).
///
/// # Accuracy
/// The local error of each step is below the tolerance; the global error is proportional to it, by a factor
/// that the problem's sensitivity sets. The state and the time are summed with compensation.
///
/// # Example
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance, field};
/// let mut oscillator = field(2, |_t, y: &[f64], rate: &mut [f64]| {
///     rate[0] = y[1];
///     rate[1] = -y[0];
/// });
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// let mut method = DormandPrince853::new(Tolerance::relative(1e-13)?);
/// let mut largest = 0.0_f64;
/// method.integrate(&mut oscillator, &mut state, 10.0, |step| {
///     // Dense output in the middle of each step.
///     let middle = 0.5 * (step.start() + step.time());
///     let mut y = [0.0; 2];
///     if step.at(middle, &mut y).is_ok() {
///         largest = largest.max((y[0] - middle.cos()).abs());
///     }
///     std::ops::ControlFlow::Continue(())
/// })?;
/// assert!((state.values[0] - 10.0_f64.cos()).abs() < 1e-12);
/// assert!(largest < 1e-11);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("DOP853", "Runge-Kutta"))]
#[derive(Clone, Debug)]
pub struct DormandPrince853<T = f64> {
    tolerance: Tolerance,
    first_step: Option<f64>,
    longest_step: f64,
    most_steps: u64,
    /// k₁ … k₁₆; stage 12 is the rate at the end of the step.
    stages: [Vec<T>; 16],
    /// The stage's argument, then the step's end.
    trial: Vec<T>,
    trial_carry: Vec<T>,
    start: Vec<T>,
    start_carry: Vec<T>,
    magnitudes: Vec<f64>,
    magnitudes_at_end: Vec<f64>,
    /// The coefficients of the interpolating polynomial; see `dense`.
    interpolant: [Vec<T>; 7],
}

impl<T: Real> DormandPrince853<T> {
    /// A method with the given tolerance.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            first_step: None,
            longest_step: f64::INFINITY,
            most_steps: u64::MAX,
            stages: core::array::from_fn(|_| Vec::new()),
            trial: Vec::new(),
            trial_carry: Vec::new(),
            start: Vec::new(),
            start_carry: Vec::new(),
            magnitudes: Vec::new(),
            magnitudes_at_end: Vec::new(),
            interpolant: core::array::from_fn(|_| Vec::new()),
        }
    }

    /// Sets the first step tried, s; by default it is estimated.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn with_first_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        crate::state::check_step(step)?;
        self.first_step = Some(step);
        Ok(self)
    }

    /// Bounds every step, s; by default steps are not bounded.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step; ∞ is no bound.
    pub fn with_longest_step(mut self, step: f64) -> Result<Self, IntegratorsError> {
        self.longest_step = check_longest(step)?;
        Ok(self)
    }

    /// Bounds the number of steps of one run; by default it is not bounded.
    #[must_use]
    pub const fn with_most_steps(mut self, steps: u64) -> Self {
        self.most_steps = steps;
        self
    }

    /// The tolerance.
    #[must_use]
    pub const fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    pub(crate) const fn tolerance_mut(&mut self) -> &mut Tolerance {
        &mut self.tolerance
    }

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate(field, state, end, |_| ControlFlow::Continue(()))
    }

    /// Integrates to `end`, backwards if it is earlier than the state's time. The observer sees every step,
    /// may ask for the state at any time within it, and may stop the run.
    ///
    /// # Errors
    /// The state does not fit or is not finite; the field fails or its rate is not finite at the start or, however
    /// small the step, beyond a time; the step no longer advances the time; or the limit on steps is reached.
    /// The state then stands at the last accepted step.
    pub fn integrate<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(&mut DenseStep<'_, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run(field, state, end, &mut |step| Ok(stopped_by(observer(step))))
    }

    fn prepare(&mut self, n: usize) {
        for buffer in self.stages.iter_mut().chain(&mut self.interpolant) {
            buffer.resize(n, T::zero());
        }
        for buffer in [&mut self.trial, &mut self.trial_carry, &mut self.start, &mut self.start_carry] {
            buffer.resize(n, T::zero());
        }
        self.magnitudes.resize(n, 0.0);
        self.magnitudes_at_end.resize(n, 0.0);
    }

    /// The loop of all runs. `inspect` sees each accepted step; to end the run it gives the time of the end
    /// (the step's own end when `None`) and how the run ended.
    fn run<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        inspect: &mut impl FnMut(&mut DenseStep<'_, T, F>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        check_run(field.dimension(), state, end)?;
        self.prepare(state.values.len());
        let mut report = Report::begin();
        let span = end - state.time;
        if span.abs() <= 0.0 {
            return Ok(report);
        }
        let direction = span.signum();

        evaluate(field, state.time, &state.values, &mut self.stages[0])?;
        report.evaluations += 1;
        check_finite("rate", Some(state.time), &self.stages[0])?;
        field.magnitudes(&state.values, &mut self.magnitudes);
        let mut step = match self.first_step {
            Some(step) => step,
            None => self.estimate_first_step(field, state, span, &mut report),
        };
        let mut just_rejected = false;
        // Why the last trial could not be made at all, if it could not.
        let mut obstacle = None;
        loop {
            if self.most_steps <= report.steps {
                return Err(IntegratorsError::TooManySteps { t: state.time, steps: report.steps });
            }
            let remaining = (end - state.time) - state.time_carry;
            step = step.min(self.longest_step);
            // A last step may be longer by one hundredth, rather than leave a tiny one behind.
            let last = remaining.abs() <= (1.01 * step).min(self.longest_step);
            let h = if last { remaining } else { direction * step };
            let stuck = h.abs() <= 2.0 * f64::EPSILON * state.time.abs();
            if stuck && !last || h.abs() <= 0.0 {
                return Err(obstacle.unwrap_or(IntegratorsError::StepTooSmall { t: state.time, step: h }));
            }

            let error = match self.try_step(field, state, h, &mut report) {
                Ok(error) => error,
                Err(refusal) => {
                    // A stage left the field's domain: a shorter step may stay in it.
                    obstacle = Some(refusal);
                    f64::INFINITY
                }
            };
            let factor = step_factor(error);
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
            core::mem::swap(&mut self.start, &mut state.values);
            core::mem::swap(&mut self.start_carry, &mut state.carry);
            state.values.copy_from_slice(&self.trial);
            state.carry.copy_from_slice(&self.trial_carry);
            if last {
                state.set_time(end);
            } else {
                state.advance_time(h);
            }
            report.steps += 1;

            let step = AcceptedStep { number: report.steps, start: start_time, end: state.time, length: h };
            let mut dense = DenseStep::new(self, field, step);
            let verdict = inspect(&mut dense);
            if let Ok(ControlFlow::Break((Some(time), _))) = verdict {
                dense.at(time, &mut state.values)?;
                state.carry.fill(T::zero());
                state.set_time(time);
            }
            report.evaluations += dense.evaluations();
            if let ControlFlow::Break((_, ending)) = verdict? {
                report.ending = ending;
                return Ok(report);
            }
            if last {
                return Ok(report);
            }
            // The rate at the end is the first stage of the next step.
            let (first, rest) = self.stages.split_at_mut(1);
            core::mem::swap(&mut first[0], &mut rest[11]);
            core::mem::swap(&mut self.magnitudes, &mut self.magnitudes_at_end);
        }
    }
}

/// The part of the largest step allowed that is taken.
///
/// At the usual 0.9 every fourth step of a double pendulum or an eccentric orbit is rejected. At 0.7 few are,
/// and for the same error at the end 23 % fewer evaluations are made (mean over double pendulum, e = 0.7 and
/// e = 0.99, tolerances from 1e-7 to 1e-13).
const SAFETY: f64 = 0.7;

/// The new step over the old, from the error over the tolerance: SAFETY / error^(1/8), between 1/3 and 6.
///
/// Square roots are rounded in the same way on every machine; powers are not.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn step_factor(error: f64) -> f64 {
    (SAFETY / error.sqrt().sqrt().sqrt()).clamp(1.0 / 3.0, 6.0)
}

/// The error of a step of n components over the tolerance, from the squares of its two estimates: that of order five, damped by
/// that of order three.
///
/// ```text
/// e = |h| ‖e₅‖² / √(n (‖e₅‖² + 0.01 ‖e₃‖²)),    ‖x‖² = Σᵢ (xᵢ/allowedᵢ)²
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn error_of_pair(fifth: f64, third: f64, n: usize, h: f64) -> f64 {
    let denominator = fifth + 0.01 * third;
    if denominator <= 0.0 {
        return 0.0;
    }
    if denominator.is_infinite() {
        return f64::INFINITY;
    }
    h.abs() * fifth / (denominator * n as f64).sqrt()
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn evaluate<T: Real, F: Field<T>>(
    field: &mut F,
    time: f64,
    y: &[T],
    rate: &mut [T],
) -> Result<(), IntegratorsError<F::Error>> {
    field.rate(time, y, rate).map_err(|source| IntegratorsError::Field { t: time, source })
}
