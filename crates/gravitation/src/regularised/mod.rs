//! Few bodies through collisions and closest encounters: the logarithmic Hamiltonian along a chain.
//!
//! ```text
//! Λ = ln(T + B) − ln U        B = U − T, the binding energy, a constant
//! dt/ds = 1/(T + B)     dx/ds = v/(T + B)          drift: T is a constant of it
//!                       dv/ds = a/U                kick: U is a constant of it
//! ```
//!
//! On the way T + B = U: a step in s is short in time where the bodies are near. The leapfrog of the two maps follows a pair
//! on its exact orbit, only late or early, through a collision as through any other place; what a third body adds is smooth.
//! Gragg's extrapolation takes the leapfrog's error to rounding, with steps and orders of its own choice. Positions are kept
//! as vectors along a chain of nearest bodies, so that a close pair far from the origin keeps the digits of its distance.
//!
//! # Validity
//! Two to some twenty bodies, all with mass. The work of a step grows as the square of their number; for planets about a
//! central body [`wisdom_holman`](crate::wisdom_holman) is faster.
//!
//! # Example
//! ```
//! use piola_gravitation::Gravitation;
//! use piola_gravitation::regularised::Regularised;
//! use piola_integrators::State;
//! // Two equal bodies fall from rest at a distance of 2 into each other, and come back after 2π √(a³/2) = 2π/√2 with a = 1.
//! let pair = Gravitation::new(vec![1.0, 1.0])?;
//! let start = pair.state(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], &[[0.0; 3]; 2])?;
//! let mut state = State::new(0.0, start)?;
//! let period = 2.0_f64.sqrt() * std::f64::consts::PI;
//! Regularised::to_rounding().integrate_to(&pair, &mut state, 10.0 * period)?;
//! assert!((pair.position(&state.values, 0)[0] - 1.0).abs() < 1e-11);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # References
//! S. Mikkola & K. Tanikawa, Celest. Mech. Dyn. Astron. 74 (1999) 287; M. Preto & S. Tremaine, Astron. J. 118 (1999) 2532;
//! S. Mikkola & S. J. Aarseth, Celest. Mech. Dyn. Astron. 57 (1993) 439 (the chain).

mod chain;
mod extrapolation;
mod leapfrog;
mod saved;

use core::ops::ControlFlow;

use piola_integrators::internal::compensated_add;
use piola_integrators::{Checkpoint, Ending, IntegratorsError, Report, State, Step, Tolerance, unobserved};
use piola_numerics::Real;

use crate::check::{check_finite, check_length};
use crate::{Gravitation, GravitationError};
use chain::{Chain, squared};
use extrapolation::{Aim, ROWS, SUBSTEPS, Verdict};
use leapfrog::{Bodies, Increments, Memory};

/// Extrapolation of the leapfrog of the logarithmic Hamiltonian, with adaptive steps.
///
/// # Accuracy
/// The tolerance is that of a step, relative to each link of the chain and to its rate. A tolerance below 10⁻¹⁴ is raised to
/// that.
///
/// # Example
/// See the [module](self).
#[doc(alias("LogH", "ARCHAIN", "algorithmic regularisation"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regularised {
    tolerance: f64,
    most_steps: u64,
}

/// The least tolerance: rounding of a step.
const LEAST_TOLERANCE: f64 = 1e-14;
/// The steps after which a run is given up, unless it is told otherwise.
const MOST_STEPS: u64 = 1_000_000_000;
/// Rejections after which a step is given up.
const MOST_REJECTIONS: u32 = 200;

impl Regularised {
    /// Steps to a tolerance.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        let tolerance = tolerance.relative_part().max(tolerance.absolute_part()).max(LEAST_TOLERANCE);
        Self { tolerance, most_steps: MOST_STEPS }
    }

    /// Steps whose error is that of rounding.
    #[must_use]
    pub const fn to_rounding() -> Self {
        Self { tolerance: LEAST_TOLERANCE, most_steps: MOST_STEPS }
    }

    /// Gives up after so many steps.
    #[must_use]
    pub const fn with_most_steps(mut self, steps: u64) -> Self {
        self.most_steps = steps;
        self
    }

    /// Integrates to `end`, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<GravitationError>> {
        self.integrate(bodies, state, end, unobserved)
    }

    /// Integrates to `end`; backwards if `end` is earlier than the state's time. The observer sees every step and may stop
    /// the run.
    ///
    /// Over `Dual` the end has the derivatives at the given time; a step on the way has those at a fictitious time, which the
    /// step length fixes.
    ///
    /// # Errors
    /// [`IntegratorsError::Field`] where the bodies are not such ([`GravitationError::NotRegularisable`]) or the state is not
    /// theirs; [`IntegratorsError::StepTooSmall`] and [`IntegratorsError::TooManySteps`]: the state then stands at the last
    /// accepted step. Scalars of several lanes do not compile: each lane has its own time.
    pub fn integrate<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<GravitationError>> {
        Ok(self.run(bodies, None, state, end, observer)?.report)
    }

    /// Integrates as [`integrate`](Self::integrate). Returns also the run where it ended or where the observer stopped it, which
    /// [`resume`](Self::resume) continues.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to_checkpoint<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<(Report, Checkpoint<T>), IntegratorsError<GravitationError>> {
        Ok(self.run(bodies, None, state, end, observer)?.checkpoint(state))
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings and bodies: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit. It goes on to any other end in the same direction; the
    /// other way it begins anew from the state of the checkpoint.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method,
    /// [`IntegratorsError::WrongLength`] for one of other bodies, [`IntegratorsError::NotFinite`], [`IntegratorsError::InvalidRow`] where
    /// its chain is not an order of the bodies. A refused checkpoint leaves the state unchanged.
    pub fn resume<T: Real>(
        &self,
        bodies: &Gravitation,
        checkpoint: &Checkpoint<T>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<(Report, Checkpoint<T>), IntegratorsError<GravitationError>> {
        Ok(self.run(bodies, Some(checkpoint), state, end, observer)?.checkpoint(state))
    }

    fn run<T: Real>(
        &self,
        bodies: &Gravitation,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Ended<T>, IntegratorsError<GravitationError>> {
        const { assert!(T::LANES == 1, "each lane has its own time") };
        let of_bodies = |state: &State<T>| {
            check(bodies, &state.values).map_err(|source| IntegratorsError::Field { t: state.time, source })
        };
        if !end.is_finite() {
            return Err(IntegratorsError::NotFinite { quantity: "end", index: 0, value: end, t: None });
        }
        match resumed {
            None => of_bodies(state)?,
            Some(checkpoint) => saved::check(checkpoint, bodies.bodies(), state, of_bodies)?,
        }
        let mut report = resumed.map_or(Report::begin(), |checkpoint| checkpoint.report().continued());
        let is_there = (end - state.time).abs() <= 0.0;
        let direction = match resumed {
            Some(checkpoint) if is_there => saved::direction(checkpoint),
            _ => (end - state.time).signum(),
        };
        let mut start = state.time;
        let mut run = Run::new(bodies, &state.values, self.tolerance, direction);
        if let Some(checkpoint) = resumed
            && let Some(begun) = run.restore(checkpoint, direction)
        {
            start = begun;
        }
        let span = end - start;
        if is_there {
            return Ok(Ended { run, start, report });
        }
        let mut values = state.values.clone();
        let error = loop {
            if self.most_steps <= report.steps {
                break IntegratorsError::TooManySteps { t: start + run.elapsed(), steps: report.steps };
            }
            let is_last = match run.step(span, &mut report) {
                Ok(is_last) => is_last,
                Err(step) => break IntegratorsError::StepTooSmall { t: start + run.elapsed(), step },
            };
            report.steps += 1;
            run.write(&mut values);
            let time = if is_last { end } else { start + run.elapsed() };
            let is_stopped = observer(Step { number: report.steps, time, values: &values }).is_break();
            if is_last || is_stopped {
                report.ending = if is_stopped { Ending::Stopped } else { Ending::Reached };
                *state = State::new(time, values).map_err(IntegratorsError::with_field_error)?;
                return Ok(Ended { run, start, report });
            }
        };
        run.write(&mut values);
        *state = State::new(start + run.elapsed(), values).map_err(IntegratorsError::with_field_error)?;
        Err(error)
    }
}

fn check<T: Real>(bodies: &Gravitation, values: &[T]) -> Result<(), GravitationError> {
    let found = if 0.0 < bodies.softening() {
        Some("softening is on")
    } else if bodies.post_newtonian().is_some() {
        Some("the post-Newtonian term is on")
    } else if bodies.bodies() < 2 {
        Some("there are fewer than two bodies")
    } else if bodies.parameters().iter().any(|&parameter| parameter <= 0.0) {
        Some("a body has no mass")
    } else {
        None
    };
    if let Some(found) = found {
        return Err(GravitationError::NotRegularisable { found });
    }
    check_length("state", 6 * bodies.bodies(), values.len())?;
    check_finite("state", values)?;
    let places: Vec<f64> = values.iter().map(|x| x.primal(0)).collect();
    match bodies.coincident(&places) {
        Some((first, second)) => Err(GravitationError::CoincidentBodies { first, second }),
        None => Ok(()),
    }
}

/// A run where it ended, and when it began.
struct Ended<T> {
    run: Run<T>,
    start: f64,
    report: Report,
}

impl<T: Real> Ended<T> {
    fn checkpoint(&self, state: &State<T>) -> (Report, Checkpoint<T>) {
        (self.report, self.run.checkpoint(self.start, state, self.report))
    }
}

/// A run.
struct Run<T> {
    parameters: Vec<T>,
    all: T,
    binding: T,
    chain: Chain<T>,
    memory: Memory<T>,
    /// Where the mass centre was at the start, and its velocity.
    centre: [[T; 3]; 2],
    /// Since the start, and what rounding left of it.
    time: [T; 2],
    aim: Aim,
    tolerance: f64,
    /// Of the last row: the extrapolations to each order.
    row: Vec<Increments<T>>,
    /// The leapfrog's own.
    plain: Increments<T>,
}

impl<T: Real> Run<T> {
    fn new(bodies: &Gravitation, state: &[T], tolerance: f64, direction: f64) -> Self {
        let n = bodies.bodies();
        let parameters: Vec<T> = bodies.parameters().iter().map(|&parameter| T::lit(parameter)).collect();
        let all = parameters.iter().fold(T::zero(), |sum, &parameter| sum + parameter);
        let centre = [0, 1].map(|half| {
            [0, 1, 2].map(|axis| {
                let values = &state[(3 * half + axis) * n..][..n];
                values.iter().zip(&parameters).fold(T::zero(), |sum, (&x, &parameter)| sum + parameter * x) / all
            })
        });
        let mut chain = Chain::new(n, state);
        chain.rebuild();
        let mut memory = Memory::new(n);
        let increments = Increments { links: vec![[T::zero(); 3]; 2 * (n - 1)], time: T::zero() };
        let (row, plain) = (vec![increments.clone(); ROWS], increments);
        let known = Bodies { parameters: &parameters, all, binding: T::zero() };
        let potential = known.attract(&chain, None, &mut memory);
        let binding = potential - known.kinetic(&chain, None, &mut memory);
        let step = direction * potential.primal(0) * shortest_time(bodies.parameters(), &chain);
        let (time, aim) = ([T::zero(); 2], Aim::new(tolerance, step));
        Self { parameters, all, binding, chain, memory, centre, time, aim, tolerance, row, plain }
    }

    /// Seconds since the start.
    fn elapsed(&self) -> f64 {
        self.time[0].primal(0)
    }

    /// Makes a step; true if it ends `span` seconds after the start. The step that failed is the error.
    fn step(&mut self, span: f64, report: &mut Report) -> Result<bool, f64> {
        let mut rejections = 0;
        let row = loop {
            let step = self.aim.step;
            match self.attempt(T::lit(step), report) {
                Ok(row) => break row,
                Err(row) => {
                    report.rejected += 1;
                    rejections += 1;
                    if rejections == MOST_REJECTIONS || step.abs() < f64::MIN_POSITIVE {
                        return Err(step);
                    }
                    self.aim.after_failure(row);
                }
            }
        };
        let direction = span.signum();
        let missing = |run: &Self, row: usize| (T::lit(span) - run.time[0]) - run.time[1] - run.row[row].time;
        let passes = missing(self, row).primal(0) * direction <= 0.0;
        if passes {
            self.shorten(row, &missing, report);
        } else {
            self.aim.after_success(row, 0 < rejections);
        }
        self.accept(row);
        if self.chain.is_stale() {
            self.chain.rebuild();
        }
        Ok(passes)
    }

    /// Rows of the extrapolation until one is good enough: its number; or that of the row that shows that none will be.
    fn attempt(&mut self, step: T, report: &mut Report) -> Result<usize, usize> {
        for row in 0..ROWS {
            let error = self.extrapolate(step, row, report) / self.tolerance;
            if row == 0 {
                continue;
            }
            // What is not finite is an error too large for any row.
            let error = if error.is_finite() { error } else { f64::MAX };
            match self.aim.judge(row, error, step.primal(0)) {
                Verdict::Accepted => return Ok(row),
                Verdict::Waiting => {}
                Verdict::Rejected => return Err(row),
            }
        }
        Err(ROWS - 1)
    }

    /// Adds a row; returns the change that its last entry makes, relative to the links.
    fn extrapolate(&mut self, step: T, row: usize, report: &mut Report) -> f64 {
        let bodies = Bodies { parameters: &self.parameters, all: self.all, binding: self.binding };
        bodies.leap(&self.chain, step, SUBSTEPS[row], &mut self.memory, &mut self.plain);
        report.evaluations += u64::from(SUBSTEPS[row]);
        for order in 0..row {
            let ratio = f64::from(SUBSTEPS[row]) / f64::from(SUBSTEPS[row - 1 - order]);
            let weight = T::lit(1.0 / (ratio * ratio - 1.0));
            let raise = |old: &mut T, new: &mut T| {
                let (lower, before) = (*new, *old);
                *old = lower;
                *new = lower + weight * (lower - before);
            };
            let (old, new) = (&mut self.row[order], &mut self.plain);
            raise(&mut old.time, &mut new.time);
            for (old, new) in old.links.iter_mut().zip(&mut new.links) {
                for (old, new) in old.iter_mut().zip(new) {
                    raise(old, new);
                }
            }
        }
        core::mem::swap(&mut self.row[row], &mut self.plain);
        if row == 0 { f64::INFINITY } else { self.change(row) }
    }

    /// The largest change of a link, of a rate or of the time that the last extrapolation of a row makes, relative to it.
    fn change(&self, row: usize) -> f64 {
        let (best, second) = (&self.row[row], &self.row[row - 1]);
        let mut largest = ((best.time - second.time).primal(0) / best.time.primal(0)).abs();
        for ((best, second), start) in best.links.iter().zip(&second.links).zip(&self.chain.vectors) {
            let change = squared(chain::difference(*best, *second));
            let size = squared(*start).max(squared(chain::total(*start, *best)));
            // NaN is to remain.
            let relative = (change / size.max(f64::MIN_POSITIVE)).sqrt();
            largest = if relative <= largest { largest } else { relative };
        }
        largest
    }

    /// Shortens the step that has passed the end, so that it ends there.
    fn shorten(&mut self, row: usize, missing: &impl Fn(&Self, usize) -> T, report: &mut Report) {
        let mut step = T::lit(self.aim.step);
        let mut more = T::ORDER;
        for _ in 0..30 {
            let late = missing(self, row);
            // dt/ds = 1/(T + B) at the end of the step.
            let bodies = Bodies { parameters: &self.parameters, all: self.all, binding: self.binding };
            let kinetic = bodies.kinetic(&self.chain, Some(&self.row[row]), &mut self.memory);
            step += late * (kinetic + self.binding);
            for row in 0..=row {
                self.extrapolate(step, row, report);
            }
            let rest = missing(self, row).primal(0).abs();
            if rest <= 4.0 * f64::EPSILON * self.row[row].time.primal(0).abs().max(self.elapsed().abs()) {
                if more == 0 {
                    break;
                }
                more -= 1;
            }
        }
        // The rest is some units in the last place of the time: along the velocities.
        let rest = missing(self, row);
        let links = self.chain.order.len() - 1;
        let (places, velocities) = self.row[row].links.split_at_mut(links);
        for ((place, velocity), start) in places.iter_mut().zip(velocities).zip(&self.chain.vectors[links..]) {
            for axis in 0..3 {
                place[axis] += rest * (start[axis] + velocity[axis]);
            }
        }
        self.row[row].time += rest;
    }

    fn accept(&mut self, row: usize) {
        let increments = &self.row[row];
        let links = self.chain.vectors.iter_mut().zip(&mut self.chain.carries).zip(&increments.links);
        for ((value, carry), increment) in links {
            for axis in 0..3 {
                compensated_add(&mut value[axis], &mut carry[axis], increment[axis]);
            }
        }
        let [time, carry] = &mut self.time;
        compensated_add(time, carry, increments.time);
    }

    fn write(&self, values: &mut [T]) {
        let (places, velocities) = values.split_at_mut(3 * self.parameters.len());
        let [place, velocity] = self.centre;
        let now = core::array::from_fn(|axis| place[axis] + self.time[0] * velocity[axis]);
        self.chain.write(0, &self.parameters, self.all, now, places);
        self.chain.write(1, &self.parameters, self.all, velocity, velocities);
    }
}

/// A tenth of the shortest time in which a link changes by its length, along its velocity or by its attraction.
fn shortest_time<T: Real>(parameters: &[f64], chain: &Chain<T>) -> f64 {
    let links = chain.order.len() - 1;
    let mut shortest = f64::INFINITY;
    for link in 0..links {
        let (distance, speed) = (squared(chain.vectors[link]).sqrt(), squared(chain.vectors[links + link]).sqrt());
        let parameter = parameters[chain.order[link]] + parameters[chain.order[link + 1]];
        shortest = shortest.min(distance / speed).min((distance.powi(3) / parameter).sqrt());
    }
    0.1 * shortest
}
