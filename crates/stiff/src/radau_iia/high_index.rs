//! Whether a run fails because its constraints are of index three.
//!
//! A component of differentiation index ν answers to a disturbance of the equations as the power 1 − ν of the step:
//!
//! ```text
//! x(h) = (γ/h M − J)⁻¹ b,    |xₖ(h/16)| / |xₖ(h)| → 16^(ν−1)
//! ```

use piola_integrators::{IntegratorsError, State};

use super::RadauIia;
use super::order::RadauOrder;
use crate::StiffField;

/// The factor between the two steps.
const FACTOR: f64 = 16.0;
/// The longer one, in parts of the span.
const PART: f64 = 1e-3;

impl RadauIia {
    /// The refusal of a component whose index is above two, if there is one. The factors in memory are lost.
    pub(super) fn index_above_two<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &State,
        span: f64,
    ) -> Option<IntegratorsError<F::Error>> {
        if field.mass().is_none() && field.mass_entries().is_none() {
            return None;
        }
        let (work, t, tableau) = (&mut self.work, state.time, RadauOrder::Five.tableau());
        field.jacobian(t, &state.values, work.matrices.jacobian()).ok()?;
        let h = PART * span;
        work.matrices.factor(tableau, h).ok()?;
        work.trial.fill(1.0);
        work.matrices.solve_real(&mut work.trial);
        work.matrices.factor(tableau, h / FACTOR).ok()?;
        work.error.fill(1.0);
        work.matrices.solve_real(&mut work.error);
        let mut highest = (0, 0.0_f64);
        for (component, (&short, &long)) in work.error.iter().zip(&work.trial).enumerate() {
            let growth = short.abs() / long.abs();
            if highest.1 < growth && growth.is_finite() {
                highest = (component, growth);
            }
        }
        let (component, growth) = highest;
        // Half way between the indices two and three.
        if growth < FACTOR * FACTOR.sqrt() {
            return None;
        }
        let index = if growth < FACTOR * FACTOR * FACTOR.sqrt() { 3 } else { 4 };
        Some(IntegratorsError::IndexTooHigh { component, index, t })
    }
}
