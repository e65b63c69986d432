//! Planets that come near each other in a motion: who they are, and how they move.

use core::ops::ControlFlow;

use piola_integrators::{GaussRadau15, GaussRadauStep, IntegratorsError, State};
use piola_numerics::Real;

use super::paths::{Arc, dot, length};
use super::together::{Pair, Together, far};
use super::{Changeover, ClosestApproach};
use crate::GravitationError;
use crate::kepler::{Increment, advance};
use crate::wisdom_holman::planets::{PlanetMasses, Planets};
use crate::wisdom_holman::run::{Failure, Near};

/// Halvings of a step in the search for the nearest approach.
const HALVINGS: u32 = 50;

/// What bodies are, besides their masses: by bodies, the central one first.
#[derive(Clone, Debug)]
pub(super) struct Sizes {
    pub(super) critical: Vec<f64>,
    /// Radii of the bodies, m; none where collisions are not looked for.
    pub(super) radii: Vec<f64>,
    /// The least distance from the central body, m.
    pub(super) least: f64,
}

impl Sizes {
    /// The critical radius of two planets, m.
    fn critical(&self, first: usize, second: usize) -> f64 {
        self.critical[first + 1].max(self.critical[second + 1]).max(self.contact(first + 1, second + 1))
    }

    /// The distance at which two bodies touch, m.
    fn contact(&self, first: usize, second: usize) -> f64 {
        if self.radii.is_empty() { 0.0 } else { self.radii[first] + self.radii[second] }
    }
}

/// The planets that come near each other in a motion.
#[derive(Debug)]
pub(super) struct Encounters<'a, T> {
    sizes: &'a Sizes,
    changeover: Changeover,
    arcs: Vec<Arc>,
    /// The number of the group of each planet: that of its first member.
    groups: Vec<usize>,
    /// Whether a group has been integrated.
    is_done: Vec<bool>,
    together: Together<T>,
    method: GaussRadau15<T>,
    is_counted: bool,
    /// Steps in which planets moved together.
    pub(super) steps: u64,
    pub(super) evaluations: u64,
    pub(super) closest: Option<ClosestApproach>,
}

impl<'a, T: Real> Encounters<'a, T> {
    pub(super) fn new(planets: usize, sizes: &'a Sizes, changeover: Changeover) -> Self {
        Self {
            sizes,
            changeover,
            arcs: vec![Arc::default(); planets],
            groups: vec![0; planets],
            is_done: vec![false; planets],
            together: Together::new(changeover),
            method: GaussRadau15::to_rounding(),
            is_counted: false,
            steps: 0,
            evaluations: 0,
            closest: None,
        }
    }

    /// Joins planets that are not certainly apart; whether there were any.
    fn join(&mut self, masses: &PlanetMasses, time: f64) -> bool {
        let mut found = false;
        for (first, second) in masses.pairs() {
            let [own, other] = [self.groups[first], self.groups[second]];
            let critical = self.sizes.critical(first, second);
            if own == other || self.arcs[first].is_clear_of(&self.arcs[second], time, critical) {
                continue;
            }
            found = true;
            let joined = own.min(other);
            self.is_done[joined] = false;
            for group in &mut self.groups {
                if *group == own || *group == other {
                    *group = joined;
                }
            }
        }
        found
    }

    /// Integrates a group: what its members' places and velocities gain.
    fn integrate(
        &mut self,
        group: usize,
        masses: &PlanetMasses,
        planets: &Planets<T>,
        time: f64,
        t: Option<f64>,
        increments: &mut [Increment<T>],
    ) -> Result<(), Failure> {
        let Self { sizes, arcs, groups, together, method, closest, evaluations, .. } = self;
        let members = (0..groups.len()).filter(|&planet| groups[planet] == group);
        together.begin(masses, planets, members, |first, second| sizes.critical(first, second));
        let freedom = 3 * together.members.len();
        let (members, pairs) = (together.members.clone(), together.pairs.clone());
        let mut watch = Watch {
            members: &members,
            pairs: &pairs,
            sizes,
            arcs,
            mu: masses.centre,
            start: t,
            others: members.len() < groups.len(),
            values: vec![T::zero(); 2 * freedom],
            closest: None,
            collision: None,
        };
        for &member in &members {
            watch.arcs[member].excursion = 0.0;
        }
        let mut state = State::new(0.0, vec![T::zero(); 2 * freedom]).map_err(IntegratorsError::with_field_error)?;
        let run = method.integrate(together, &mut state, time, |step| watch.see(step));
        let start = t.unwrap_or(0.0);
        *evaluations += run.map_err(|error| later(error, start))?.evaluations;
        if let Some(collision) = watch.collision {
            return Err(collision);
        }
        if let Some(found) = watch.closest
            && closest.is_none_or(|closest| found.distance < closest.distance)
        {
            *closest = Some(found);
        }
        for (rank, &member) in members.iter().enumerate() {
            let [position, velocity] = together.increment(rank, T::lit(time), &state.values);
            increments[member] = Increment { position, velocity };
        }
        Ok(())
    }

    /// Refuses planets that come too near the central body.
    fn check_centre(&self, t: f64) -> Result<(), Failure> {
        for (arc, body) in self.arcs.iter().zip(1..) {
            let (distance, least) = (arc.nearest, self.sizes.least);
            let contact = self.sizes.contact(0, body);
            let source = if distance < contact {
                GravitationError::Collision { first: 0, second: body, distance, contact }
            } else if distance < least {
                GravitationError::NearCentre { body, distance, least }
            } else {
                continue;
            };
            return Err(IntegratorsError::Field { t, source });
        }
        Ok(())
    }
}

/// An error of an integrator whose times began with zero.
fn later(error: Failure, start: f64) -> Failure {
    match error {
        IntegratorsError::StepTooSmall { t, step } => IntegratorsError::StepTooSmall { t: start + t, step },
        IntegratorsError::TooManySteps { t, steps } => IntegratorsError::TooManySteps { t: start + t, steps },
        IntegratorsError::Field { t, source } => IntegratorsError::Field { t: start + t, source },
        IntegratorsError::NotFinite { quantity, index, value, t } => {
            IntegratorsError::NotFinite { quantity, index, value, t: Some(start + t.unwrap_or(0.0)) }
        }
        other => other,
    }
}

impl<T: Real> Near<T> for Encounters<'_, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn weight(&self, first: usize, second: usize, distance: [T; 3]) -> T {
        far(self.changeover, self.sizes.critical(first, second), distance)
    }

    fn correct(
        &mut self,
        masses: &PlanetMasses,
        planets: &Planets<T>,
        time: f64,
        t: Option<f64>,
        increments: &mut [Increment<T>],
    ) -> Result<(), Failure> {
        for ((arc, planet), increment) in self.arcs.iter_mut().zip(&planets.planets).zip(&*increments) {
            let ends = |start: [T; 3], change: [T; 3]| {
                let start = start.map(|x| x.primal(0));
                [start, [0, 1, 2].map(|axis| start[axis] + change[axis].primal(0))]
            };
            let places = ends(planet.position, increment.position);
            *arc = Arc::new(masses.centre, places, ends(planet.velocity, increment.velocity), time);
        }
        if let Some(t) = t {
            self.check_centre(t)?;
        }
        for (planet, group) in self.groups.iter_mut().enumerate() {
            *group = planet;
        }
        self.is_done.fill(true);
        // A planet that leaves its arc may come near others.
        while self.join(masses, time) {
            for group in 0..self.groups.len() {
                if !self.is_done[group] {
                    self.integrate(group, masses, planets, time, t, increments)?;
                    self.is_done[group] = true;
                }
            }
            if t.is_some() && !self.is_counted {
                self.is_counted = true;
                self.steps += 1;
            }
        }
        Ok(())
    }

    fn end_step(&mut self) {
        self.is_counted = false;
    }
}

/// What is looked for in the steps of a group.
struct Watch<'a, T> {
    members: &'a [usize],
    pairs: &'a [Pair<T>],
    sizes: &'a Sizes,
    arcs: &'a mut [Arc],
    mu: f64,
    /// The time at the start; none in correctors and looks, which are not followed by their own time.
    start: Option<f64>,
    /// Whether there are planets outside the group.
    others: bool,
    values: Vec<T>,
    closest: Option<ClosestApproach>,
    collision: Option<Failure>,
}

impl<T: Real> Watch<'_, T> {
    fn see(&mut self, step: &GaussRadauStep<'_, T>) -> ControlFlow<()> {
        if self.others {
            self.measure_excursions(step);
        }
        let Some(start) = self.start else { return ControlFlow::Continue(()) };
        for pair in self.pairs {
            let (t, distance) = self.least_distance(pair, step);
            let [first, second] = pair.members.map(|rank| self.members[rank] + 1);
            let t = start + t;
            if self.closest.is_none_or(|closest| distance < closest.distance) {
                self.closest = Some(ClosestApproach { first, second, distance, t });
            }
            let contact = self.sizes.contact(first, second);
            if distance < contact {
                let source = GravitationError::Collision { first, second, distance, contact };
                self.collision = Some(IntegratorsError::Field { t, source });
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    /// How far the members leave their Keplerian arcs in a step.
    fn measure_excursions(&mut self, step: &GaussRadauStep<'_, T>) {
        let length_of_step = step.time() - step.start();
        for (rank, &member) in self.members.iter().enumerate() {
            let arc = self.arcs[member];
            let [place, velocity] = arc.start();
            let by = advance(self.mu, place, velocity, step.time());
            let own = 3 * rank;
            let state = step.values();
            let half = state.len() / 2;
            let apart = |axis: usize| velocity[axis] * step.time() + state[own + axis].primal(0) - by.position[axis];
            let rate = |axis: usize| state[half + own + axis].primal(0) - by.velocity[axis];
            let [apart, rate] = [[0, 1, 2].map(apart), [0, 1, 2].map(rate)];
            // Within the step the planet moves away no faster than at one of the ends, but for a turn in between.
            let excursion = length(apart) + 0.5 * length_of_step.abs() * length(rate);
            self.arcs[member].excursion = arc.excursion.max(excursion);
        }
    }

    /// The least distance of a pair in a step, and its time from the start of the motion.
    fn least_distance(&mut self, pair: &Pair<T>, step: &GaussRadauStep<'_, T>) -> (f64, f64) {
        let look = |t: f64, values: &[T]| {
            let [d, u] = Together::relative(pair, T::lit(t), values).map(|x| x.map(|x| x.primal(0)));
            (dot(d, u), length(d))
        };
        let direction = (step.time() - step.start()).signum();
        let (first, last) = (look(step.start(), step.start_values()), look(step.time(), step.values()));
        let mut least = if last.1 < first.1 { (step.time(), last.1) } else { (step.start(), first.1) };
        if !(first.0 * direction < 0.0 && 0.0 < last.0 * direction) {
            return least;
        }
        let (mut low, mut high) = (step.start(), step.time());
        for _ in 0..HALVINGS {
            let t = 0.5 * (low + high);
            if step.at(t, &mut self.values).is_err() {
                break;
            }
            let (approach, distance) = look(t, &self.values);
            if distance < least.1 {
                least = (t, distance);
            }
            if approach * direction < 0.0 {
                low = t;
            } else {
                high = t;
            }
        }
        least
    }
}
