//! Runs with events.

use core::ops::ControlFlow;

use super::{Nystrom, NystromPair, NystromStep};
use crate::events::{Event, Interpolated, Occurrence, begin, locate, stopped_by};
use crate::state::check_run;
use crate::{IntegratorsError, Report, SecondOrder, State};

impl<P: NystromPair, F: SecondOrder> Interpolated<F::Error> for NystromStep<'_, P, f64, F> {
    fn ends(&self) -> (f64, f64) {
        (self.start(), self.time())
    }
    fn state_at(&mut self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError<F::Error>> {
        self.at(t, out)
    }
}

impl<P: NystromPair> Nystrom<P, f64> {
    /// Integrates to `end` and reports the crossings of the events in the order of time.
    /// See [`RungeKutta::integrate_with_events`](crate::RungeKutta::integrate_with_events): the events are the same.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), and [`IntegratorsError::InvalidEvent`] where a function is NaN.
    pub fn integrate_with_events<F: SecondOrder>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        events: &mut [Event<'_>],
        mut on_event: impl FnMut(Occurrence<'_>) -> ControlFlow<()>,
        mut observer: impl FnMut(&mut NystromStep<'_, P, f64, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        check_run(2 * field.freedom(), state, end)?;
        let mut values = state.values.clone();
        begin(events, state)?;
        self.run(field, state, end, None, &mut |step| {
            if !events.is_empty()
                && let Some(stop) = locate(step, events, &mut values, &mut on_event)?
            {
                return Ok(ControlFlow::Break(stop));
            }
            Ok(stopped_by(observer(step)))
        })
    }
}
