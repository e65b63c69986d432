//! A run in democratic heliocentric coordinates, with or without close encounters.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::internal::equal_steps;
use piola_integrators::{Checkpoint, Ending, IntegratorsError, Report, State, Step};
use piola_numerics::Real;

use super::alternation::Parts;
use super::planets::{PlanetMasses, Planets};
use super::{Splitting, check};
use crate::checkpoint::count_of;
use crate::kepler::Increment;
use crate::{Gravitation, GravitationError};

/// Why a run ends early.
pub(crate) type Failure = IntegratorsError<GravitationError>;

/// Treatment of planets that come near each other.
pub(crate) trait Near<T> {
    /// The name of the method in a checkpoint.
    const NAME: &'static str;

    /// |d|⁻³ times the part of an attraction between two planets that Kepler's motions leave out.
    fn weight(&self, first: usize, second: usize, distance: [T; 3]) -> T;

    /// Corrects the Keplerian increments of planets that come near each other in a motion.
    fn correct(
        &mut self,
        masses: &PlanetMasses,
        planets: &Planets<T>,
        time: f64,
        moment: Moment,
        increments: &mut [Increment<T>],
    ) -> Result<(), Failure>;

    /// Ends a step.
    fn end_step(&mut self) {}

    /// How many numbers are saved.
    fn numbers(&self) -> usize {
        0
    }

    /// What the next motions depend on, for a checkpoint.
    fn saved(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Takes back what was saved.
    fn restore(&mut self, _saved: &[f64]) {}
}

/// When a motion starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    /// The time at the start, s.
    pub(crate) t: f64,
    /// Whether the motion is one of the run, not one of a corrector or of a state that is shown.
    pub(crate) is_of_run: bool,
}

/// The steps of a run and their order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Course {
    pub(crate) step: f64,
    pub(crate) splitting: Splitting,
}

/// The equal steps of one run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EqualSteps {
    pub(crate) start: f64,
    pub(crate) end: f64,
    /// Steps of the run before these.
    pub(crate) before: u64,
    /// How many there are with those before.
    pub(crate) count: u64,
    /// The length of each, s; negative in a run backwards.
    pub(crate) length: f64,
}

impl EqualSteps {
    /// Seconds from the start of these steps to the end of a step of the run.
    pub(crate) fn elapsed(&self, steps: u64) -> f64 {
        self.length * (steps - self.before) as f64
    }

    /// The time after so many steps of the run; after the last, exactly the end.
    pub(crate) fn time(&self, steps: u64) -> f64 {
        if steps == self.count { self.end } else { self.start + self.elapsed(steps) }
    }
}

/// A run where it ended.
pub(crate) struct Ended<C> {
    pub(crate) report: Report,
    pub(crate) steps: EqualSteps,
    /// What continues the run; without it the run begins anew from the state.
    pub(crate) coordinates: Option<C>,
}

impl<C> Ended<C> {
    /// The checkpoint, with the coordinates as `memory`.
    pub(crate) fn checkpoint<T: Real>(
        &self,
        method: &'static str,
        splitting: Splitting,
        state: &State<T>,
        memory: Vec<T>,
        others: &[f64],
    ) -> Checkpoint<T> {
        let Self { report, steps, coordinates } = self;
        let made = (report.steps - steps.before) as f64;
        let continues = f64::from(u8::from(coordinates.is_some()));
        let of_steps = [steps.start, steps.length, made, continues, splitting.number() as f64];
        Checkpoint::of(method, state.clone(), *report, memory, [&of_steps[..], others].concat())
    }
}

impl Course {
    pub(crate) const fn new(step: f64, splitting: Splitting) -> Result<Self, IntegratorsError> {
        if !(0.0 < step && step < f64::INFINITY) {
            return Err(IntegratorsError::InvalidStep { step });
        }
        Ok(Self { step, splitting })
    }

    /// The longest time of one attraction in a step, s.
    pub(crate) fn longest_attraction(self) -> f64 {
        self.splitting.stages().attractions.iter().fold(0.0, |longest, part| part.abs().max(longest)) * self.step
    }

    /// The equal steps from a state to `end`, after the checks that every run begins with.
    pub(crate) fn begin<T: Real>(
        self,
        bodies: &Gravitation,
        state: &State<T>,
        end: f64,
    ) -> Result<EqualSteps, Failure> {
        let start = state.time;
        check(bodies, &state.values).map_err(|source| IntegratorsError::Field { t: start, source })?;
        if !(end.is_finite() && start.is_finite()) {
            let (quantity, value) = if start.is_finite() { ("end", end) } else { ("t", start) };
            return Err(IntegratorsError::NotFinite { quantity, index: 0, value, t: None });
        }
        let (count, length) = equal_steps(start, end, self.step)?;
        Ok(EqualSteps { start, end, before: 0, count, length })
    }

    /// Integrates to `end` in equal steps; from a checkpoint if there is one. The observer sees every `shown`-th step and
    /// the last.
    pub(crate) fn integrate<T: Real, N: Near<T>>(
        self,
        near: &mut N,
        bodies: &Gravitation,
        resumed: Option<&Checkpoint<T>>,
        (state, end): (&mut State<T>, f64),
        shown: u64,
        mut observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Ended<Planets<T>>, Failure> {
        let lengths = [Planets::<T>::numbers(bodies.bodies()), near.numbers()];
        let (steps, saved) = match resumed {
            None => (self.begin(bodies, state, end)?, None),
            Some(checkpoint) => open(checkpoint, N::NAME, lengths, self, bodies, state, end)?,
        };
        let mut report = resumed.map_or(Report::begin(), |checkpoint| checkpoint.report().continued());
        if let Some(checkpoint) = resumed {
            // Also where the steps differ: radii and encounters are those of the whole run.
            near.restore(&checkpoint.memory().1[OF_STEPS..]);
        }
        if steps.count == report.steps {
            return Ok(Ended { report, steps, coordinates: None });
        }
        let (count, h) = (steps.count, steps.length);
        let mut run = Run::new(near, bodies.parameters(), &state.values, h, self.splitting);
        let mut values = state.values.clone();
        let time = |number: u64| steps.time(number);
        // The steps after which the state is `values`.
        let first = report.steps;
        let mut reached = first;
        let mut failure = match saved {
            None => run.enter(state.time).err(),
            Some(memory) => {
                run.planets.restore(memory);
                run.is_ahead = true;
                None
            }
        };
        while failure.is_none() && report.steps < count {
            run.spare.copy(&run.planets);
            if let Err(error) = run.step(time(report.steps), report.steps + 1 < count) {
                run.planets.copy(&run.spare);
                run.is_ahead = true;
                failure = Some(error);
                break;
            }
            report.steps += 1;
            report.evaluations += self.splitting.attractions() as u64;
            let number = report.steps;
            if number < count && (shown == 0 || !number.is_multiple_of(shown)) {
                continue;
            }
            if let Err(error) = run.show(steps.elapsed(number), time(number), &mut values) {
                failure = Some(error);
                break;
            }
            reached = number;
            if observer(Step { number, time: time(number), values: &values }).is_break() {
                report.ending = Ending::Stopped;
                break;
            }
        }
        // Where the last good step cannot be shown, the state is the one that was shown last.
        let last = report.steps;
        if reached < last && run.show(steps.elapsed(last), time(last), &mut values).is_ok() {
            reached = last;
        }
        if first < reached {
            *state = State::new(time(reached), values).map_err(IntegratorsError::with_field_error)?;
        }
        match failure {
            None => Ok(Ended { report, steps, coordinates: run.is_ahead.then_some(run.planets) }),
            Some(error) => Err(error),
        }
    }

    /// The checkpoint of a run that [`integrate`](Self::integrate) has made, with its report.
    pub(crate) fn checkpoint<T: Real, N: Near<T>>(
        self,
        near: &N,
        bodies: &Gravitation,
        state: &State<T>,
        ended: &Ended<Planets<T>>,
    ) -> Checkpoint<T> {
        let nothing = || vec![T::zero(); Planets::<T>::numbers(bodies.bodies())];
        let memory = ended.coordinates.as_ref().map_or_else(nothing, Planets::saved);
        ended.checkpoint(N::NAME, self.splitting, state, memory, &near.saved())
    }
}

/// The numbers that all maps keep: when the steps began, their length, how many are made, whether the memory continues them,
/// and the number of the splitting.
pub(crate) const OF_STEPS: usize = 5;

/// The steps of a run that goes on to `end`, and its memory if they are those of the checkpoint. The state becomes that of the checkpoint.
pub(crate) fn open<'a, T: Real>(
    checkpoint: &'a Checkpoint<T>,
    method: &'static str,
    [memory, others]: [usize; 2],
    course: Course,
    bodies: &Gravitation,
    state: &mut State<T>,
    end: f64,
) -> Result<(EqualSteps, Option<&'a [T]>), Failure> {
    let mut opened = checkpoint.state().clone();
    checkpoint.open(method, [memory, OF_STEPS + others], &[], &mut opened, |opened| {
        check(bodies, &opened.values).map_err(|source| IntegratorsError::Field { t: opened.time, source })
    })?;
    let (memory, numbers) = checkpoint.memory();
    let report = checkpoint.report();
    let [begun, length, made, continues, splitting] = [0, 1, 2, 3, 4].map(|index| numbers[index]);
    course.splitting.check_number(splitting)?;
    if 0.0 < continues
        && end.is_finite()
        && let Ok((count, h)) = equal_steps::<Infallible>(begun, end, course.step)
        && h.to_bits() == length.to_bits()
        && made < count as f64
    {
        *state = opened;
        let before = report.steps.saturating_sub(count_of(made));
        return Ok((
            EqualSteps { start: begun, end, count: before.saturating_add(count), length, before },
            Some(memory),
        ));
    }
    let anew = course.begin(bodies, &opened, end)?;
    *state = opened;
    let before = report.steps;
    Ok((EqualSteps { count: before.saturating_add(anew.count), before, ..anew }, None))
}

/// A run: between steps it stands after the first motion of the next one, at last at the end of the last one.
struct Run<'a, T, N> {
    masses: PlanetMasses,
    planets: Planets<T>,
    /// Copy of the state before the last step, also used to show a state.
    spare: Planets<T>,
    increments: Vec<Increment<T>>,
    accelerations: Vec<[T; 3]>,
    near: &'a mut N,
    step: f64,
    splitting: Splitting,
    moment: Moment,
    /// Whether the first motion of the next step is made.
    is_ahead: bool,
}

impl<'a, T: Real, N: Near<T>> Run<'a, T, N> {
    fn new(near: &'a mut N, parameters: &[f64], state: &[T], step: f64, splitting: Splitting) -> Self {
        let masses = PlanetMasses::new(parameters);
        let planets = Planets::new(&masses, state);
        let (spare, zero) = (planets.clone(), [T::zero(); 3]);
        let increments = vec![Increment { position: zero, velocity: zero }; planets.planets.len()];
        let accelerations = vec![zero; planets.planets.len()];
        Self {
            masses,
            planets,
            spare,
            increments,
            accelerations,
            near,
            step,
            splitting,
            moment: Moment { t: 0.0, is_of_run: false },
            is_ahead: false,
        }
    }

    fn enter(&mut self, start: f64) -> Result<(), Failure> {
        let (splitting, step) = (self.splitting, self.step);
        self.moment = Moment { t: start, is_of_run: false };
        self.correct(splitting.corrector(), step, false)?;
        self.moment = Moment { t: start, is_of_run: true };
        self.is_ahead = true;
        self.motion(splitting.stages().motions[0] * step)
    }

    /// Makes a step that begins at a time, and the first motion of the next one if the run goes on.
    fn step(&mut self, start: f64, goes_on: bool) -> Result<(), Failure> {
        let (stages, step) = (self.splitting.stages(), self.step);
        self.moment = Moment { t: start + stages.motions[0] * step, is_of_run: true };
        Parts::step(self, step, stages, goes_on)?;
        self.is_ahead = goes_on;
        self.near.end_step();
        match self.planets.not_finite() {
            None => Ok(()),
            Some((index, value)) => {
                Err(IntegratorsError::NotFinite { quantity: "state", index, value, t: Some(start) })
            }
        }
    }

    /// Writes the state at the time t, so many seconds after the start.
    fn show(&mut self, elapsed: f64, t: f64, values: &mut [T]) -> Result<(), Failure> {
        self.spare.copy(&self.planets);
        let made = self.end_of_step(t);
        if made.is_ok() {
            self.planets.write(&self.masses, elapsed, values);
        }
        core::mem::swap(&mut self.planets, &mut self.spare);
        made
    }

    /// Moves back to the end of the step, and takes the corrector back.
    fn end_of_step(&mut self, t: f64) -> Result<(), Failure> {
        let (splitting, step) = (self.splitting, self.step);
        self.moment = Moment { t, is_of_run: false };
        if self.is_ahead {
            self.motion(-splitting.stages().motions[0] * step)?;
        }
        self.correct(splitting.corrector(), step, true)?;
        match self.planets.not_finite() {
            None => Ok(()),
            Some((index, value)) => Err(IntegratorsError::NotFinite { quantity: "state", index, value, t: Some(t) }),
        }
    }
}

impl<T: Real, N: Near<T>> Parts for Run<'_, T, N> {
    type Error = Failure;

    fn motion(&mut self, time: f64) -> Result<(), Failure> {
        self.planets.keplerian(&self.masses, time, &mut self.increments);
        self.near.correct(&self.masses, &self.planets, time, self.moment, &mut self.increments)?;
        self.planets.add(&self.increments);
        self.moment.t += time;
        Ok(())
    }

    fn attraction(&mut self, time: f64) {
        let near = &*self.near;
        let weight = |first: usize, second: usize, d: [T; 3]| near.weight(first, second, d);
        self.planets.attract(&self.masses, time, &weight, &mut self.accelerations);
    }
}
