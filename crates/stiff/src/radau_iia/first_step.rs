//! The first step of a run that was not given one.

use piola_integrators::State;

use super::aim::Aim;
use super::norm::norm;
use super::order::RadauOrder;
use super::{RadauIia, RadauReport};
use crate::StiffField;

/// A first step tried where none can be estimated, as part of the span.
const SHORT: f64 = 1e-6;

impl RadauIia {
    /// The length of a first step whose error should be within the tolerance: h = (1/‖y‖)^(1/(s+1)) / λ, λ² = ‖ÿ‖/‖y‖.
    pub(super) fn first_step<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &State,
        span: f64,
        order: RadauOrder,
        report: &mut RadauReport,
    ) -> f64 {
        let longest = span.abs().min(self.longest_step);
        let shortest = SHORT * longest;
        if field.mass().is_some() || field.mass_entries().is_some() {
            return shortest;
        }
        let aim = Aim::of(self.control, order);
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
        if field.rate(state.time + euler.copysign(span), &work.trial, &mut work.rate_at_end).is_err() {
            return shortest;
        }
        for (after, before) in work.rate_at_end.iter_mut().zip(&work.rate) {
            *after -= before;
        }
        let lambda = (norm(&work.rate_at_end, &work.weights) / euler / size).sqrt();
        let step = size.powf(-1.0 / (order.tableau().stages() as f64 + 1.0)) / lambda;
        let resolved = 1e3 * f64::EPSILON * state.time.abs();
        if 0.0 < step && step.is_finite() { step.min(0.1 * longest).max(resolved).min(longest) } else { shortest }
    }
}
