//! Drives an integrator over the instants of a timetable and records what it passes.
//!
//! Methods of fixed step land on every instant. The adaptive method lands on the landings of the timetable, gives the
//! other instants by dense output, and shows invariants at the ends of its steps.

use core::fmt::Display;
use core::ops::ControlFlow;

use piola_integrators::{
    Composition, DenseStep, DormandPrince853, Ending, Field, GaussLegendre, IntegratorsError, Nystrom, Nystrom86,
    Nystrom1210, NystromPair, NystromStep, Report, RungeKutta, RungeKuttaPair, SecondOrder, Separable, State,
    Tolerance, Verner98,
};

use super::{History, Invariants, Method, Progress, TimeSpan, Timetable};

/// Reads everything that is recorded out of a state.
pub(super) trait Reading {
    /// Adds positions, velocities and coordinates of a state.
    fn record(&mut self, time: f64, values: &[f64], history: &mut History);
    /// The invariants of a state.
    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants;
}

/// The observer of a run: it sees the progress after every step and may stop the run.
pub(super) type Observer<'o> = &'o mut dyn FnMut(Progress) -> ControlFlow<()>;

/// Takes a driver and a state to an instant.
type Advance<'a, 'o> = &'a mut dyn FnMut(&mut Driver<'o>, &mut State, f64) -> Result<Report, IntegratorsError<String>>;

/// Takes a driver and a state to a landing; also whether dense output failed.
type Landing<'a, 'o> = &'a mut dyn FnMut(
    &mut Driver<'o>,
    &mut State,
    f64,
    &mut dyn Reading,
    &mut [f64],
) -> (Result<Report, IntegratorsError<String>>, Result<(), String>);

/// A field or a separable pair behind a pointer: the integrators are compiled once and not once a system.
/// Their cost beside the forces of a system is a call through a pointer, some nanoseconds an evaluation.
struct AnyField<'f, F: ?Sized>(&'f mut F);

/// What an integrator asks of a field, with errors as text.
trait FieldWithText {
    fn dimension(&self) -> usize;
    fn is_second_order(&self) -> bool;
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), String>;
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), String>;
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]);
}

impl<F: Field<Error: Display>> FieldWithText for F {
    fn dimension(&self) -> usize {
        Field::dimension(self)
    }
    fn is_second_order(&self) -> bool {
        Field::is_second_order(self)
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), String> {
        Field::rate(self, t, y, rate).map_err(|error| error.to_string())
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), String> {
        Field::project(self, t, y).map_err(|error| error.to_string())
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        Field::magnitudes(self, y, magnitudes);
    }
}

impl Field for AnyField<'_, dyn FieldWithText + '_> {
    type Error = String;
    fn dimension(&self) -> usize {
        self.0.dimension()
    }
    fn is_second_order(&self) -> bool {
        self.0.is_second_order()
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), String> {
        self.0.rate(t, y, rate)
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), String> {
        self.0.project(t, y)
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        self.0.magnitudes(y, magnitudes);
    }
}

/// What a composition asks of a separable pair, with errors as text.
trait SeparableWithText {
    fn freedom(&self) -> usize;
    fn velocity(&mut self, t: f64, momentum: &[f64], velocity: &mut [f64]) -> Result<(), String>;
    fn force(&mut self, t: f64, position: &[f64], force: &mut [f64]) -> Result<(), String>;
}

impl<F: Separable<Error: Display>> SeparableWithText for F {
    fn freedom(&self) -> usize {
        Separable::freedom(self)
    }
    fn velocity(&mut self, t: f64, momentum: &[f64], velocity: &mut [f64]) -> Result<(), String> {
        Separable::velocity(self, t, momentum, velocity).map_err(|error| error.to_string())
    }
    fn force(&mut self, t: f64, position: &[f64], force: &mut [f64]) -> Result<(), String> {
        Separable::force(self, t, position, force).map_err(|error| error.to_string())
    }
}

impl Separable for AnyField<'_, dyn SeparableWithText + '_> {
    type Error = String;
    fn freedom(&self) -> usize {
        self.0.freedom()
    }
    fn velocity(&mut self, t: f64, momentum: &[f64], velocity: &mut [f64]) -> Result<(), String> {
        self.0.velocity(t, momentum, velocity)
    }
    fn force(&mut self, t: f64, position: &[f64], force: &mut [f64]) -> Result<(), String> {
        self.0.force(t, position, force)
    }
}

/// What a Nyström pair asks of a system, with errors as text.
trait SecondOrderWithText {
    fn freedom(&self) -> usize;
    fn is_velocity_dependent(&self) -> bool;
    fn acceleration(&mut self, t: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), String>;
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]);
}

impl<F: SecondOrder<f64, Error: Display>> SecondOrderWithText for F {
    fn freedom(&self) -> usize {
        SecondOrder::freedom(self)
    }
    fn is_velocity_dependent(&self) -> bool {
        SecondOrder::is_velocity_dependent(self)
    }
    fn acceleration(&mut self, t: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), String> {
        SecondOrder::acceleration(self, t, q, v, acceleration).map_err(|error| error.to_string())
    }
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]) {
        SecondOrder::magnitudes(self, state, magnitudes);
    }
}

impl SecondOrder for AnyField<'_, dyn SecondOrderWithText + '_> {
    type Error = String;
    const OWN_MAGNITUDES: bool = true;
    fn freedom(&self) -> usize {
        self.0.freedom()
    }
    fn is_velocity_dependent(&self) -> bool {
        self.0.is_velocity_dependent()
    }
    fn acceleration(&mut self, t: f64, q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), String> {
        self.0.acceleration(t, q, v, acceleration)
    }
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]) {
        self.0.magnitudes(state, magnitudes);
    }
}

/// An accepted step of an adaptive method.
trait AdaptiveStep {
    fn time(&self) -> f64;
    fn values(&self) -> &[f64];
    fn at(&mut self, t: f64, values: &mut [f64]) -> Result<(), String>;
}

impl<P: RungeKuttaPair, F: Field<f64, Error: Display>> AdaptiveStep for DenseStep<'_, P, f64, F> {
    fn time(&self) -> f64 {
        self.time()
    }
    fn values(&self) -> &[f64] {
        self.values()
    }
    fn at(&mut self, t: f64, values: &mut [f64]) -> Result<(), String> {
        self.at(t, values).map_err(|error| error.to_string())
    }
}

impl<P: NystromPair, F: SecondOrder<f64, Error: Display>> AdaptiveStep for NystromStep<'_, P, f64, F> {
    fn time(&self) -> f64 {
        self.time()
    }
    fn values(&self) -> &[f64] {
        self.values()
    }
    fn at(&mut self, t: f64, values: &mut [f64]) -> Result<(), String> {
        self.at(t, values).map_err(|error| error.to_string())
    }
}

pub(super) struct Driver<'o> {
    history: History,
    report: Report,
    time: f64,
    span: TimeSpan,
    instants: Vec<f64>,
    /// The first instant that is not recorded yet.
    next: usize,
    landings: Vec<f64>,
    observer: Observer<'o>,
    steps: u64,
}

impl<'o> Driver<'o> {
    pub(super) fn new(names: Vec<String>, timetable: &Timetable, observer: Observer<'o>) -> Self {
        let span = timetable.span();
        let mut landings = timetable.landings.clone();
        landings.push(span.end);
        landings.retain(|t| span.order(span.start, *t).is_lt());
        landings.dedup_by(|a, b| span.order(*a, *b).is_eq());
        Self {
            history: History { names, ..History::default() },
            report: Report::begin(),
            time: span.start,
            span,
            instants: timetable.instants().to_vec(),
            next: 0,
            landings,
            observer,
            steps: 0,
        }
    }

    pub(super) fn start(&self) -> f64 {
        self.span.start
    }

    pub(super) fn history(&mut self) -> &mut History {
        &mut self.history
    }

    pub(super) fn finish(self) -> (History, Report, f64) {
        (self.history, self.report, self.time)
    }

    fn step_done(&mut self, time: f64) -> ControlFlow<()> {
        self.steps += 1;
        self.time = time;
        let fraction = ((time - self.span.start) / (self.span.end - self.span.start)).clamp(0.0, 1.0);
        (self.observer)(Progress { time, fraction, steps: self.steps })
    }

    /// Records the state at the start.
    fn begin(&mut self, state: &State, reading: &mut dyn Reading) {
        reading.record(state.time, &state.values, &mut self.history);
        let invariants = reading.invariants(state.time, &state.values);
        self.history.invariants.push(invariants);
        while self.instants.get(self.next).is_some_and(|t| self.span.order(*t, self.span.start).is_le()) {
            self.next += 1;
        }
    }

    /// A method of fixed step, from instant to instant.
    fn fixed(&mut self, state: &mut State, reading: &mut dyn Reading, advance: Advance<'_, 'o>) -> Result<(), String> {
        self.begin(state, reading);
        while let Some(&instant) = self.instants.get(self.next) {
            let steps_before = self.steps;
            let result = advance(self, state, instant);
            self.time = state.time;
            match result {
                Ok(report) => self.report = self.report.then(report),
                Err(error) => {
                    self.report.steps += self.steps - steps_before;
                    return Err(error.to_string());
                }
            }
            reading.record(state.time, &state.values, &mut self.history);
            let invariants = reading.invariants(state.time, &state.values);
            self.history.invariants.push(invariants);
            self.next += 1;
            if self.report.ending == Ending::Stopped {
                break;
            }
        }
        Ok(())
    }

    /// An explicit composition.
    pub(super) fn separable(
        &mut self,
        method: &mut Composition,
        field: &mut impl Separable<Error: Display>,
        state: &mut State,
        reading: &mut dyn Reading,
    ) -> Result<(), String> {
        let mut field = AnyField(field as &mut dyn SeparableWithText);
        self.fixed(state, reading, &mut |driver, state, instant| {
            method.integrate(&mut field, state, instant, |step| driver.step_done(step.time))
        })
    }

    /// Any other method.
    pub(super) fn field(
        &mut self,
        method: Method,
        field: &mut impl Field<Error: Display>,
        state: &mut State,
        reading: &mut dyn Reading,
    ) -> Result<(), String> {
        self.any_field(method, AnyField(field as &mut dyn FieldWithText), state, reading)
    }

    fn any_field(
        &mut self,
        method: Method,
        mut field: AnyField<dyn FieldWithText + '_>,
        state: &mut State,
        reading: &mut dyn Reading,
    ) -> Result<(), String> {
        match method {
            Method::GaussLegendre { order, step } => {
                let mut method = GaussLegendre::new(order, step).map_err(|error| error.to_string())?;
                self.fixed(state, reading, &mut |driver, state, instant| {
                    method.integrate(&mut field, state, instant, |step| driver.step_done(step.time))
                })
            }
            Method::DormandPrince { tolerance } => {
                let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
                self.adaptive(&mut DormandPrince853::new(tolerance), &mut field, state, reading)
            }
            Method::Verner { tolerance } => {
                let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
                self.adaptive(&mut Verner98::new(tolerance), &mut field, state, reading)
            }
            Method::Composition { .. } => {
                Err("an explicit composition needs forces that depend on positions alone".to_string())
            }
            Method::Nystrom86 { .. } | Method::Nystrom1210 { .. } => {
                Err("a Nyström pair needs forces that depend on positions alone".to_string())
            }
        }
    }

    /// A Nyström pair.
    pub(super) fn second_order(
        &mut self,
        method: Method,
        system: &mut impl SecondOrder<f64, Error: Display>,
        state: &mut State,
        reading: &mut dyn Reading,
    ) -> Result<(), String> {
        let mut system = AnyField(system as &mut dyn SecondOrderWithText);
        match method {
            Method::Nystrom86 { tolerance } => {
                let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
                self.nystrom(&mut Nystrom86::new(tolerance), &mut system, state, reading)
            }
            Method::Nystrom1210 { tolerance } => {
                let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
                self.nystrom(&mut Nystrom1210::new(tolerance), &mut system, state, reading)
            }
            other => Err(format!("{other} is no Nyström pair")),
        }
    }

    fn nystrom<P: NystromPair>(
        &mut self,
        method: &mut Nystrom<P>,
        system: &mut AnyField<dyn SecondOrderWithText + '_>,
        state: &mut State,
        reading: &mut dyn Reading,
    ) -> Result<(), String> {
        self.landing_by_landing(state, reading, &mut |driver, state, landing, reading, between| {
            let mut dense = Ok(());
            let result =
                method.integrate(system, state, landing, |step| driver.pass(step, reading, between, &mut dense));
            (result, dense)
        })
    }

    fn adaptive<P: RungeKuttaPair>(
        &mut self,
        method: &mut RungeKutta<P>,
        field: &mut AnyField<dyn FieldWithText + '_>,
        state: &mut State,
        reading: &mut dyn Reading,
    ) -> Result<(), String> {
        self.landing_by_landing(state, reading, &mut |driver, state, landing, reading, between| {
            let mut dense = Ok(());
            let result =
                method.integrate(field, state, landing, |step| driver.pass(step, reading, between, &mut dense));
            (result, dense)
        })
    }

    /// Records the instants that a step has passed, and the invariants at its end if there were some.
    fn pass(
        &mut self,
        step: &mut impl AdaptiveStep,
        reading: &mut dyn Reading,
        between: &mut [f64],
        dense: &mut Result<(), String>,
    ) -> ControlFlow<()> {
        let passed = self.next;
        while let Some(&instant) = self.instants.get(self.next) {
            let order = self.span.order(instant, step.time());
            if order.is_gt() {
                break;
            }
            if order.is_lt() {
                if let Err(error) = step.at(instant, between) {
                    *dense = Err(error);
                    return ControlFlow::Break(());
                }
                reading.record(instant, between, &mut self.history);
            } else {
                reading.record(instant, step.values(), &mut self.history);
            }
            self.next += 1;
        }
        if passed < self.next {
            let invariants = reading.invariants(step.time(), step.values());
            self.history.invariants.push(invariants);
        }
        self.step_done(step.time())
    }

    /// An adaptive method, from landing to landing.
    fn landing_by_landing(
        &mut self,
        state: &mut State,
        reading: &mut dyn Reading,
        advance: Landing<'_, 'o>,
    ) -> Result<(), String> {
        self.begin(state, reading);
        let mut between = state.values.clone();
        for landing in core::mem::take(&mut self.landings) {
            let steps_before = self.steps;
            let (result, dense) = advance(self, state, landing, reading, &mut between);
            self.time = state.time;
            match result {
                Ok(report) => self.report = self.report.then(report),
                Err(error) => {
                    self.report.steps += self.steps - steps_before;
                    return Err(error.to_string());
                }
            }
            dense?;
            if self.report.ending == Ending::Stopped {
                break;
            }
        }
        Ok(())
    }
}
