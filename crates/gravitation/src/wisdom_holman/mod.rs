//! Planets about one dominant body, by the map of Wisdom and Holman.
//!
//! ```text
//! H = Σᵢ [½ pᵢ′²/mᵢ′ − Gmᵢ ηᵢ₋₁/rᵢ′]                    Kepler's motions in Jacobi's coordinates, exact
//!   + Σᵢ Gmᵢ ηᵢ₋₁/rᵢ′ − Σᵢ﹤ⱼ Gmᵢ mⱼ/rᵢⱼ                 attractions between planets, smaller by ε = their mass/mass of the centre
//! ηᵢ = m₀ + … + mᵢ        xᵢ′ = xᵢ − (m₀ x₀ + … + mᵢ₋₁ xᵢ₋₁)/ηᵢ₋₁
//! ```
//!
//! A step alternates the exact motions of the two parts. The map is symplectic, so the energy does not drift but for rounding.
//! Ten to thirty steps in the shortest period suffice. [`Splitting`] names the sequences. Planets move eight at a time in lanes.
//!
//! # Validity
//! Orbits that do not cross: for others there are heliocentric coordinates ([`DemocraticHeliocentric`]). Where two planets come
//! within some Hill radii of each other, the second part is not small any more: take
//! [`HybridSymplectic`](crate::hybrid::HybridSymplectic) there. Where one comes near the central body, take
//! [`GaussRadau15`](piola_integrators::GaussRadau15) or [`Regularised`](crate::regularised::Regularised).
//!
//! # Example
//! ```
//! use piola_gravitation::Gravitation;
//! use piola_gravitation::wisdom_holman::{Corrector, Splitting, WisdomHolman};
//! use piola_integrators::State;
//! // Two planets of 10⁻³ and 3 × 10⁻⁴ of the central mass, periods 2π and about 5π, for 1000 revolutions of the first.
//! let bodies = Gravitation::new(vec![1.0, 1e-3, 3e-4])?;
//! let start = bodies.state(
//!     &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.84, 0.0]],
//!     &[[0.0; 3], [0.0, 1.0, 0.0], [-0.737, 0.0, 0.0]],
//! )?;
//! let before = bodies.invariants(&start).energy;
//! let mut state = State::new(0.0, start)?;
//! let method = WisdomHolman::new(0.2, Splitting::Corrected(Corrector::Seventeen))?;
//! method.integrate_to(&bodies, &mut state, 6283.0)?;
//! let change = bodies.invariants(&state.values).energy / before - 1.0;
//! assert!(change.abs() < 2e-9, "{change}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod alternation;
mod democratic;
mod jacobi;
pub(crate) mod planets;
pub(crate) mod run;
mod splitting;
mod steps;

use core::ops::ControlFlow;

use piola_integrators::{Checkpoint, Ending, IntegratorsError, Report, State, Step, unobserved};
use piola_numerics::Real;

pub use democratic::DemocraticHeliocentric;
pub use splitting::{Corrector, Splitting};

use crate::attraction::LANES;
use crate::check::{check_finite, check_length};
use crate::{Gravitation, GravitationError};
use alternation::Parts;
use jacobi::{Coordinates, Masses};
use run::{Course, Ended, open};
use steps::{Memory, Moving};

/// The map of Wisdom and Holman with a fixed step.
///
/// Bodies are listed from inside out: first the central one, then each planet before those whose orbits enclose its own.
/// Test particles without mass may stand anywhere.
///
/// # Accuracy
/// See [`Splitting`]. Rounding walks at random: states are summed with compensation.
///
/// # Example
/// See the [module](self).
#[doc(alias("WHFast", "mixed-variable symplectic"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WisdomHolman {
    course: Course,
}

/// The name in a checkpoint.
const NAME: &str = "WisdomHolman";
/// Steps between two looks for numbers that are not finite.
const UNWATCHED: u64 = 256;

impl WisdomHolman {
    /// The map with steps no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub const fn new(step: f64, splitting: Splitting) -> Result<Self, IntegratorsError> {
        match Course::new(step, splitting) {
            Ok(course) => Ok(Self { course }),
            Err(error) => Err(error),
        }
    }

    /// The longest step, s.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.course.step
    }

    /// The sequence of motions and attractions in a step.
    #[must_use]
    pub const fn splitting(&self) -> Splitting {
        self.course.splitting
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to(
        &self,
        bodies: &Gravitation,
        state: &mut State,
        end: f64,
    ) -> Result<Report, IntegratorsError<GravitationError>> {
        self.integrate(bodies, state, end, 0, unobserved)
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than the
    /// state's time.
    ///
    /// The observer sees every `shown`-th step (of 0: none) and the last, and may stop the run there. To show a state costs half a
    /// motion, and the inverse corrector where there is one; it does not change the run.
    ///
    /// # Errors
    /// [`IntegratorsError::Field`] where the forces are not those of this map
    /// ([`GravitationError::NotKeplerian`], [`GravitationError::MasslessCentre`]) or the state does not fit them;
    /// [`IntegratorsError::StepTooSmall`]; [`IntegratorsError::NotFinite`] where two bodies meet: the state then stands at the
    /// last complete step.
    pub fn integrate(
        &self,
        bodies: &Gravitation,
        state: &mut State,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<GravitationError>> {
        Ok(self.run(bodies, None, state, end, shown, observer)?.report)
    }

    /// Integrates as [`integrate`](Self::integrate). Returns also the run where it ended or where the observer stopped it, which
    /// [`resume`](Self::resume) continues.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to_checkpoint(
        &self,
        bodies: &Gravitation,
        state: &mut State,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_>) -> ControlFlow<()>,
    ) -> Result<(Report, Checkpoint), IntegratorsError<GravitationError>> {
        let ended = self.run(bodies, None, state, end, shown, observer)?;
        Ok((ended.report, self.checkpoint(bodies, state, &ended)))
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings and bodies: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit. To another end the length of the steps may differ; the
    /// run then begins anew from the state of the checkpoint, and its report goes on counting.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method or splitting,
    /// [`IntegratorsError::WrongLength`] for one of other bodies, [`IntegratorsError::NotFinite`], [`IntegratorsError::InvalidRow`] where
    /// its number of the splitting is unknown. A refused checkpoint leaves the state unchanged.
    ///
    /// # Example
    /// ```
    /// use core::ops::ControlFlow;
    /// use piola_gravitation::Gravitation;
    /// use piola_gravitation::wisdom_holman::{Splitting, WisdomHolman};
    /// use piola_integrators::State;
    /// let bodies = Gravitation::new(vec![1.0, 1e-3])?;
    /// let start = bodies.state(&[[0.0; 3], [1.0, 0.0, 0.0]], &[[0.0; 3], [0.0, 1.0, 0.0]])?;
    /// let method = WisdomHolman::new(0.1, Splitting::Leapfrog)?;
    /// let mut whole = State::new(0.0, start.clone())?;
    /// method.integrate_to(&bodies, &mut whole, 100.0)?;
    /// // The same, stopped after three hundred steps and continued.
    /// let mut state = State::new(0.0, start)?;
    /// let (_, kept) = method.integrate_to_checkpoint(&bodies, &mut state, 100.0, 300, |_| ControlFlow::Break(()))?;
    /// let (report, _) = method.resume(&bodies, &kept, &mut state, 100.0, 0, |_| ControlFlow::Continue(()))?;
    /// assert_eq!((report.steps, state), (1000, whole));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn resume(
        &self,
        bodies: &Gravitation,
        checkpoint: &Checkpoint,
        state: &mut State,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_>) -> ControlFlow<()>,
    ) -> Result<(Report, Checkpoint), IntegratorsError<GravitationError>> {
        let ended = self.run(bodies, Some(checkpoint), state, end, shown, observer)?;
        Ok((ended.report, self.checkpoint(bodies, state, &ended)))
    }

    fn checkpoint(&self, bodies: &Gravitation, state: &State, ended: &Ended<Coordinates>) -> Checkpoint {
        let nothing = || vec![0.0; numbers(bodies)];
        let memory = ended.coordinates.as_ref().map_or_else(nothing, Coordinates::saved);
        ended.checkpoint(NAME, self.course.splitting, state, memory, &[])
    }

    fn run(
        &self,
        bodies: &Gravitation,
        resumed: Option<&Checkpoint>,
        state: &mut State,
        end: f64,
        shown: u64,
        mut observer: impl FnMut(Step<'_>) -> ControlFlow<()>,
    ) -> Result<Ended<Coordinates>, IntegratorsError<GravitationError>> {
        let (steps, saved) = match resumed {
            None => (self.course.begin(bodies, state, end)?, None),
            Some(checkpoint) => open(checkpoint, NAME, [numbers(bodies), 0], self.course, bodies, state, end)?,
        };
        let mut report = resumed.map_or(Report::begin(), |checkpoint| checkpoint.report().continued());
        if steps.count == report.steps {
            return Ok(Ended { report, steps, coordinates: None });
        }
        let (count, h, splitting) = (steps.count, steps.length, self.course.splitting);
        let mut run = Run::new(bodies.parameters(), &state.values, h, splitting);
        match saved {
            None => run.enter(),
            Some(memory) => run.coordinates.restore(memory),
        }
        let mut values = state.values.clone();
        while report.steps < count {
            let until_shown = match shown {
                0 => count,
                shown => shown - report.steps % shown,
            };
            let made = until_shown.min(count - report.steps).min(UNWATCHED);
            let good = run.advance(made);
            report.steps += good;
            report.evaluations += good * splitting.attractions() as u64;
            let number = report.steps;
            let is_shown = number == count || (0 < shown && number.is_multiple_of(shown));
            if good < made || is_shown {
                run.show(steps.elapsed(number), &mut values);
            }
            if good < made {
                let t = Some(steps.time(number));
                let (index, value) = run.not_finite;
                *state = State::new(steps.time(number), values).map_err(IntegratorsError::with_field_error)?;
                return Err(IntegratorsError::NotFinite { quantity: "state", index, value, t });
            }
            if is_shown && observer(Step { number, time: steps.time(number), values: &values }).is_break() {
                report.ending = Ending::Stopped;
                break;
            }
        }
        *state = State::new(steps.time(report.steps), values).map_err(IntegratorsError::with_field_error)?;
        Ok(Ended { report, steps, coordinates: Some(run.coordinates) })
    }
}

/// How many numbers the state of the bodies is saved in.
fn numbers(bodies: &Gravitation) -> usize {
    Coordinates::numbers(bodies.bodies().saturating_sub(1).div_ceil(LANES))
}

/// Whether the map is one of these bodies, and the state theirs.
pub(crate) fn check<T: Real>(bodies: &Gravitation, values: &[T]) -> Result<(), GravitationError> {
    if 0.0 < bodies.softening() {
        return Err(GravitationError::NotKeplerian { force: "softening" });
    }
    if bodies.post_newtonian().is_some() {
        return Err(GravitationError::NotKeplerian { force: "the post-Newtonian term" });
    }
    if bodies.parameters().first().is_none_or(|&centre| centre <= 0.0) {
        return Err(GravitationError::MasslessCentre { body: 0 });
    }
    check_length("state", 6 * bodies.bodies(), values.len())?;
    check_finite("state", values)?;
    for lane in 0..T::LANES {
        let places: Vec<f64> = values.iter().map(|x| x.primal(lane)).collect();
        if let Some((first, second)) = bodies.coincident(&places) {
            return Err(GravitationError::CoincidentBodies { first, second });
        }
    }
    Ok(())
}

/// A run: between steps it stands after the first motion of the next one.
struct Run {
    masses: Masses,
    memory: Memory,
    coordinates: Coordinates,
    /// What was before the last steps, and what is shown.
    spare: Coordinates,
    step: f64,
    splitting: Splitting,
    /// The first number that is not finite, by its index in the state.
    not_finite: (usize, f64),
}

impl Run {
    fn new(parameters: &[f64], state: &[f64], step: f64, splitting: Splitting) -> Self {
        let masses = Masses::new(parameters);
        let memory = Memory::new(&masses);
        let coordinates = Coordinates::new(&masses, state);
        let spare = coordinates.clone();
        Self { masses, memory, coordinates, spare, step, splitting, not_finite: (0, 0.0) }
    }

    fn enter(&mut self) {
        let (splitting, step) = (self.splitting, self.step);
        let mut moving = self.moving();
        let Ok(()) = moving.correct(splitting.corrector(), step, false);
        let Ok(()) = moving.motion(splitting.stages().motions[0] * step);
    }

    fn moving(&mut self) -> Moving<'_> {
        Moving { masses: &self.masses, memory: &mut self.memory, coordinates: &mut self.coordinates }
    }

    /// Makes so many steps, or as many as leave numbers finite: returns how many.
    fn advance(&mut self, count: u64) -> u64 {
        self.spare.copy(&self.coordinates);
        let (stages, step) = (self.splitting.stages(), self.step);
        let mut moving = self.moving();
        for _ in 0..count {
            let Ok(()) = moving.step(step, stages, true);
        }
        let Some(found) = self.coordinates.not_finite(&self.masses) else { return count };
        self.not_finite = found;
        // Again from where all was well, step by step.
        self.coordinates.copy(&self.spare);
        for good in 0..count {
            self.spare.copy(&self.coordinates);
            let Ok(()) = self.moving().step(step, stages, true);
            if let Some(found) = self.coordinates.not_finite(&self.masses) {
                self.not_finite = found;
                self.coordinates.copy(&self.spare);
                return good;
            }
        }
        count
    }

    /// Writes the state, so many seconds after the start.
    fn show(&mut self, elapsed: f64, values: &mut [f64]) {
        self.spare.copy(&self.coordinates);
        let (splitting, step) = (self.splitting, self.step);
        let mut moving = self.moving();
        let Ok(()) = moving.motion(-splitting.stages().motions[0] * step);
        let Ok(()) = moving.correct(splitting.corrector(), step, true);
        self.coordinates.write(&self.masses, elapsed, values);
        core::mem::swap(&mut self.coordinates, &mut self.spare);
    }
}
