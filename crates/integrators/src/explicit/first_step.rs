//! The first step of a run that was not given one.

use piola_numerics::Real;

use crate::field::largest_lane;
use crate::state::check_finite;
use crate::{IntegratorsError, Report, State, Tolerance};

/// Attempts at a short Euler step that stays in the field's domain.
const MOST_ATTEMPTS: usize = 6;

/// The memory in which the first step is guessed.
pub(crate) struct Guess<'a, T> {
    pub(crate) tolerance: Tolerance,
    pub(crate) longest_step: f64,
    /// ẏ at the start.
    pub(crate) rate: &'a [T],
    /// A state, and ẏ there, to be written.
    pub(crate) trial: &'a mut [T],
    pub(crate) trial_rate: &'a mut [T],
    /// The magnitudes at the start.
    pub(crate) magnitudes: &'a [f64],
    /// Those at the trial, to be written.
    pub(crate) magnitudes_at_trial: &'a mut [f64],
}

impl<T: Real> Guess<'_, T> {
    /// The length of a first step whose error should be within the tolerance.
    ///
    /// ```text
    /// h = (0.01/‖y‖)^(1/p) / λ,    λ² = ‖ÿ‖/‖y‖
    /// ```
    ///
    /// in the norm of the tolerance. λ is a rate of the motion, so that the result follows the units of time.
    /// Rates ẏ have no say: at rest, or where a position passes through zero, they are out of all proportion
    /// to y. `evaluate` writes ẏ at a time and a state, `magnitudes_of` the magnitudes, and `root` is the p-th root.
    pub(crate) fn first_step<E>(
        self,
        state: &State<T>,
        span: f64,
        report: &mut Report,
        root: impl Fn(f64) -> f64,
        mut evaluate: impl FnMut(f64, &[T], &mut [T]) -> Result<(), IntegratorsError<E>>,
        magnitudes_of: impl FnOnce(&[T], &mut [f64]),
    ) -> f64 {
        let Self { tolerance, longest_step, rate, trial, trial_rate, magnitudes, magnitudes_at_trial } = self;
        let (absolute, relative) = (tolerance.absolute_part(), tolerance.relative_part());
        // Components of magnitude zero, as the velocities at rest, have no say.
        let norm = |x: &[T], magnitudes: &[f64]| {
            let mut sum = 0.0;
            for (&x, &magnitude) in x.iter().zip(magnitudes) {
                let ratio = largest_lane(x) / (absolute + relative * magnitude);
                if ratio.is_finite() {
                    sum += ratio * ratio;
                }
            }
            (sum / x.len().max(1) as f64).sqrt()
        };
        let longest = span.abs().min(longest_step);
        let shortest = 1e-6 * longest;
        // What the rounding of the time leaves three digits of.
        let resolved = 1e3 * f64::EPSILON * state.time.abs();

        let rate_size = norm(rate, magnitudes);
        let size = norm(&state.values, magnitudes);
        let changing = 1e-5 < size && 1e-5 < rate_size;
        let mut euler = if changing { (0.01 * size / rate_size).clamp(1e-3 * shortest, longest) } else { shortest };
        for _ in 0..MOST_ATTEMPTS {
            let step = euler * span.signum();
            for ((trial, &y), &rate) in trial.iter_mut().zip(&state.values).zip(rate) {
                *trial = y + T::lit(step) * rate;
            }
            report.evaluations += 1;
            if evaluate(state.time + step, trial, trial_rate).is_ok()
                && check_finite::<T, E>("rate", None, trial_rate).is_ok()
            {
                break;
            }
            euler *= 1e-3;
        }
        magnitudes_of(trial, magnitudes_at_trial);
        for (largest, &magnitude) in magnitudes_at_trial.iter_mut().zip(magnitudes) {
            *largest = largest.max(magnitude);
        }
        let size = norm(trial, magnitudes_at_trial).max(size);
        for (&before, after) in rate.iter().zip(&mut *trial_rate) {
            *after -= before;
        }
        let acceleration = norm(trial_rate, magnitudes_at_trial) / euler;
        let lambda = (acceleration / size).sqrt();
        let step = root(0.01 / size) / lambda;
        let step = if 0.0 < step && step.is_finite() { step.min(0.1 * longest) } else { shortest };
        step.max(resolved).min(longest)
    }
}
