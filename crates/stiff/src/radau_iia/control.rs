//! The length of the next step and the order of the next method.

use super::order::RadauOrder;

/// The part of the step that the error allows that is taken.
const SAFETY: f64 = 0.9;
/// A step is at most so many times as long as the one before, and at least this part of it.
const GROWTH: (f64, f64) = (0.125, 8.0);
/// Contraction of Newton's iteration below which the order rises and above which it falls.
const RAISING: f64 = 0.002;
const LOWERING: f64 = 0.8;
/// Contraction beyond which a step is not made longer.
const CONTRACTION: f64 = 0.25;
/// Steps between two changes of the order.
const STEPS_BETWEEN_ORDERS: u32 = 4;
/// Errors below this are no reason for a longer step.
const LEAST_ERROR: f64 = 1e-2;

/// A step that may be accepted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempt {
    pub(super) sweeps: u32,
    pub(super) most_sweeps: u32,
    /// The factor by which a sweep shortens the change, where there were two.
    pub(super) contraction: Option<f64>,
    /// The estimated error over the error allowed: a step with 1 or more is rejected.
    pub(super) error: f64,
}

/// The controller's memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub(super) struct Controller {
    /// The order of the next step.
    pub(super) order: RadauOrder,
    lowest: RadauOrder,
    highest: RadauOrder,
    /// Length and error of the last accepted step, of the same order.
    last: Option<(f64, f64)>,
    steps_since_change: u32,
}

/// By how much the step should be longer for its error alone.
fn factor_for(error: f64, order: RadauOrder) -> f64 {
    error.powf(-1.0 / (order.tableau().stages() as f64 + 1.0))
}

impl Controller {
    pub(super) const fn new(lowest: RadauOrder, highest: RadauOrder) -> Self {
        Self { order: lowest, lowest, highest, last: None, steps_since_change: 0 }
    }

    /// The same within other bounds.
    pub(super) fn within(self, lowest: RadauOrder, highest: RadauOrder) -> Self {
        Self { order: self.order.clamp(lowest, highest), lowest, highest, ..self }
    }

    /// The part of a step of this error to be tried instead.
    pub(super) fn after_rejection(&self, attempt: Attempt) -> f64 {
        (safety(attempt) * factor_for(attempt.error, self.order)).clamp(GROWTH.0, 0.9)
    }

    /// The factor by which the step after an accepted one of length h is longer.
    pub(super) fn after_step(&mut self, h: f64, attempt: Attempt) -> f64 {
        let error = attempt.error.max(1e-10);
        let mut factor = safety(attempt) * factor_for(error, self.order);
        if let Some((last_h, last_error)) = self.last {
            // As the error changed over the last step, it will change.
            let predicted = SAFETY * (h / last_h) * factor_for(error * error / last_error, self.order);
            factor = factor.min(predicted);
        }
        if let Some(contraction) = attempt.contraction {
            // The contraction grows at least like the step; beyond its limit the iteration would fail.
            factor = factor.min((CONTRACTION / contraction).sqrt().max(1.0));
        }
        self.last = Some((h, error.max(LEAST_ERROR)));
        factor.clamp(GROWTH.0, GROWTH.1)
    }

    /// Chooses the order after an accepted step by the contraction of its iteration.
    pub(super) fn choose_order(&mut self, contraction: Option<f64>) {
        self.steps_since_change = self.steps_since_change.saturating_add(1);
        let Some(contraction) = contraction else { return };
        if LOWERING <= contraction {
            self.lower();
        } else if contraction <= RAISING && STEPS_BETWEEN_ORDERS <= self.steps_since_change {
            self.change(self.order.higher().min(self.highest));
        }
    }

    /// The stages did not converge.
    pub(super) fn lower(&mut self) {
        self.change(self.order.lower().max(self.lowest));
    }

    fn change(&mut self, order: RadauOrder) {
        if self.order != order {
            *self = Self { order, last: None, steps_since_change: 0, ..*self };
        }
    }
}

/// The safety factor, smaller where Newton's iteration needed many sweeps.
fn safety(attempt: Attempt) -> f64 {
    let (sweeps, most) = (f64::from(attempt.sweeps), f64::from(attempt.most_sweeps));
    SAFETY * (2.0 * most + 1.0) / (2.0 * most + sweeps)
}
