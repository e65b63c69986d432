//! The error of a whole run, by a second run.

use piola_integrators::internal::differences;
use piola_integrators::{ErrorEstimate, IntegratorsError, State};

use super::RadauIia;
use crate::StiffField;

/// The part of the tolerance that the finer run has.
const FINER: f64 = 1e-2;

impl RadauIia {
    /// Integrates to `end`, as [`integrate_to`](Self::integrate_to), and estimates the error there by a second run at a
    /// hundredth of the tolerance; with a fixed step, by one of twice as many steps.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), of either run. The state then stands where the first run ended.
    pub fn integrate_and_estimate<F: StiffField>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
    ) -> Result<ErrorEstimate, IntegratorsError<F::Error>> {
        let mut finer_state = state.clone();
        let run = self.integrate_to(field, state, end)?.run;
        let mut finer = self.finer(FINER).map_err(IntegratorsError::with_field_error)?;
        let finer_run = finer.integrate_to(field, &mut finer_state, end)?.run;
        Ok(ErrorEstimate { errors: differences(state, &finer_state), run, finer_run })
    }
}
