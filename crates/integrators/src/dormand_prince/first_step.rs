//! The first step of a run that was not given one.

use piola_numerics::Real;

use super::{DormandPrince853, evaluate};
use crate::field::largest_lane;
use crate::state::check_finite;
use crate::{Field, Report, State};

/// Attempts at a short Euler step that stays in the field's domain.
const MOST_ATTEMPTS: usize = 6;

impl<T: Real> DormandPrince853<T> {
    /// The length of a first step whose error should be within the tolerance.
    ///
    /// ```text
    /// h = (0.01/‖y‖)^(1/8) / λ,    λ² = ‖ÿ‖/‖y‖
    /// ```
    ///
    /// in the norm of the tolerance. λ is a rate of the motion, so that the result follows the units of time.
    /// Rates ẏ have no say: at rest, or where a position passes through zero, they are out of all proportion
    /// to y.
    pub(super) fn estimate_first_step<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &State<T>,
        span: f64,
        report: &mut Report,
    ) -> f64 {
        let (absolute, relative) = (self.tolerance.absolute_part(), self.tolerance.relative_part());
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
        let longest = span.abs().min(self.longest_step);
        let shortest = 1e-6 * longest;
        // What the rounding of the time leaves three digits of.
        let resolved = 1e3 * f64::EPSILON * state.time.abs();

        let rate = norm(&self.stages[0], &self.magnitudes);
        let size = norm(&state.values, &self.magnitudes);
        let changing = 1e-5 < size && 1e-5 < rate;
        let mut euler = if changing { (0.01 * size / rate).clamp(1e-3 * shortest, longest) } else { shortest };
        for _ in 0..MOST_ATTEMPTS {
            let step = euler * span.signum();
            for ((trial, &y), &rate) in self.trial.iter_mut().zip(&state.values).zip(&self.stages[0]) {
                *trial = y + T::lit(step) * rate;
            }
            report.evaluations += 1;
            if evaluate(field, state.time + step, &self.trial, &mut self.stages[1]).is_ok()
                && check_finite::<T, F::Error>("rate", None, &self.stages[1]).is_ok()
            {
                break;
            }
            euler *= 1e-3;
        }
        field.magnitudes(&self.trial, &mut self.magnitudes_at_end);
        for (largest, &magnitude) in self.magnitudes_at_end.iter_mut().zip(&self.magnitudes) {
            *largest = largest.max(magnitude);
        }
        let size = norm(&self.trial, &self.magnitudes_at_end).max(size);
        let [before, after, ..] = &mut self.stages;
        for (&before, after) in before.iter().zip(after) {
            *after -= before;
        }
        let acceleration = norm(&self.stages[1], &self.magnitudes_at_end) / euler;
        let lambda = (acceleration / size).sqrt();
        let step = (0.01 / size).sqrt().sqrt().sqrt() / lambda;
        let step = if 0.0 < step && step.is_finite() { step.min(0.1 * longest) } else { shortest };
        step.max(resolved).min(longest)
    }
}
