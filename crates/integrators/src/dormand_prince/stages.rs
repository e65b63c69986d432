//! One trial step: its stages, its end and its error.

use core::cell::RefCell;

use piola_numerics::Real;

use super::coefficients as c;
use super::{DormandPrince853, Row, evaluate};
use crate::explicit::{EmbeddedPair, Guess, Limits, combine, row, row_mut, weighted_sums};
use crate::field::{check_field, largest_lane};
use crate::state::{check_finite, check_run, compensated_add};
use crate::{Field, IntegratorsError, Report, State};

impl<T: Real, F: Field<T>> EmbeddedPair<T, F> for DormandPrince853<T> {
    type Error = F::Error;

    fn limits(&self) -> Limits {
        self.limits
    }

    fn begin(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<F::Error>> {
        check_field::<T, F>(field)?;
        check_run(field.dimension(), state, end)?;
        let n = state.values.len();
        self.components = n;
        self.memory.resize(Row::COUNT * n, T::zero());
        self.magnitudes.resize(n, 0.0);
        self.magnitudes_at_end.resize(n, 0.0);
        let span = end - state.time;
        if span.abs() <= 0.0 {
            return Ok(0.0);
        }
        let (stages, rest) = self.memory.split_at_mut(Row::STAGES * n);
        let (rate, others) = stages.split_at_mut(n);
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
            eighth_root,
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
        let (k, rest) = self.memory[..Row::COUNT * n].split_at_mut(Row::STAGES * n);
        let trial = &mut rest[..n];
        let y = (&state.values[..n], &state.carry[..n]);
        macro_rules! stage {
            ($number:literal, $row:expr) => {
                combine(&$row, k, y, h, trial);
                report.evaluations += 1;
                evaluate(field, t + c::C[$number] * h, trial, row_mut(k, $number, n))?;
            };
        }
        stage!(1, c::A2);
        stage!(2, c::A3);
        stage!(3, c::A4);
        stage!(4, c::A5);
        stage!(5, c::A6);
        stage!(6, c::A7);
        stage!(7, c::A8);
        stage!(8, c::A9);
        stage!(9, c::A10);
        stage!(10, c::A11);
        stage!(11, c::A12);
        let error = self.finish(field, state, h);
        let (k, rest) = self.memory[..Row::COUNT * n].split_at_mut(Row::STAGES * n);
        let trial = &mut rest[..n];
        if error <= 1.0 {
            field.project(t + h, trial).map_err(|source| IntegratorsError::Field { t: t + h, source })?;
            report.evaluations += 1;
            let rate = row_mut(k, 12, n);
            evaluate(field, t + h, trial, rate)?;
            check_finite("rate", Some(t), rate)?;
        } else if error.is_nan() {
            for number in 1..12 {
                check_finite("rate", Some(t), row(k, number, n))?;
            }
        }
        Ok(error)
    }

    fn root(error: f64) -> f64 {
        eighth_root(error)
    }

    fn accept(&mut self, state: &mut State<T>) {
        let n = F::DIMENSION.unwrap_or(self.components);
        let rows = &mut self.memory[Row::TRIAL * n..Row::COUNT * n];
        let (trial, start) = rows.split_at_mut(2 * n);
        let (values, carry) = (&mut state.values[..n], &mut state.carry[..n]);
        start[..n].copy_from_slice(values);
        start[n..2 * n].copy_from_slice(carry);
        values.copy_from_slice(&trial[..n]);
        carry.copy_from_slice(&trial[n..]);
    }

    fn advance(
        &mut self,
        _field: &mut F,
        _state: &State<T>,
        _report: &mut Report,
    ) -> Result<(), IntegratorsError<F::Error>> {
        // The rate at the end is the first stage of the next step.
        let n = F::DIMENSION.unwrap_or(self.components);
        let (first, rest) = self.memory[..13 * n].split_at_mut(n);
        first.copy_from_slice(row(rest, 11, n));
        core::mem::swap(&mut self.magnitudes, &mut self.magnitudes_at_end);
        Ok(())
    }
}

fn eighth_root(x: f64) -> f64 {
    x.sqrt().sqrt().sqrt()
}

impl<T: Real> DormandPrince853<T> {
    /// The end of the step, and its error over the tolerance: the estimate of order five, damped by that of
    /// order three.
    ///
    /// ```text
    /// e = |h| ‖e₅‖² / √(n (‖e₅‖² + 0.01 ‖e₃‖²)),    ‖x‖² = Σᵢ (xᵢ/allowedᵢ)²
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finish<F: Field<T>>(&mut self, field: &F, state: &State<T>, h: f64) -> f64 {
        let n = F::DIMENSION.unwrap_or(self.components);
        // E5 has the stages of B; those of B3 are among them.
        let h_lit = T::lit(h);
        let (y, carry) = (&state.values[..n], &state.carry[..n]);
        let (k, rest) = self.memory[..Row::COUNT * n].split_at_mut(Row::STAGES * n);
        let (ends, rest) = rest.split_at_mut((Row::INTERPOLANT - Row::TRIAL) * n);
        let (trial, trial_carry) = ends[..2 * n].split_at_mut(n);
        let (fifth_error, third_error) = rest[..2 * n].split_at_mut(n);
        weighted_sums(&c::E5, k, fifth_error);
        weighted_sums(&c::B, k, trial);
        weighted_sums(&c::B3, k, third_error);
        for (i, trial) in trial.iter_mut().enumerate() {
            let slope = *trial;
            third_error[i] = slope - third_error[i];
            (*trial, trial_carry[i]) = (y[i], carry[i]);
            compensated_add(trial, &mut trial_carry[i], slope * h_lit);
        }

        let (before, after) = (&self.magnitudes[..n], &mut self.magnitudes_at_end[..n]);
        field.magnitudes(trial, after);
        let (absolute, relative) = (self.tolerance.absolute_part(), self.tolerance.relative_part());
        let (mut fifth, mut third) = (0.0, 0.0);
        for (((e5, e3), &before), &after) in fifth_error.iter().zip(&*third_error).zip(before).zip(&*after) {
            let allowed = absolute + relative * if before < after { after } else { before };
            let (e5, e3) = (largest_lane(*e5), largest_lane(*e3));
            // An exact component is exact whatever the tolerance: also where its magnitude is zero.
            let allowed = if e5 <= 0.0 && e3 <= 0.0 { 1.0 } else { allowed };
            let (e5, e3) = (e5 / allowed, e3 / allowed);
            fifth += e5 * e5;
            third += e3 * e3;
        }
        let denominator = fifth + 0.01 * third;
        if denominator <= 0.0 {
            return 0.0;
        }
        if denominator.is_infinite() {
            return f64::INFINITY;
        }
        h.abs() * fifth / (denominator * n as f64).sqrt()
    }
}
