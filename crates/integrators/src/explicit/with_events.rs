//! Runs with events.

use core::ops::ControlFlow;

use super::{DenseStep, RungeKutta, RungeKuttaPair};
use crate::events::{Event, Interpolated, Occurrence, begin, locate, stopped_by};
use crate::state::check_run;
use crate::{Field, IntegratorsError, Report, State};

impl<P: RungeKuttaPair, F: Field> Interpolated<F::Error> for DenseStep<'_, P, f64, F> {
    fn ends(&self) -> (f64, f64) {
        (self.start(), self.time())
    }
    fn state_at(&mut self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError<F::Error>> {
        self.at(t, out)
    }
}

impl<P: RungeKuttaPair> RungeKutta<P, f64> {
    /// Integrates to `end` and reports the crossings of the events in the order of time. The run ends early
    /// at an event whose action is [`EventAction::Stop`](crate::EventAction::Stop), with the state there, or when one of the observers
    /// breaks. The observer sees a step after its events; a step cut short by a stop it does not see.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), and [`IntegratorsError::InvalidEvent`] where a function is NaN.
    ///
    /// # Example
    /// ```
    /// use piola_integrators::*;
    /// use std::ops::ControlFlow;
    /// // A stone thrown up at 9.80665 m/s is back after two seconds.
    /// let mut stone = field(2, |_t, y: &[f64], rate: &mut [f64]| {
    ///     rate[0] = y[1];
    ///     rate[1] = -9.80665;
    /// });
    /// let mut state = State::new(0.0, vec![0.0, 9.80665])?;
    /// let mut ground = [Event::new(Crossing::Falling, EventAction::Stop, |_t, y| y[0])];
    /// let report = DormandPrince853::new(Tolerance::relative(1e-12)?).integrate_with_events(
    ///     &mut stone, &mut state, 10.0, &mut ground,
    ///     |_| ControlFlow::Continue(()), |_| ControlFlow::Continue(()),
    /// )?;
    /// assert_eq!(report.ending, Ending::Event(0));
    /// assert!((state.time - 2.0).abs() < 1e-13);
    /// # Ok::<(), IntegratorsError>(())
    /// ```
    pub fn integrate_with_events<F: Field>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
        events: &mut [Event<'_>],
        mut on_event: impl FnMut(Occurrence<'_>) -> ControlFlow<()>,
        mut observer: impl FnMut(&mut DenseStep<'_, P, f64, F>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>> {
        check_run(field.dimension(), state, end)?;
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
