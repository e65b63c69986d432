//! Drives an integrator over the instants of a plan and records what it passes.
//!
//! Methods of fixed step land on every instant. The adaptive method lands on the instants of the reference, gives the
//! others by dense output, and shows invariants at the ends of its steps.

use core::fmt::Display;
use core::ops::ControlFlow;

use piola_integrators::{
    Composition, DormandPrince853, Ending, Field, GaussLegendre, Report, Separable, State, Tolerance,
};

use super::{History, Invariants, Progress};
use crate::model::{Scene, TimeSpan};
use crate::plan::{self, Method, Plan};

/// Reads everything that is recorded out of a state.
pub(super) trait Reading {
    /// Adds positions, velocities and coordinates of a state.
    fn record(&mut self, time: f64, values: &[f64], history: &mut History);
    /// The invariants of a state.
    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants;
}

pub(super) struct Driver<O> {
    history: History,
    report: Report,
    time: f64,
    span: TimeSpan,
    instants: Vec<f64>,
    /// The first instant that is not recorded yet.
    next: usize,
    landings: Vec<f64>,
    observer: O,
    steps: u64,
}

impl<O: FnMut(Progress) -> ControlFlow<()>> Driver<O> {
    pub(super) fn new(scene: &Scene, plan: &Plan, observer: O) -> Self {
        let names = scene.names().into_iter().map(str::to_string).collect();
        let mut landings = plan::reference_times(scene).to_vec();
        landings.push(plan.end);
        landings.retain(|t| scene.time.order(plan.start, *t).is_lt());
        landings.dedup_by(|a, b| scene.time.order(*a, *b).is_eq());
        Self {
            history: History { names, ..History::default() },
            report: Report { steps: 0, rejected: 0, evaluations: 0, ending: Ending::Reached },
            time: plan.start,
            span: scene.time,
            instants: plan::instants(scene),
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
    fn begin(&mut self, state: &State, reading: &mut impl Reading) {
        reading.record(state.time, &state.values, &mut self.history);
        let invariants = reading.invariants(state.time, &state.values);
        self.history.invariants.push(invariants);
        while self.instants.get(self.next).is_some_and(|t| self.span.order(*t, self.span.start).is_le()) {
            self.next += 1;
        }
    }

    /// A method of fixed step, from instant to instant.
    fn fixed<E: Display>(
        &mut self,
        state: &mut State,
        reading: &mut impl Reading,
        mut advance: impl FnMut(&mut Self, &mut State, f64) -> Result<Report, E>,
    ) -> Result<(), String> {
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
    pub(super) fn separable<F: Separable>(
        &mut self,
        method: &mut Composition,
        field: &mut F,
        state: &mut State,
        reading: &mut impl Reading,
    ) -> Result<(), String>
    where
        F::Error: Display,
    {
        self.fixed(state, reading, |driver, state, instant| {
            method.integrate(field, state, instant, |step| driver.step_done(step.time))
        })
    }

    /// Any other method.
    pub(super) fn field<F: Field>(
        &mut self,
        plan: &Plan,
        field: &mut F,
        state: &mut State,
        reading: &mut impl Reading,
    ) -> Result<(), String>
    where
        F::Error: Display,
    {
        match plan.method {
            Method::GaussLegendre { order, step } => {
                let mut method = GaussLegendre::new(order, step).map_err(|error| error.to_string())?;
                self.fixed(state, reading, |driver, state, instant| {
                    method.integrate(field, state, instant, |step| driver.step_done(step.time))
                })
            }
            Method::DormandPrince { tolerance } => {
                let tolerance = Tolerance::relative(tolerance).map_err(|error| error.to_string())?;
                self.adaptive(&mut DormandPrince853::new(tolerance), field, state, reading)
            }
            Method::Composition { .. } => {
                Err("an explicit composition needs forces that depend on positions alone".to_string())
            }
        }
    }

    fn adaptive<F: Field>(
        &mut self,
        method: &mut DormandPrince853,
        field: &mut F,
        state: &mut State,
        reading: &mut impl Reading,
    ) -> Result<(), String>
    where
        F::Error: Display,
    {
        self.begin(state, reading);
        let mut between = state.values.clone();
        for landing in core::mem::take(&mut self.landings) {
            let steps_before = self.steps;
            let mut dense = Ok(());
            let result = method.integrate(field, state, landing, |step| {
                let passed = self.next;
                while let Some(&instant) = self.instants.get(self.next) {
                    let order = self.span.order(instant, step.time());
                    if order.is_gt() {
                        break;
                    }
                    if order.is_lt() {
                        if let Err(error) = step.at(instant, &mut between) {
                            dense = Err(error.to_string());
                            return ControlFlow::Break(());
                        }
                        reading.record(instant, &between, &mut self.history);
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
            });
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
