//! Drives an integrator over the instants of a timetable and records what it passes.
//!
//! Methods of fixed step land on every instant. The adaptive method lands on the landings of the timetable, gives the
//! other instants by dense output, and shows invariants at the ends of its steps.

use core::fmt::Display;
use core::ops::ControlFlow;
use std::rc::Rc;

use piola_integrators::{
    Checkpoint, Composition, DormandPrince853, Ending, Field, GaussLegendre, IntegratorsError, Nystrom, Nystrom86,
    Nystrom1210, NystromPair, Report, RungeKutta, RungeKuttaPair, SecondOrder, Separable, State, Tolerance, Verner98,
};

use super::any_field::{AdaptiveStep, AnyField, FieldWithText, SecondOrderWithText, SeparableWithText};
use super::checkpoint::{CheckpointKeeper, Marks, MotionCheckpoint, MotionCheckpointBody, Part, Sealed, Stage};
use super::memory::Memory;
use super::{History, Invariants, Method, Progress, TimeSpan, Timetable};
use crate::SimulationError;

/// Reads everything that is recorded out of a state.
pub(super) trait Reading {
    /// Adds positions, velocities and coordinates of a state.
    fn record(&mut self, time: f64, values: &[f64], history: &mut History);
    /// The invariants of a state.
    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants;
}

/// The observer of a run: it sees the progress after every step and may stop the run.
pub(super) type Observer<'o> = &'o mut (dyn FnMut(Progress) -> ControlFlow<()> + 'o);

/// Takes a driver and a state to an instant.
type Advance<'a, 'o> = &'a mut dyn FnMut(&mut Driver<'o>, &mut State, f64) -> Result<Report, IntegratorsError<String>>;

/// Takes a driver and a state to a landing, from a checkpoint if there is one; also whether dense output failed.
type Landing<'a, 'o> = &'a mut dyn FnMut(
    &mut Driver<'o>,
    Option<&Checkpoint>,
    &mut State,
    f64,
    &mut dyn Reading,
    &mut [f64],
) -> (Result<Report, IntegratorsError<String>>, Result<(), String>);

/// Steps after which a method of fixed step between two instants, or a motion with a memory, begins anew from the state alone. A run
/// may be continued from there, and it takes the same steps if it is not.
const PIECE: u32 = 1000;

/// A run with a memory where it began anew.
struct Piece {
    state: State,
    report: Report,
    steps: u64,
    next: usize,
    landing: usize,
    /// Recorded instants and invariants.
    recorded: [usize; 2],
    passed: Vec<(f64, String)>,
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
    /// The landing that the run is on its way to.
    landing: usize,
    observer: Observer<'o>,
    steps: u64,
    /// Steps left of a piece.
    left: u32,
    /// Whether the observer has stopped the run.
    stopped: bool,
    keeper: Option<Keeper<'o>>,
    resumed: Option<MotionCheckpoint>,
    /// Islands before this one, for its checkpoints.
    done: Vec<Part>,
    /// What the motion remembers besides its state.
    memory: Option<Rc<Memory>>,
}

/// Who keeps the checkpoints of a run, and the marks that they bear.
pub(super) type Keeper<'o> = (&'o mut dyn CheckpointKeeper, Marks);

impl<'o> Driver<'o> {
    pub(super) fn new(
        names: Vec<String>,
        timetable: &Timetable,
        observer: Observer<'o>,
        (keeper, resumed): (Option<Keeper<'o>>, Option<MotionCheckpoint>),
    ) -> Self {
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
            landing: 0,
            observer,
            steps: 0,
            left: PIECE,
            stopped: false,
            keeper,
            resumed,
            done: Vec::new(),
            memory: None,
        }
    }

    /// The motion remembers more than its state: it is to begin anew now and then.
    pub(super) fn remember(&mut self, memory: Rc<Memory>) {
        self.memory = Some(memory);
    }

    /// The driver of an island, after others that are done.
    pub(super) fn after(self, done: Vec<Part>) -> Self {
        Self { done, ..self }
    }

    pub(super) fn start(&self) -> f64 {
        self.span.start
    }

    pub(super) fn span(&self) -> TimeSpan {
        self.span
    }

    pub(super) fn history(&mut self) -> &mut History {
        &mut self.history
    }

    /// What was integrated, and the islands before it.
    pub(super) fn finish(self) -> (Part, Vec<Part>) {
        (Part { history: self.history, report: self.report, time: self.time }, self.done)
    }

    fn step_done(&mut self, time: f64) -> ControlFlow<()> {
        self.steps += 1;
        self.time = time;
        let fraction = ((time - self.span.start) / (self.span.end - self.span.start)).clamp(0.0, 1.0);
        let going = (self.observer)(Progress { time, fraction, steps: self.steps });
        self.stopped = going.is_break();
        going
    }

    /// A step of a fixed-step method, which ends a piece now and then.
    fn fixed_step_done(&mut self, time: f64) -> ControlFlow<()> {
        self.left = self.left.saturating_sub(1);
        let going = self.step_done(time);
        if self.left == 0 { ControlFlow::Break(()) } else { going }
    }

    /// Hands a checkpoint to the keeper if one is due or the run is stopped.
    fn keep(&mut self, stage: impl FnOnce() -> Stage) {
        if self.keeper.as_mut().is_some_and(|(keeper, _)| self.stopped || keeper.is_due()) {
            self.hand_over(stage(), self.report, self.steps);
        }
    }

    /// Hands a checkpoint to the keeper.
    fn hand_over(&mut self, stage: Stage, report: Report, steps: u64) {
        let Some((keeper, marks)) = &mut self.keeper else { return };
        let (marks, history) = (marks.clone(), core::mem::take(&mut self.history));
        let (next, landing, done) = (self.next, self.landing, core::mem::take(&mut self.done));
        let body = MotionCheckpointBody { stage, report, steps, next, landing, history, done };
        let checkpoint = MotionCheckpoint::new(marks, body);
        keeper.keep(&checkpoint);
        (self.history, self.done) = (checkpoint.0.body.history, checkpoint.0.body.done);
    }

    /// Records the state at the start, or takes up what a checkpoint holds.
    fn begin(&mut self, state: &mut State, reading: &mut dyn Reading) -> Option<Checkpoint> {
        if let Some(MotionCheckpoint(Sealed { body, .. })) = self.resumed.take() {
            let MotionCheckpointBody { stage, report, steps, next, landing, history, .. } = body;
            (self.report, self.steps, self.next, self.landing, self.history) = (report, steps, next, landing, history);
            let checkpoint = match stage {
                Stage::Fixed(resumed) => {
                    *state = resumed;
                    None
                }
                Stage::Adaptive(checkpoint) => {
                    state.clone_from(checkpoint.state());
                    Some(checkpoint)
                }
            };
            self.time = state.time;
            if let Some(memory) = &self.memory {
                memory.passed.replace(self.history.singular_positions.clone());
            }
            return checkpoint;
        }
        reading.record(state.time, &state.values, &mut self.history);
        let invariants = reading.invariants(state.time, &state.values);
        self.history.invariants.push(invariants);
        while self.instants.get(self.next).is_some_and(|t| self.span.order(*t, self.span.start).is_le()) {
            self.next += 1;
        }
        None
    }

    /// A method of fixed step, from instant to instant.
    fn fixed(&mut self, state: &mut State, reading: &mut dyn Reading, advance: Advance<'_, 'o>) -> Result<(), String> {
        self.begin(state, reading);
        while let Some(&instant) = self.instants.get(self.next) {
            let (steps_before, report_before) = (self.steps, self.report);
            let state_before = self.keeper.is_some().then(|| state.clone());
            self.left = PIECE;
            let result = advance(self, state, instant);
            self.time = state.time;
            match result {
                Ok(report) => self.report = self.report.then(report),
                Err(error) => {
                    self.report.steps += self.steps - steps_before;
                    return Err(error.to_string());
                }
            }
            if self.report.ending == Ending::Stopped && !self.stopped {
                self.keep(|| Stage::Fixed(state.clone()));
                continue;
            }
            // A run that is stopped within a piece goes on from the beginning of the piece.
            if self.report.ending == Ending::Stopped
                && let Some(before) = state_before
            {
                self.hand_over(Stage::Fixed(before), report_before, steps_before);
            }
            reading.record(state.time, &state.values, &mut self.history);
            let invariants = reading.invariants(state.time, &state.values);
            self.history.invariants.push(invariants);
            self.next += 1;
            if self.report.ending == Ending::Stopped {
                break;
            }
            self.keep(|| Stage::Fixed(state.clone()));
        }
        Ok(())
    }

    /// A closed form of the state, written by `at` for any time, from instant to instant. No force is evaluated; an instant
    /// counts as a step.
    pub(super) fn closed_form(
        &mut self,
        at: &mut dyn FnMut(f64, &mut [f64]),
        state: &mut State,
        reading: &mut dyn Reading,
    ) {
        self.begin(state, reading);
        while let Some(&instant) = self.instants.get(self.next) {
            at(instant, &mut state.values);
            state.time = instant;
            reading.record(instant, &state.values, &mut self.history);
            let invariants = reading.invariants(instant, &state.values);
            self.history.invariants.push(invariants);
            self.next += 1;
            self.report.steps += 1;
            let going = self.step_done(instant);
            self.keep(|| Stage::Fixed(state.clone()));
            if going.is_break() {
                self.report.ending = Ending::Stopped;
                break;
            }
        }
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
            method.integrate(&mut field, state, instant, |step| driver.fixed_step_done(step.time))
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
                    method.integrate(&mut field, state, instant, |step| driver.fixed_step_done(step.time))
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
            Method::ClosedForm => Err(SimulationError::NoClosedForm.to_string()),
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
        self.landing_by_landing(state, reading, &mut |driver, from, state, landing, reading, between| {
            let mut dense = Ok(());
            let result = method
                .integrate_from(system, from, state, landing, |step| driver.pass(step, reading, between, &mut dense));
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
        self.landing_by_landing(state, reading, &mut |driver, from, state, landing, reading, between| {
            let mut dense = Ok(());
            let result = method
                .integrate_from(field, from, state, landing, |step| driver.pass(step, reading, between, &mut dense));
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
        let Some(memory) = self.memory.clone() else {
            let going = self.step_done(step.time());
            self.keep(|| Stage::Adaptive(step.checkpoint()));
            return going;
        };
        self.left = self.left.saturating_sub(1);
        let going = self.step_done(step.time());
        if self.left == 0 && memory.apart.get() { ControlFlow::Break(()) } else { going }
    }

    /// Where a run with a memory begins anew.
    fn piece(&self, state: &State) -> Option<Piece> {
        let memory = self.memory.as_ref().filter(|_| self.keeper.is_some())?;
        let Self { report, steps, next, landing, history, .. } = self;
        Some(Piece {
            state: state.clone(),
            report: *report,
            steps: *steps,
            next: *next,
            landing: *landing,
            recorded: [history.times.len(), history.invariants.len()],
            passed: memory.passed.borrow().clone(),
        })
    }

    /// Hands over the checkpoint of a run that is stopped within a piece: that of its beginning.
    fn hand_over_piece(&mut self, piece: Piece) {
        let now = (self.history.clone(), self.next, self.landing);
        self.history.truncate(piece.recorded);
        self.history.singular_positions = piece.passed;
        (self.next, self.landing) = (piece.next, piece.landing);
        self.hand_over(Stage::Fixed(piece.state), piece.report, piece.steps);
        (self.history, self.next, self.landing) = now;
    }

    /// An adaptive method, from landing to landing.
    fn landing_by_landing(
        &mut self,
        state: &mut State,
        reading: &mut dyn Reading,
        advance: Landing<'_, 'o>,
    ) -> Result<(), String> {
        let mut from = self.begin(state, reading);
        let mut between = state.values.clone();
        let mut piece = self.piece(state);
        while let Some(&landing) = self.landings.get(self.landing) {
            let steps_before = self.steps;
            let from = from.take();
            let behind = from.as_ref().map_or(0, |from| from.report().steps);
            let (result, dense) = advance(self, from.as_ref(), state, landing, reading, &mut between);
            self.time = state.time;
            match result {
                Ok(report) => self.report = self.report.then(report),
                Err(error) => {
                    self.report.steps += behind + self.steps - steps_before;
                    return Err(error.to_string());
                }
            }
            dense?;
            if let (Ending::Stopped, Some(memory)) = (self.report.ending, &self.memory) {
                if self.stopped {
                    piece.take().into_iter().for_each(|piece| self.hand_over_piece(piece));
                    break;
                }
                memory.renew.set(true);
                self.history.singular_positions.clone_from(&memory.passed.borrow());
                self.left = PIECE;
                self.keep(|| Stage::Fixed(state.clone()));
                piece = self.piece(state);
                continue;
            }
            if self.report.ending == Ending::Stopped {
                break;
            }
            self.landing += 1;
        }
        Ok(())
    }
}
