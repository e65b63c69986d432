//! The loop over the steps.

use core::ops::ControlFlow;

use piola_integrators::internal::{AcceptedStep, Stop, carry_of_time, check_finite, check_run, equal_steps};
use piola_integrators::{IntegratorsError, State};

use super::attempt::{Jacobian, LITTLE_GROWTH, Progress};
use super::checkpoint::RadauCheckpoint;
use super::control::{Attempt, Controller};
use super::dense::{RadauIiaStep, SoFar};
use super::{Control, RadauIia, RadauReport};
use crate::StiffField;

/// The highest differentiation index of a component that can be integrated.
const HIGHEST_INDEX: u32 = 2;

/// Contraction below which the Jacobian is kept for the next step.
const FAST: f64 = 1e-3;

impl RadauIia {
    /// The loop of all runs. `inspect` sees each accepted step; to end the run it gives the time of the end (the step's own
    /// end when `None`) and how the run ended.
    pub(super) fn run<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        resumed: Option<&RadauCheckpoint>,
        inspect: &mut impl FnMut(&mut RadauIiaStep<'_>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
    ) -> Result<RadauReport, IntegratorsError<F::Error>> {
        let n = field.dimension();
        if let Some(checkpoint) = resumed {
            state.clone_from(checkpoint.state());
        }
        check_run(n, state, end)?;
        let [lowest, highest] = self.orders.unwrap_or_else(|| self.control.orders());
        if let Some((component, index)) = (0..n).map(|k| (k, field.index(k))).find(|&(_, index)| HIGHEST_INDEX < index)
        {
            return Err(IntegratorsError::IndexTooHigh { component, index, t: state.time });
        }
        self.work.begin(n, highest.tableau().stages(), field)?;
        let mut report = resumed.map_or(RadauReport::begin(), RadauCheckpoint::report);
        let origin = resumed.map_or(state.time, RadauCheckpoint::origin);
        let span = end - state.time;
        if span.abs() <= 0.0 {
            return Ok(report);
        }
        let equal = match self.control {
            Control::Fixed(longest) => Some(equal_steps(origin, end, longest)?),
            Control::Adaptive(_) => None,
        };
        if let (Some(_), Some((count, h))) = (resumed, equal) {
            let begun = report.run.steps;
            if count <= begun || (origin + h * begun as f64).to_bits() != state.time.to_bits() {
                return Err(IntegratorsError::InvalidStep { step: h });
            }
        }
        let mut progress = if let Some(checkpoint) = resumed {
            let mut memory = checkpoint.open(&mut self.work)?;
            // Factors are made again, not counted again.
            memory.factored = memory
                .factored
                .filter(|&(order, h)| order <= highest && self.work.matrices.factor(order.tableau(), h).is_ok());
            field.magnitudes(&state.values, &mut self.work.magnitudes);
            Progress::resumed(memory, [lowest, highest], equal.is_some())
        } else {
            field
                .rate(origin, &state.values, &mut self.work.rate)
                .map_err(|source| IntegratorsError::Field { t: origin, source })?;
            report.run.evaluations += 1;
            check_finite("rate", Some(origin), &self.work.rate)?;
            field.magnitudes(&state.values, &mut self.work.magnitudes);
            let step = match (equal, self.first_step) {
                (Some((_, h)), _) => h.abs(),
                (None, Some(step)) => step,
                (None, None) => self.first_step(field, state, span, lowest, &mut report),
            };
            Progress::new(Controller::new(lowest, highest), step, equal.is_some())
        };
        loop {
            if self.most_steps <= report.run.steps {
                return Err(IntegratorsError::TooManySteps { t: state.time, steps: report.run.steps });
            }
            let (h, last) = if let Some((count, h)) = equal {
                (h, report.run.steps + 1 == count)
            } else {
                let remaining = state.remaining(end);
                progress.step = progress.step.min(self.longest_step);
                // A last step may be longer by one hundredth, rather than leave a tiny one behind.
                let last = remaining.abs() <= (1.01 * progress.step).min(self.longest_step);
                (if last { remaining } else { progress.step.copysign(span) }, last)
            };
            let stuck = h.abs() <= 2.0 * f64::EPSILON * state.time.abs();
            if stuck && !last || h.abs() <= f64::MIN_POSITIVE {
                let too_small = IntegratorsError::StepTooSmall { t: state.time, step: h };
                let obstacle = progress.obstacle.unwrap_or(too_small);
                return Err(self.index_above_two(field, state, span).unwrap_or(obstacle));
            }
            let order = progress.controller.order;
            let Some(attempt) = self.attempt(field, state, h, &mut progress, &mut report)? else {
                report.run.rejected += 1;
                continue;
            };

            let start = state.time;
            self.accept(field, state);
            report.run.steps += 1;
            match equal {
                Some((_, h)) if !last => state.set_time(origin + h * report.run.steps as f64),
                None if !last => state.advance_time(h),
                _ => state.set_time(end),
            }
            let step = AcceptedStep::new(report.run.steps, start, state.time, h);
            progress.accept(attempt, h, report.run.steps == 1);
            let so_far =
                SoFar { report, origin, time_carry: carry_of_time(state), memory: progress.memory(self.work.rest) };
            let mut seen = RadauIiaStep::new(&self.work, order, step, so_far);
            if let ControlFlow::Break((time, ending)) = inspect(&mut seen)? {
                report.run.ending = ending;
                if let Some(time) = time {
                    seen.at(time, &mut state.values).map_err(IntegratorsError::with_field_error)?;
                    state.carry.fill(0.0);
                    state.set_time(time);
                }
                return Ok(report);
            }
            if last {
                return Ok(report);
            }
        }
    }

    /// Moves the state to the end of the step.
    fn accept<F: StiffField>(&mut self, field: &F, state: &mut State) {
        let work = &mut self.work;
        core::mem::swap(&mut work.start, &mut state.values);
        core::mem::swap(&mut work.start_carry, &mut state.carry);
        state.values.copy_from_slice(&work.trial);
        state.carry.copy_from_slice(&work.trial_carry);
        core::mem::swap(&mut work.stages, &mut work.accepted);
        core::mem::swap(&mut work.rate, &mut work.rate_at_end);
        field.magnitudes(&state.values, &mut work.magnitudes);
    }
}

impl<E> Progress<E> {
    /// Chooses length and order of the step after an accepted one, and whether its Jacobian serves again.
    fn accept(&mut self, attempt: Attempt, h: f64, is_first: bool) {
        let order = self.controller.order;
        self.obstacle = None;
        self.last = Some((order, h));
        let is_fast = attempt.contraction.is_none_or(|contraction| contraction < FAST);
        self.jacobian = if is_fast { Jacobian::Kept } else { Jacobian::None };
        if !self.is_fixed {
            let mut factor = self.controller.after_step(h.abs(), attempt);
            if self.just_rejected && !is_first {
                factor = factor.min(1.0);
            }
            self.controller.choose_order(attempt.contraction);
            if is_fast && self.controller.order == order && 1.0 <= factor && factor <= LITTLE_GROWTH {
                factor = 1.0;
            }
            self.step = factor * h.abs();
        }
        self.just_rejected = false;
    }
}
