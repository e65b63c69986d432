//! Explicit Runge–Kutta pairs: any smooth field ẏ = f(t, y), with adaptive steps, dense output and events.

use core::cell::RefCell;
use core::marker::PhantomData;
use core::ops::ControlFlow;

use piola_numerics::Real;

use super::pair::{Rows, RungeKutta, RungeKuttaPair, evaluate};
use super::{DenseStep, EmbeddedPair, Guess, Limits, combine, row, row_mut, weighted_sums};
use crate::checkpoint::{Checkpoint, RunSoFar};
use crate::events::{Stop, stopped_by};
use crate::explicit::{follow, settle};
use crate::field::{check_field, largest_lane};
use crate::limits_of_steps;
use crate::state::{check_finite, check_run, compensated_add};
use crate::{Field, IntegratorsError, Report, State, Tolerance};

impl<P: RungeKuttaPair, T: Real> RungeKutta<P, T> {
    /// A method with the given tolerance, raised above rounding.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance: tolerance.above_rounding::<T>(),
            limits: Limits::none(),
            memory: Vec::new(),
            components: 0,
            magnitudes: Vec::new(),
            magnitudes_at_end: Vec::new(),
            pair: PhantomData,
        }
    }

    limits_of_steps!();

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
        observer: impl FnMut(&mut DenseStep<'_, P, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate_from(field, None, state, end, observer)
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method and
    /// [`IntegratorsError::WrongLength`] for one of another system. The state is then left alone.
    pub fn resume<F: Field<T>>(
        &mut self,
        field: &mut F,
        checkpoint: &Checkpoint<T>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(&mut DenseStep<'_, P, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.integrate_from(field, Some(checkpoint), state, end, observer)
    }

    /// [`integrate`](Self::integrate) without a checkpoint, [`resume`](Self::resume) with one: compiled once for both.
    ///
    /// # Errors
    /// As these.
    #[doc(hidden)]
    pub fn integrate_from<F: Field<T>>(
        &mut self,
        field: &mut F,
        checkpoint: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(&mut DenseStep<'_, P, T, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        self.run(field, state, end, checkpoint, &mut |step| Ok(stopped_by(observer(step))))
    }

    /// Runs to `end`. `inspect` sees each accepted step; to end the run it gives the time of the end (the step's own end
    /// when `None`) and how the run ended.
    pub(crate) fn run<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        resumed: Option<&Checkpoint<T>>,
        inspect: &mut impl FnMut(&mut DenseStep<'_, P, T, F>) -> Result<ControlFlow<Stop>, IntegratorsError<F::Error>>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        follow(self, field, state, end, resumed, &mut |method, field, state, step, report| {
            let mut dense = DenseStep::new(method, field, step);
            let verdict = inspect(&mut dense);
            settle(verdict, &mut dense, state, report)
        })
    }
}

impl<P: RungeKuttaPair, T: Real, F: Field<T>> EmbeddedPair<T, F> for RungeKutta<P, T> {
    type Error = F::Error;

    fn limits(&self) -> Limits {
        self.limits
    }

    fn begin(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        resumed: Option<&Checkpoint<T>>,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<F::Error>> {
        check_field::<T, F>(field)?;
        let n = field.dimension();
        match resumed {
            None => check_run(n, state, end)?,
            Some(checkpoint) => {
                checkpoint.open(P::NAME, [n, n + 1], &[0], state, |state| check_run(n, state, end))?;
            }
        }
        self.components = n;
        self.memory.resize(Self::count() * n, T::zero());
        self.magnitudes.resize(n, 0.0);
        self.magnitudes_at_end.resize(n, 0.0);
        let span = end - state.time;
        if span.abs() <= 0.0 {
            return Ok(0.0);
        }
        let (stages, rest) = self.memory.split_at_mut(P::STAGES * n);
        let (rate, others) = stages.split_at_mut(n);
        if let Some(Checkpoint { memory, numbers, .. }) = resumed {
            rate.copy_from_slice(memory);
            self.magnitudes.copy_from_slice(&numbers[1..]);
            return Ok(numbers[0]);
        }
        evaluate(field, state.time, &state.values, rate)?;
        report.evaluations += 1;
        check_finite("rate", Some(state.time), rate)?;
        field.magnitudes(&state.values, &mut self.magnitudes);
        if let Some(step) = self.limits.first_step {
            return Ok(step);
        }
        let guess = Guess {
            tolerance: self.tolerance,
            longest_step: self.limits.longest_step,
            rate,
            trial: &mut rest[..n],
            trial_rate: &mut others[..n],
            magnitudes: &self.magnitudes,
            magnitudes_at_trial: &mut self.magnitudes_at_end,
        };
        let field = RefCell::new(field);
        Ok(guess.first_step(
            state,
            span,
            report,
            P::root,
            |t, y, rate| evaluate(&mut **field.borrow_mut(), t, y, rate),
            |y, magnitudes| field.borrow().magnitudes(y, magnitudes),
        ))
    }

    fn attempt(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<F::Error>> {
        let t = state.time;
        let n = F::DIMENSION.unwrap_or(self.components);
        let (k, rest) = self.memory[..Self::count() * n].split_at_mut(P::STAGES * n);
        let trial = &mut rest[..n];
        let y = (&state.values[..n], &state.carry[..n]);
        // A loop, not a line for each stage: the field is then compiled once.
        for (number, weights) in P::ROWS.iter().copied() {
            combine(weights, k, y, h, trial);
            report.evaluations += 1;
            evaluate(field, t + P::NODES[number] * h, trial, row_mut(k, number, n))?;
        }
        // The argument of the last stage tells of stability.
        let (ends, interpolant) = rest.split_at_mut(Rows::INTERPOLANT * n);
        row_mut(interpolant, Rows::LAST_ARGUMENT, n).copy_from_slice(&ends[..n]);
        let error = self.finish(field, state, h);
        let (k, rest) = self.memory[..Self::count() * n].split_at_mut(P::STAGES * n);
        let trial = &mut rest[..n];
        if error <= 1.0 {
            field.project(t + h, trial).map_err(|source| IntegratorsError::Field { t: t + h, source })?;
            report.evaluations += 1;
            let rate = row_mut(k, P::END, n);
            evaluate(field, t + h, trial, rate)?;
            check_finite("rate", Some(t), rate)?;
            report.stiff_steps += u64::from(self.is_nearly_unstable(h));
        } else if error.is_nan() {
            for &(number, _) in P::ROWS {
                check_finite("rate", Some(t), row(k, number, n))?;
            }
        }
        Ok(error)
    }

    fn root(error: f64) -> f64 {
        P::root(error)
    }

    fn accept(&mut self, state: &mut State<T>) {
        let n = F::DIMENSION.unwrap_or(self.components);
        let rows = &mut self.memory[P::STAGES * n..Self::count() * n];
        let (trial, start) = rows.split_at_mut(Rows::START * n);
        let (values, carry) = (&mut state.values[..n], &mut state.carry[..n]);
        start[..n].copy_from_slice(values);
        start[n..2 * n].copy_from_slice(carry);
        values.copy_from_slice(&trial[..n]);
        carry.copy_from_slice(&trial[n..2 * n]);
    }

    fn advance(
        &mut self,
        _field: &mut F,
        _state: &State<T>,
        _report: &mut Report,
    ) -> Result<(), IntegratorsError<F::Error>> {
        // The rate at the end is the first stage of the next step.
        let n = F::DIMENSION.unwrap_or(self.components);
        let (first, rest) = self.memory[..P::STAGES * n].split_at_mut(n);
        first.copy_from_slice(row(rest, P::END - 1, n));
        core::mem::swap(&mut self.magnitudes, &mut self.magnitudes_at_end);
        Ok(())
    }
}

impl<P: RungeKuttaPair, T: Real> RungeKutta<P, T> {
    /// The last stage of a step.
    const LAST: usize = P::ROWS[P::ROWS.len() - 1].0;

    /// Rows of the memory.
    const fn count() -> usize {
        P::STAGES + Rows::INTERPOLANT + P::INTERPOLANT
    }

    /// The run at the end of the step that was accepted.
    pub(super) fn checkpoint(&self, time: f64, progress: &RunSoFar) -> Checkpoint<T> {
        let (n, RunSoFar { report, time_carry, next, .. }) = (self.components, *progress);
        let ends = &self.memory[P::STAGES * n..];
        let (values, carry) = (row(ends, Rows::TRIAL, n).to_vec(), row(ends, Rows::TRIAL + 1, n).to_vec());
        let state = State { time, values, carry, time_carry, run: None };
        let numbers = core::iter::once(&next).chain(&self.magnitudes_at_end).copied().collect();
        Checkpoint::of(P::NAME, state, report, row(&self.memory, P::END, n).to_vec(), numbers)
    }

    /// Whether the step that is about to be accepted is near the limit of stability: see [`Report::was_stiff`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_nearly_unstable(&self, h: f64) -> bool {
        let n = self.components;
        let (k, rest) = self.memory.split_at(P::STAGES * n);
        let (last, end) = (row(k, Self::LAST, n), row(k, P::END, n));
        let (argument, trial) = (row(rest, Rows::INTERPOLANT + Rows::LAST_ARGUMENT, n), row(rest, Rows::TRIAL, n));
        let (mut rates, mut states) = (0.0, 0.0);
        for i in 0..n {
            let weight = self.magnitudes_at_end[i];
            let weight = if 0.0 < weight { weight.recip() } else { 0.0 };
            let (rate, state) =
                (largest_lane(end[i] - last[i]) * weight, largest_lane(trial[i] - argument[i]) * weight);
            rates += rate * rate;
            states += state * state;
        }
        let limit = P::NEARLY_UNSTABLE / h;
        limit * limit * states < rates
    }

    /// The end of the step, and its error over the tolerance.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finish<F: Field<T>>(&mut self, field: &F, state: &State<T>, h: f64) -> f64 {
        let n = F::DIMENSION.unwrap_or(self.components);
        let h_lit = T::lit(h);
        let (y, carry) = (&state.values[..n], &state.carry[..n]);
        let (k, rest) = self.memory[..Self::count() * n].split_at_mut(P::STAGES * n);
        let (ends, interpolant) = rest.split_at_mut(Rows::INTERPOLANT * n);
        let (trial, trial_carry) = ends[..Rows::START * n].split_at_mut(n);
        let (first_error, second_error) = interpolant[..2 * n].split_at_mut(n);
        weighted_sums(P::ERROR, k, first_error);
        weighted_sums(P::WEIGHTS, k, trial);
        if !P::COARSER.is_empty() {
            weighted_sums(P::COARSER, k, second_error);
        }
        for (i, trial) in trial.iter_mut().enumerate() {
            let slope = *trial;
            second_error[i] = slope - second_error[i];
            (*trial, trial_carry[i]) = (y[i], carry[i]);
            compensated_add(trial, &mut trial_carry[i], slope * h_lit);
        }

        let (before, after) = (&self.magnitudes[..n], &mut self.magnitudes_at_end[..n]);
        field.magnitudes(trial, after);
        let (absolute, relative) = (self.tolerance.absolute_part(), self.tolerance.relative_part());
        let (mut first, mut second) = (0.0, 0.0);
        for (((e, coarse), &before), &after) in first_error.iter().zip(&*second_error).zip(before).zip(&*after) {
            let allowed = absolute + relative * if before < after { after } else { before };
            let e = largest_lane(*e);
            let coarse = if P::COARSER.is_empty() { 0.0 } else { largest_lane(*coarse) };
            // An exact component is exact whatever the tolerance: also where its magnitude is zero.
            let allowed = if e <= 0.0 && coarse <= 0.0 { 1.0 } else { allowed };
            let (e, coarse) = (e / allowed, coarse / allowed);
            first += e * e;
            second += coarse * coarse;
        }
        P::error(h, n, first, second)
    }
}
