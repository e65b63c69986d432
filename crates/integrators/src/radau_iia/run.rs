//! The loop over the steps.

use core::ops::ControlFlow;

use super::control::Controller;
use super::dense::RadauStep;
use super::stages::{Aim, Solved, norm};
use super::tableau::{RadauOrder, Tableau};
use super::{Control, RadauIia, RadauReport};
use crate::events::Stop;
use crate::state::{check_finite, check_run, compensated_add, equal_steps};
use crate::{IntegratorsError, State, StiffField};

/// The tolerance with which runs of a fixed step iterate.
pub(super) const ROUNDING: f64 = 1e-14;
/// Contraction below which the Jacobian is kept for the next step.
const FAST: f64 = 1e-3;
/// Growth of the step that is not worth another factorisation.
const LITTLE_GROWTH: f64 = 1.2;
/// A first step tried where none can be estimated, as part of the span.
const SHORT: f64 = 1e-6;

/// What a step of some order aims at.
fn aim(control: Control, order: RadauOrder) -> Aim {
    let s = order.tableau().stages() as f64;
    let (tolerance, widening, unswept) = match control {
        Control::Fixed(_) => (ROUNDING, 1.0, 1e-2),
        Control::Adaptive(tolerance) => {
            let relative = tolerance.relative_part();
            if relative <= 0.0 {
                // An absolute tolerance has a unit: only a relative one has powers.
                (0.0, 1.0, 1e-2)
            } else {
                // The error of the estimate is of order s + 1, that of the step of order 2s.
                let exponent = (s + 1.0) / (2.0 * s);
                let widening = 0.1 * relative.powf(exponent - 1.0);
                let unswept = (0.3 * relative.powf(1.0 - exponent)).min(0.03);
                (relative, widening, unswept.max(10.0 * f64::EPSILON / (relative * widening)))
            }
        }
    };
    let absolute = match control {
        Control::Fixed(_) => f64::MIN_POSITIVE,
        Control::Adaptive(tolerance) => tolerance.absolute_part() * widening,
    };
    // Seven sweeps of three stages, twelve of five, seventeen of seven.
    let most_sweeps = match order {
        RadauOrder::Five => 7,
        RadauOrder::Nine => 12,
        RadauOrder::Thirteen => 17,
    };
    let most_sweeps = if matches!(control, Control::Fixed(_)) { 50 } else { most_sweeps };
    Aim { absolute, relative: tolerance * widening, unswept, most_sweeps }
}

/// What the factors in memory belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Factored {
    order: RadauOrder,
    h: f64,
}

impl RadauIia {
    /// The loop of all runs. `inspect` sees each accepted step; to end the run it gives the time of the end (the step's own
    /// end when `None`) and how the run ended.
    pub(super) fn run<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        inspect: &mut impl FnMut(&mut RadauStep<'_>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
    ) -> Result<RadauReport, IntegratorsError<F::Error>> {
        let n = field.dimension();
        check_run(n, state, end)?;
        self.work.begin(n, self.highest.tableau().stages(), field.mass());
        let mut report = RadauReport::begin();
        let (origin, span) = (state.time, end - state.time);
        if span.abs() <= 0.0 {
            return Ok(report);
        }
        evaluate(field, state.time, &state.values, &mut self.work.rate)?;
        report.run.evaluations += 1;
        check_finite("rate", Some(state.time), &self.work.rate)?;
        field.magnitudes(&state.values, &mut self.work.magnitudes);

        let equal = match self.control {
            Control::Fixed(longest) => Some(equal_steps(state.time, end, longest)?),
            Control::Adaptive(_) => None,
        };
        let mut controller = Controller::new(self.lowest, self.highest);
        let mut step = match (equal, self.first_step) {
            (Some((_, h)), _) => h.abs(),
            (None, Some(step)) => step,
            (None, None) => self.first_step(field, state, span, &mut report),
        };
        // Whether the Jacobian in memory, if any, belongs to the start of this step, and what its factors belong to.
        let (mut has_jacobian, mut is_current) = (false, false);
        let mut factored: Option<Factored> = None;
        let mut last_step: Option<(&'static Tableau, f64)> = None;
        let mut just_rejected = true;
        // Why the last trial could not be made at all, if it could not.
        let mut obstacle = None;
        loop {
            if self.most_steps <= report.run.steps {
                return Err(IntegratorsError::TooManySteps { t: state.time, steps: report.run.steps });
            }
            let remaining = (end - state.time) - state.time_carry;
            let (h, last) = match equal {
                Some((count, h)) => (h, report.run.steps + 1 == count),
                None => {
                    step = step.min(self.longest_step);
                    // A last step may be longer by one hundredth, rather than leave a tiny one behind.
                    let last = remaining.abs() <= (1.01 * step).min(self.longest_step);
                    (if last { remaining } else { step.copysign(span) }, last)
                }
            };
            let stuck = h.abs() <= 2.0 * f64::EPSILON * state.time.abs();
            if stuck && !last || h.abs() <= f64::MIN_POSITIVE {
                return Err(obstacle.unwrap_or(IntegratorsError::StepTooSmall { t: state.time, step: h }));
            }
            let order = controller.order;
            let (tableau, aim) = (order.tableau(), aim(self.control, order));

            if !has_jacobian {
                field
                    .jacobian(state.time, &state.values, &mut self.work.jacobian)
                    .map_err(|source| IntegratorsError::Field { t: state.time, source })?;
                check_finite("jacobian", Some(state.time), &self.work.jacobian)?;
                report.jacobians += 1;
                (has_jacobian, is_current, factored) = (true, true, None);
            }
            if factored != Some(Factored { order, h }) {
                report.factorisations += 1;
                factored = None;
                if let Err(pivot) = self.work.factor(tableau, h) {
                    let refusal = IntegratorsError::SingularMatrix { t: state.time, step: h, pivot };
                    if equal.is_some() {
                        return Err(refusal);
                    }
                    obstacle = Some(refusal);
                    report.run.rejected += 1;
                    (step, just_rejected) = (0.5 * h.abs(), true);
                    continue;
                }
                factored = Some(Factored { order, h });
            }
            self.work.predict(tableau, h, last_step);
            let solved = self.work.solve(field, tableau, state, h, aim, &mut report.run.evaluations);
            let (sweeps, contraction) = match solved {
                Solved::Converged { sweeps, contraction } => (sweeps, contraction),
                Solved::Diverged { factor, sweeps, change } => {
                    report.run.rejected += 1;
                    if is_current {
                        let iterations = usize::try_from(sweeps).unwrap_or(usize::MAX);
                        let refusal = IntegratorsError::StagesDiverged { t: state.time, step: h, iterations, change };
                        if equal.is_some() {
                            return Err(refusal);
                        }
                        obstacle = Some(refusal);
                        controller.lower();
                        (step, just_rejected) = (factor * h.abs(), true);
                    } else {
                        has_jacobian = false;
                    }
                    continue;
                }
                Solved::Refused(refusal) => {
                    report.run.rejected += 1;
                    if equal.is_some() {
                        return Err(refusal);
                    }
                    obstacle = Some(refusal);
                    (step, just_rejected) = (0.25 * h.abs(), true);
                    continue;
                }
            };
            let mut error = 0.0;
            if equal.is_none() {
                let evaluations = &mut report.run.evaluations;
                error = self.work.estimate(field, tableau, state, h, aim, just_rejected, evaluations);
                if error.is_nan() || 1.0 <= error {
                    report.run.rejected += 1;
                    obstacle = None;
                    let factor = if report.run.steps == 0 || !error.is_finite() {
                        0.1
                    } else {
                        controller.after_rejection(error, sweeps, aim.most_sweeps)
                    };
                    (step, just_rejected) = (factor * h.abs(), true);
                    continue;
                }
            }

            // The rate at the end belongs to the next step; without it there is no step.
            if let Err(refusal) = self.end_of_step(field, tableau, state, h, &mut report) {
                if equal.is_some() {
                    return Err(refusal);
                }
                report.run.rejected += 1;
                obstacle = Some(refusal);
                (step, just_rejected) = (0.25 * h.abs(), true);
                continue;
            }
            obstacle = None;
            let start = state.time;
            self.accept(field, state);
            match equal {
                Some((_, h)) if !last => state.set_time(origin + h * (report.run.steps + 1) as f64),
                None if !last => state.advance_time(h),
                _ => state.set_time(end),
            }
            report.run.steps += 1;
            last_step = Some((tableau, h));

            let mut seen = RadauStep::new(&self.work, order, report.run.steps, [start, state.time], h);
            match inspect(&mut seen)? {
                ControlFlow::Break((time, ending)) => {
                    report.run.ending = ending;
                    if let Some(time) = time {
                        seen.at(time, &mut state.values).map_err(IntegratorsError::with_field_error)?;
                        state.carry.fill(0.0);
                        state.set_time(time);
                    }
                    return Ok(report);
                }
                ControlFlow::Continue(()) if last => return Ok(report),
                ControlFlow::Continue(()) => {}
            }

            let fast = contraction.is_none_or(|contraction| contraction < FAST);
            is_current = false;
            if !fast {
                has_jacobian = false;
            }
            if equal.is_none() {
                let mut factor = controller.after_step(h.abs(), error, sweeps, aim.most_sweeps);
                if just_rejected && 1 < report.run.steps {
                    factor = factor.min(1.0);
                }
                controller.choose_order(contraction);
                if fast && controller.order == order && 1.0 <= factor && factor <= LITTLE_GROWTH {
                    factor = 1.0;
                }
                step = factor * h.abs();
            }
            just_rejected = false;
        }
    }

    /// Computes the state at the end of the step and its rate.
    fn end_of_step<F: StiffField>(
        &mut self,
        field: &mut F,
        tableau: &Tableau,
        state: &State,
        h: f64,
        report: &mut RadauReport,
    ) -> Result<(), IntegratorsError<F::Error>> {
        let work = &mut self.work;
        let n = state.values.len();
        let increments = &work.stages[(tableau.stages() - 1) * n..][..n];
        work.trial.copy_from_slice(&state.values);
        work.trial_carry.copy_from_slice(&state.carry);
        for ((y, carry), &increment) in work.trial.iter_mut().zip(&mut work.trial_carry).zip(increments) {
            compensated_add(y, carry, increment);
        }
        check_finite("state", Some(state.time), &work.trial)?;
        report.run.evaluations += 1;
        evaluate(field, state.time + h, &work.trial, &mut work.rate_at_end)?;
        check_finite("rate", Some(state.time), &work.rate_at_end)
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

    /// The length of a first step whose error should be within the tolerance: h = (1/‖y‖)^(1/(s+1)) / λ, λ² = ‖ÿ‖/‖y‖.
    fn first_step<F: StiffField>(&mut self, field: &mut F, state: &State, span: f64, report: &mut RadauReport) -> f64 {
        let longest = span.abs().min(self.longest_step);
        let shortest = SHORT * longest;
        if field.mass().is_some() {
            return shortest;
        }
        let aim = aim(self.control, self.lowest);
        let work = &mut self.work;
        for (weight, magnitude) in work.weights.iter_mut().zip(&work.magnitudes) {
            *weight = aim.absolute + aim.relative * magnitude;
            // Components of magnitude zero have no say.
            if *weight <= 0.0 {
                *weight = f64::INFINITY;
            }
        }
        let (size, rate) = (norm(&state.values, &work.weights), norm(&work.rate, &work.weights));
        let changing = 0.0 < rate && 0.0 < size;
        let euler = if changing { (1e-3 * size / rate).min(longest) } else { shortest };
        for ((trial, y), rate) in work.trial.iter_mut().zip(&state.values).zip(&work.rate) {
            *trial = y + euler.copysign(span) * rate;
        }
        report.run.evaluations += 1;
        let evaluated = evaluate(field, state.time + euler.copysign(span), &work.trial, &mut work.rate_at_end);
        if evaluated.is_err() {
            return shortest;
        }
        for (after, before) in work.rate_at_end.iter_mut().zip(&work.rate) {
            *after -= before;
        }
        let lambda = (norm(&work.rate_at_end, &work.weights) / euler / size).sqrt();
        let step = size.powf(-1.0 / (self.lowest.tableau().stages() as f64 + 1.0)) / lambda;
        let resolved = 1e3 * f64::EPSILON * state.time.abs();
        if 0.0 < step && step.is_finite() { step.min(0.1 * longest).max(resolved).min(longest) } else { shortest }
    }
}

fn evaluate<F: StiffField>(
    field: &mut F,
    t: f64,
    y: &[f64],
    rate: &mut [f64],
) -> Result<(), IntegratorsError<F::Error>> {
    field.rate(t, y, rate).map_err(|source| IntegratorsError::Field { t, source })
}
