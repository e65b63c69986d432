//! Events: times at which a function g(t, y) crosses zero, found within the steps.

use core::fmt;
use core::ops::ControlFlow;

use crate::{Ending, IntegratorsError, State};

/// The time at which a run is stopped, where it is not the end of the step, and how it ended.
pub type Stop = (Option<f64>, Ending);

/// What an observer's verdict means at the end of a step.
pub fn stopped_by(verdict: ControlFlow<()>) -> ControlFlow<Stop> {
    if verdict.is_break() { ControlFlow::Break((None, Ending::Stopped)) } else { ControlFlow::Continue(()) }
}

/// An accepted step with the state at any time within it.
pub trait Interpolated<E> {
    /// The times of its start and of its end.
    fn ends(&self) -> (f64, f64);
    /// Writes the state at a time within the step to `out`.
    ///
    /// # Errors
    /// Whatever keeps the state from being interpolated.
    fn state_at(&mut self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError<E>>;
}

/// Which crossings of zero count; in the direction of the run, also where it runs backwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both.
    Either,
}

/// What happens at a crossing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventAction {
    /// It is reported and the run goes on.
    Report,
    /// It is reported and the run ends there.
    Stop,
}

type Function<'e> = dyn FnMut(f64, &[f64]) -> f64 + 'e;

/// A function g(t, y) whose zeros in time are wanted.
///
/// Within each step g is looked at in eight places on the dense output, so that two crossings in one step
/// are found unless they are closer than an eighth of it. A g that is exactly zero at the start of the run
/// is not an event there: the run may start on the surface that it is to return to. Where g is exactly zero at
/// a place looked at, that is a crossing, also if g then returns to the side it came from.
#[doc(alias("zero crossing", "root"))]
pub struct Event<'e> {
    function: Box<Function<'e>>,
    crossing: Crossing,
    action: EventAction,
    /// The last time at which g was not zero, and g there; `None` before the run has left g = 0.
    last: Option<(f64, f64)>,
    pending: Option<f64>,
}

impl fmt::Debug for Event<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Event").field("crossing", &self.crossing).field("action", &self.action).finish()
    }
}

impl<'e> Event<'e> {
    /// An event at the zeros of `function`.
    #[must_use]
    pub fn new(crossing: Crossing, action: EventAction, function: impl FnMut(f64, &[f64]) -> f64 + 'e) -> Self {
        Self { function: Box::new(function), crossing, action, last: None, pending: None }
    }

    fn value<E>(&mut self, index: usize, t: f64, values: &[f64]) -> Result<f64, IntegratorsError<E>> {
        let g = (self.function)(t, values);
        if g.is_nan() { Err(IntegratorsError::InvalidEvent { event: index, t }) } else { Ok(g) }
    }

    fn counts(&self, before: f64) -> bool {
        match self.crossing {
            Crossing::Rising => before < 0.0,
            Crossing::Falling => 0.0 < before,
            Crossing::Either => true,
        }
    }
}

/// One crossing, as it is reported.
#[derive(Clone, Copy, Debug)]
pub struct Occurrence<'a> {
    /// The index of the event in the list given.
    pub event: usize,
    /// The time of the crossing, s, to rounding of the dense output; never before the crossing.
    pub time: f64,
    /// The state there.
    pub values: &'a [f64],
}

/// Places looked at in one step.
const PLACES: u32 = 8;

/// Looks at the events where a run starts.
///
/// # Errors
/// An event function that is not finite.
pub fn begin<E>(events: &mut [Event<'_>], state: &State) -> Result<(), IntegratorsError<E>> {
    for (index, event) in events.iter_mut().enumerate() {
        let g = event.value(index, state.time, &state.values)?;
        event.last = if g.abs() <= 0.0 { None } else { Some((state.time, g)) };
        event.pending = None;
    }
    Ok(())
}

/// Finds and reports the crossings of one step.
///
/// # Errors
/// As [`begin`], or whatever keeps the state from being interpolated.
pub fn locate<E>(
    step: &mut impl Interpolated<E>,
    events: &mut [Event<'_>],
    values: &mut [f64],
    on_event: &mut impl FnMut(Occurrence<'_>) -> ControlFlow<()>,
) -> Result<Option<Stop>, IntegratorsError<E>> {
    let (start, end) = step.ends();
    for place in 1..=PLACES {
        let time = if place == PLACES { end } else { start + (end - start) * (f64::from(place) / f64::from(PLACES)) };
        step.state_at(time, values)?;
        for (index, event) in events.iter_mut().enumerate() {
            let g = event.value(index, time, values)?;
            event.pending = None;
            // Before it has left the surface on which the run started, or on which it stood at the last place,
            // there is nothing to cross.
            if let Some((before_time, before)) = event.last {
                let crossed = g.abs() <= 0.0 || (g < 0.0) != (before < 0.0);
                if crossed && event.counts(before) {
                    event.pending = Some(root(step, (index, event), values, (before_time, before), (time, g))?);
                    // `values` now belongs to another time; the other events want this one.
                    step.state_at(time, values)?;
                }
            }
            event.last = if g.abs() <= 0.0 { None } else { Some((time, g)) };
        }
        let mut stop: Option<(f64, Ending)> = None;
        while let Some((index, time)) = earliest(events, start <= end) {
            // What happens at the very time of the stop is still reported.
            if stop.is_some_and(|(stop, _)| stop.to_bits() != time.to_bits()) {
                break;
            }
            events[index].pending = None;
            step.state_at(time, values)?;
            let verdict = on_event(Occurrence { event: index, time, values });
            if stop.is_none() && events[index].action == EventAction::Stop {
                stop = Some((time, Ending::Event(index)));
            }
            if stop.is_none() && verdict.is_break() {
                stop = Some((time, Ending::Stopped));
            }
        }
        if let Some((time, ending)) = stop {
            return Ok(Some((Some(time), ending)));
        }
    }
    Ok(None)
}

fn earliest(events: &[Event<'_>], forwards: bool) -> Option<(usize, f64)> {
    let mut found: Option<(usize, f64)> = None;
    for (index, event) in events.iter().enumerate() {
        if let Some(time) = event.pending
            && found.is_none_or(|(_, best)| if forwards { time < best } else { best < time })
        {
            found = Some((index, time));
        }
    }
    found
}

/// The zero of g between two times of opposite sign: false position with halving of the stale end
/// (Illinois), and bisection whenever that is slow.
fn root<E>(
    step: &mut impl Interpolated<E>,
    (index, event): (usize, &mut Event<'_>),
    values: &mut [f64],
    (mut a, mut ga): (f64, f64),
    (mut b, mut gb): (f64, f64),
) -> Result<f64, IntegratorsError<E>> {
    if gb.abs() <= 0.0 {
        return Ok(b);
    }
    // Times closer than this are one time to the dense output.
    let (start, end) = step.ends();
    let resolution = 2.0 * f64::EPSILON * (end - start).abs();
    let mut stale = 0;
    for iteration in 0..200 {
        if (b - a).abs() <= resolution.max(2.0 * f64::EPSILON * a.abs().max(b.abs())) {
            break;
        }
        let middle = if iteration % 4 == 3 { 0.5 * (a + b) } else { b - gb * ((b - a) / (gb - ga)) };
        let inside = (a < middle && middle < b) || (b < middle && middle < a);
        let middle = if inside { middle } else { 0.5 * (a + b) };
        if middle <= a.min(b) || a.max(b) <= middle {
            break;
        }
        step.state_at(middle, values)?;
        let g = event.value(index, middle, values)?;
        if g.abs() <= 0.0 {
            return Ok(middle);
        }
        if (g < 0.0) == (gb < 0.0) {
            (b, gb) = (middle, g);
            if stale == 1 {
                ga *= 0.5;
            }
            stale = 1;
        } else {
            (a, ga) = (middle, g);
            if stale == 2 {
                gb *= 0.5;
            }
            stale = 2;
        }
    }
    Ok(b)
}
