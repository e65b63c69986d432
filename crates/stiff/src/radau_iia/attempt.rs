//! One attempt at a step: Jacobian, factors, stages, error, rate at the end.

use piola_integrators::internal::{check_finite, compensated_add};
use piola_integrators::{IntegratorsError, State};

use super::aim::Aim;
use super::checkpoint::Memory;
use super::control::{Attempt, Controller};
use super::order::RadauOrder;
use super::stages::Solved;
use super::tableau::Tableau;
use super::{RadauIia, RadauReport};
use crate::StiffField;

/// Growth of the step that is not worth another factorisation, and after which Newton's iteration contracts as before.
pub(super) const LITTLE_GROWTH: f64 = 1.2;
/// Singular matrices of one step after which it is given up.
const MOST_SINGULAR: u32 = 6;
/// The part of a step that is tried after one within which the field is not defined.
const UNDEFINED: f64 = 0.25;

/// Which Jacobian is in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Jacobian {
    /// None that may be used.
    None,
    /// That of a step before.
    Kept,
    /// That of the start of this step.
    Current,
}

/// What a run remembers from one attempt to the next.
#[derive(Debug)]
pub(super) struct Progress<E> {
    pub(super) controller: Controller,
    /// The length of the next step to be tried, s.
    pub(super) step: f64,
    /// Whether the first failure ends the run.
    pub(super) is_fixed: bool,
    pub(super) jacobian: Jacobian,
    /// Order and step of the factors in memory.
    pub(super) factored: Option<(RadauOrder, f64)>,
    singular: u32,
    /// The last accepted step.
    pub(super) last: Option<(RadauOrder, f64)>,
    /// Whether the last attempt failed, or there was none.
    pub(super) just_rejected: bool,
    /// Why the last trial could not be made at all, if it could not.
    pub(super) obstacle: Option<IntegratorsError<E>>,
}

impl<E> Progress<E> {
    pub(super) const fn new(controller: Controller, step: f64, is_fixed: bool) -> Self {
        Self {
            controller,
            step,
            is_fixed,
            jacobian: Jacobian::None,
            factored: None,
            singular: 0,
            last: None,
            just_rejected: true,
            obstacle: None,
        }
    }

    /// The same, as it was after an accepted step.
    pub(super) fn resumed(memory: Memory, [lowest, highest]: [RadauOrder; 2], is_fixed: bool) -> Self {
        Self {
            jacobian: if memory.is_jacobian_kept { Jacobian::Kept } else { Jacobian::None },
            factored: memory.factored,
            last: memory.last,
            just_rejected: false,
            ..Self::new(memory.controller.within(lowest, highest), memory.step, is_fixed)
        }
    }

    /// What is remembered after an accepted step.
    pub(super) fn memory(&self, rest: f64) -> Memory {
        let is_jacobian_kept = self.jacobian == Jacobian::Kept;
        Memory {
            controller: self.controller,
            step: self.step,
            last: self.last,
            factored: self.factored.filter(|_| is_jacobian_kept),
            is_jacobian_kept,
            rest,
        }
    }

    /// A step that could not be made: with a fixed step the end of the run, else a part of it is tried.
    fn refuse(&mut self, refusal: IntegratorsError<E>, step: f64) -> Result<(), IntegratorsError<E>> {
        if self.is_fixed {
            return Err(refusal);
        }
        self.obstacle = Some(refusal);
        (self.step, self.just_rejected) = (step, true);
        Ok(())
    }
}

impl RadauIia {
    /// Tries a step of length h; none where another one is to be tried.
    pub(super) fn attempt<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &State,
        h: f64,
        progress: &mut Progress<F::Error>,
        report: &mut RadauReport,
    ) -> Result<Option<Attempt>, IntegratorsError<F::Error>> {
        let order = progress.controller.order;
        let tableau = order.tableau();
        let is_familiar =
            progress.last.is_some_and(|(before, last)| before == order && h.abs() <= LITTLE_GROWTH * last.abs());
        let aim = Aim { is_familiar, ..Aim::of(self.control, order) };
        if !self.linearise(field, state, h, progress, report)? {
            return Ok(None);
        }
        self.work.predict(tableau, h, progress.last.map(|(order, step)| (order.tableau(), step)));
        let evaluations = &mut report.run.evaluations;
        let mut solved = self.work.solve(field, tableau, state, h, aim, evaluations);
        if progress.is_fixed && progress.jacobian == Jacobian::Current && !matches!(solved, Solved::Converged { .. }) {
            // A polynomial through a fast decay leads far away; no shorter step will be tried.
            self.work.predict(tableau, h, None);
            solved = self.work.solve(field, tableau, state, h, Aim { is_familiar: false, ..aim }, evaluations);
        }
        let (sweeps, contraction) = match solved {
            Solved::Converged { sweeps, contraction } => (sweeps, contraction),
            Solved::Diverged { .. } if progress.jacobian == Jacobian::Kept => {
                progress.jacobian = Jacobian::None;
                return Ok(None);
            }
            Solved::Diverged { factor, sweeps, change } => {
                let iterations = usize::try_from(sweeps).unwrap_or(usize::MAX);
                let refusal = IntegratorsError::StagesDiverged { t: state.time, step: h, iterations, change };
                progress.controller.lower();
                progress.refuse(refusal, factor * h.abs())?;
                return Ok(None);
            }
            Solved::Refused(refusal) => {
                progress.refuse(refusal, UNDEFINED * h.abs())?;
                return Ok(None);
            }
        };
        let mut attempt = Attempt { sweeps, most_sweeps: aim.most_sweeps, contraction, error: 0.0 };
        if !progress.is_fixed {
            let again = Some(&mut report.run.evaluations).filter(|_| progress.just_rejected);
            attempt.error = self.work.estimate(field, tableau, state, h, aim, again);
            if attempt.error.is_nan() || 1.0 <= attempt.error {
                progress.obstacle = None;
                let is_first = report.run.steps == 0 || !attempt.error.is_finite();
                let factor = if is_first { 0.1 } else { progress.controller.after_rejection(attempt) };
                (progress.step, progress.just_rejected) = (factor * h.abs(), true);
                return Ok(None);
            }
        }
        // The rate at the end belongs to the next step; without it there is no step.
        if let Err(refusal) = self.end_of_step(field, tableau, state, h, report) {
            progress.refuse(refusal, UNDEFINED * h.abs())?;
            return Ok(None);
        }
        Ok(Some(attempt))
    }

    /// Evaluates the Jacobian and factors the matrices where those in memory do not serve; whether they are regular.
    fn linearise<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &State,
        h: f64,
        progress: &mut Progress<F::Error>,
        report: &mut RadauReport,
    ) -> Result<bool, IntegratorsError<F::Error>> {
        let order = progress.controller.order;
        if progress.jacobian == Jacobian::None {
            field
                .jacobian(state.time, &state.values, self.work.matrices.jacobian())
                .map_err(|source| IntegratorsError::Field { t: state.time, source })?;
            check_finite("jacobian", Some(state.time), self.work.matrices.jacobian())?;
            report.jacobians += 1;
            (progress.jacobian, progress.factored) = (Jacobian::Current, None);
        }
        if progress.factored.is_some_and(|(factored, step)| factored == order && step.to_bits() == h.to_bits()) {
            return Ok(true);
        }
        report.factorisations += 1;
        progress.factored = None;
        if let Err(pivot) = self.work.matrices.factor(order.tableau(), h) {
            let refusal = IntegratorsError::SingularMatrix { t: state.time, step: h, pivot };
            progress.singular += 1;
            if MOST_SINGULAR <= progress.singular {
                return Err(refusal);
            }
            progress.refuse(refusal, 0.5 * h.abs())?;
            return Ok(false);
        }
        (progress.factored, progress.singular) = (Some((order, h)), 0);
        Ok(true)
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
        let t = state.time + h;
        field.rate(t, &work.trial, &mut work.rate_at_end).map_err(|source| IntegratorsError::Field { t, source })?;
        check_finite("rate", Some(state.time), &work.rate_at_end)
    }
}
