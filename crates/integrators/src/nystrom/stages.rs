//! One trial step: its stages, its end and its error.

use piola_numerics::Real;

use super::{Nystrom, NystromPair, Rows};
use crate::checkpoint::Checkpoint;
use crate::explicit::{EmbeddedPair, Guess, Limits, combine, row, row_mut, weighted_sums};
use crate::field::largest_lane;
use crate::second_order::check_freedom;
use crate::state::{check_finite, check_run, compensated_add};
use crate::{IntegratorsError, Report, SecondOrder, State};

/// Writes f(t, q) to `acceleration`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn evaluate<T: Real, F: SecondOrder<T>>(
    field: &mut F,
    t: f64,
    q: &[T],
    acceleration: &mut [T],
) -> Result<(), IntegratorsError<F::Error>> {
    // The velocities are not read: their place is filled with the positions.
    field.acceleration(T::lit(t), q, q, acceleration).map_err(|source| IntegratorsError::Field { t, source })
}

/// The largest position and the largest velocity of a state.
#[cfg_attr(not(debug_assertions), inline(always))]
fn magnitudes<T: Real>(state: &[T]) -> [f64; 2] {
    let (q, v) = state.split_at(state.len() / 2);
    [q, v].map(|block| block.iter().fold(0.0, |largest: f64, &x| largest.max(largest_lane(x))))
}

impl<P: NystromPair, T: Real> Nystrom<P, T> {
    /// The first step to try.
    fn guess<F: SecondOrder<T>>(&mut self, field: &mut F, state: &State<T>, span: f64, report: &mut Report) -> f64 {
        let n = self.freedom;
        let (stages, rest) = self.memory.split_at_mut(P::STAGES * n);
        let (others, rest) = rest.split_at_mut(Rows::LEGENDRE * n);
        let (rate, others_too) = others.split_at_mut(2 * n);
        rate[..n].copy_from_slice(&state.values[n..]);
        rate[n..].copy_from_slice(&stages[..n]);
        let spread = |[q, v]: [f64; 2], all: &mut [f64]| {
            all[..n].fill(q);
            all[n..].fill(v);
        };
        self.spread.resize(4 * n, 0.0);
        let (at_start, at_trial) = self.spread.split_at_mut(2 * n);
        if F::OWN_MAGNITUDES {
            at_start.copy_from_slice(&self.own_magnitudes);
        } else {
            spread(self.magnitudes, at_start);
        }
        let field = core::cell::RefCell::new(field);
        let guess = Guess {
            tolerance: self.tolerance,
            longest_step: self.limits.longest_step,
            rate,
            trial: &mut rest[..2 * n],
            trial_rate: &mut others_too[..2 * n],
            magnitudes: at_start,
            magnitudes_at_trial: at_trial,
        };
        let evaluate = |t: f64, y: &[T], rate: &mut [T]| {
            let (velocity, acceleration) = rate.split_at_mut(n);
            velocity.copy_from_slice(&y[n..]);
            evaluate(*field.borrow_mut(), t, &y[..n], acceleration)
        };
        let magnitudes_of = |y: &[T], all: &mut [f64]| {
            if F::OWN_MAGNITUDES { field.borrow().magnitudes(y, all) } else { spread(magnitudes(y), all) }
        };
        guess.first_step(state, span, report, P::root, evaluate, magnitudes_of)
    }

    /// The end of the step, and its error over the tolerance.
    ///
    /// ```text
    /// e = √(Σᵢ (eᵢ/allowedᵢ)² / 2n)
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finish<F: SecondOrder<T>>(&mut self, field: &F, state: &State<T>, h: f64) -> f64 {
        let n = F::FREEDOM.unwrap_or(self.freedom);
        let (k, rest) = self.memory[..(P::STAGES + Rows::COUNT) * n].split_at_mut(P::STAGES * n);
        let (ends, errors) = rest.split_at_mut(Rows::LEGENDRE * n);
        let (trial, trial_carry) = ends[..Rows::START * n].split_at_mut(2 * n);
        let (position_error, velocity_error) = errors[..2 * n].split_at_mut(n);
        weighted_sums(P::POSITION, k, &mut trial[..n]);
        weighted_sums(P::VELOCITY, k, &mut trial[n..]);
        weighted_sums(P::POSITION_ERROR, k, position_error);
        weighted_sums(P::VELOCITY_ERROR, k, velocity_error);
        let (values, carry) = (&state.values[..2 * n], &state.carry[..2 * n]);
        let h_lit = T::lit(h);
        for i in 0..n {
            let gained = h_lit * (values[n + i] + (carry[n + i] + h_lit * trial[i]));
            (trial[i], trial_carry[i]) = (values[i], carry[i]);
            compensated_add(&mut trial[i], &mut trial_carry[i], gained);
            let gained = h_lit * trial[n + i];
            (trial[n + i], trial_carry[n + i]) = (values[n + i], carry[n + i]);
            compensated_add(&mut trial[n + i], &mut trial_carry[n + i], gained);
        }
        let (absolute, relative) = (self.tolerance.absolute_part(), self.tolerance.relative_part());
        let mut sum = 0.0;
        if F::OWN_MAGNITUDES {
            let (before, after) = (&self.own_magnitudes[..2 * n], &mut self.own_magnitudes_at_end[..2 * n]);
            field.magnitudes(trial, after);
            for i in 0..2 * n {
                let (error, factor) = if i < n { (position_error[i], h * h) } else { (velocity_error[i - n], h.abs()) };
                let error = largest_lane(error);
                if error.is_nan() || 0.0 < error {
                    let part = error * (factor / (absolute + relative * before[i].max(after[i])));
                    sum += part * part;
                }
            }
            return (sum / (2 * n).max(1) as f64).sqrt();
        }
        self.magnitudes_at_end = magnitudes(trial);
        let blocks = [(&*position_error, h * h), (&*velocity_error, h.abs())];
        for ((errors, factor), (&before, &after)) in
            blocks.into_iter().zip(self.magnitudes.iter().zip(&self.magnitudes_at_end))
        {
            let allowed = absolute + relative * before.max(after);
            let block: f64 = errors.iter().map(|&e| largest_lane(e)).map(|e| e * e).sum();
            // An exact block is exact whatever the tolerance: also where its magnitude is zero.
            if block.is_nan() || 0.0 < block {
                sum += block * (factor / allowed) * (factor / allowed);
            }
        }
        (sum / (2 * n).max(1) as f64).sqrt()
    }
}

impl<P: NystromPair, T: Real, F: SecondOrder<T>> EmbeddedPair<T, F> for Nystrom<P, T> {
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
        check_freedom::<T, F>(field)?;
        if field.is_velocity_dependent() {
            return Err(IntegratorsError::VelocityDependent);
        }
        let n = field.freedom();
        match resumed {
            None => check_run(2 * n, state, end)?,
            Some(checkpoint) => {
                checkpoint.open(P::NAME, [n, 3], &[0], state, |state| check_run(2 * n, state, end))?;
            }
        }
        self.freedom = n;
        self.memory.resize((P::STAGES + Rows::COUNT) * n, T::zero());
        self.argument.resize(n, T::zero());
        let span = end - state.time;
        if span.abs() <= 0.0 {
            return Ok(0.0);
        }
        if F::OWN_MAGNITUDES {
            self.own_magnitudes.resize(2 * n, 0.0);
            self.own_magnitudes_at_end.resize(2 * n, 0.0);
            field.magnitudes(&state.values, &mut self.own_magnitudes);
        }
        let first = &mut self.memory[..n];
        if let Some(Checkpoint { memory, numbers, .. }) = resumed {
            first.copy_from_slice(memory);
            self.magnitudes = [numbers[1], numbers[2]];
            return Ok(numbers[0]);
        }
        evaluate(field, state.time, &state.values[..n], first)?;
        report.evaluations += 1;
        check_finite("rate", Some(state.time), first)?;
        self.magnitudes = magnitudes(&state.values);
        match self.limits.first_step {
            Some(step) => Ok(step),
            None => Ok(self.guess(field, state, span, report)),
        }
    }

    fn attempt(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<F::Error>> {
        let t = state.time;
        let n = F::FREEDOM.unwrap_or(self.freedom);
        let (k, rest) = self.memory[..(P::STAGES + Rows::COUNT) * n].split_at_mut(P::STAGES * n);
        let (argument, base) = rest[Rows::ARGUMENT * n..].split_at_mut(n);
        let (q, v) = state.values[..2 * n].split_at(n);
        let carry = &state.carry[..n];
        for (number, weights) in P::ROWS.iter().enumerate() {
            let number = number + 1;
            let part = P::NODES[number] * h;
            let moved = T::lit(part);
            for i in 0..n {
                base[i] = carry[i] + moved * v[i];
            }
            combine(weights, k, (q, base), h * h, argument);
            report.evaluations += 1;
            evaluate(field, t + part, argument, row_mut(k, number, n))?;
        }
        let error = self.finish(&*field, state, h);
        let (k, rest) = self.memory.split_at_mut(P::STAGES * n);
        if error.is_nan() {
            for number in 1..=P::ROWS.len() {
                check_finite("rate", Some(t), row(k, number, n))?;
            }
        } else if error <= 1.0 && P::ROWS.len() < P::END {
            report.evaluations += 1;
            let rate = row_mut(k, P::END, n);
            evaluate(field, t + h, &rest[..n], rate)?;
            check_finite("rate", Some(t), rate)?;
        }
        Ok(error)
    }

    fn root(error: f64) -> f64 {
        P::root(error)
    }

    fn accept(&mut self, state: &mut State<T>) {
        let n = F::FREEDOM.unwrap_or(self.freedom);
        let rows = &mut self.memory[P::STAGES * n..(P::STAGES + Rows::COUNT) * n];
        let (trial, start) = rows.split_at_mut(Rows::START * n);
        let (values, carry) = (&mut state.values[..2 * n], &mut state.carry[..2 * n]);
        start[..2 * n].copy_from_slice(values);
        start[2 * n..4 * n].copy_from_slice(carry);
        values.copy_from_slice(&trial[..2 * n]);
        carry.copy_from_slice(&trial[2 * n..]);
    }

    fn advance(
        &mut self,
        _field: &mut F,
        _state: &State<T>,
        _report: &mut Report,
    ) -> Result<(), IntegratorsError<F::Error>> {
        // The acceleration at the end is the first stage of the next step.
        let n = F::FREEDOM.unwrap_or(self.freedom);
        let (first, rest) = self.memory.split_at_mut(n);
        first.copy_from_slice(row(rest, P::END - 1, n));
        self.magnitudes = self.magnitudes_at_end;
        core::mem::swap(&mut self.own_magnitudes, &mut self.own_magnitudes_at_end);
        Ok(())
    }
}
