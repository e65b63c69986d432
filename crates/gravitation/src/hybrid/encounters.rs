//! Groups of planets that come near each other in a motion.

use piola_integrators::{GaussRadau15, IntegratorsError, Report, State};
use piola_numerics::Real;

use super::critical::Sizes;
use super::paths::Arc;
use super::together::{Together, far};
use super::watch::{Findings, Watch};
use super::{ClosestApproach, HybridReport};
use crate::checkpoint::count_of;
use crate::kepler::Increment;
use crate::wisdom_holman::planets::{PlanetMasses, Planets};
use crate::wisdom_holman::run::{Failure, Moment, Near};

/// The name in a checkpoint.
pub(super) const NAME: &str = "HybridSymplectic";
/// The numbers of a checkpoint before the critical radii.
pub(super) const NUMBERS: usize = 7;

/// The planets that come near each other in a motion.
#[derive(Debug)]
pub(super) struct Encounters<'a, T> {
    sizes: &'a Sizes,
    arcs: Vec<Arc>,
    /// The pairs that attract, with their critical radii.
    pairs: Vec<(usize, usize, f64)>,
    /// The number of the group of each planet: that of its first member.
    groups: Vec<usize>,
    /// Whether a group is integrated, with its nearest approach.
    is_done: Vec<bool>,
    findings: Vec<Findings>,
    together: Together<T>,
    method: GaussRadau15<T>,
    /// The length of the last step of the integrator, s, with which the next motion begins.
    last_step: f64,
    is_counted: bool,
    /// Steps in which planets moved together.
    pub(super) steps: u64,
    pub(super) evaluations: u64,
    pub(super) closest: Option<ClosestApproach>,
}

impl<'a, T: Real> Encounters<'a, T> {
    pub(super) fn new(masses: &PlanetMasses, sizes: &'a Sizes) -> Self {
        const { assert!(T::LANES == 1, "each lane has its own encounters") };
        let planets = masses.planets.len();
        let pair = |(first, second)| (first, second, sizes.critical(first, second));
        Self {
            pairs: masses.pairs().map(pair).collect(),
            sizes,
            arcs: vec![Arc::default(); planets],
            groups: vec![0; planets],
            is_done: vec![false; planets],
            findings: vec![Findings::default(); planets],
            together: Together::new(),
            method: GaussRadau15::to_rounding(),
            last_step: 0.0,
            is_counted: false,
            steps: 0,
            evaluations: 0,
            closest: None,
        }
    }

    /// The report of a run with these encounters.
    pub(super) const fn report(&self, mut run: Report) -> HybridReport {
        run.evaluations += self.evaluations;
        HybridReport { run, encounter_steps: self.steps, closest: self.closest }
    }

    /// Joins the groups of planets that may come within their critical radius. Returns whether it joined any.
    fn join(&mut self, time: f64) -> bool {
        let Self { pairs, arcs, groups, is_done, findings, .. } = self;
        let mut found = false;
        for &(first, second, critical) in &*pairs {
            let [own, other] = [groups[first], groups[second]];
            if own == other || arcs[first].is_clear_of(&arcs[second], time, critical) {
                continue;
            }
            found = true;
            let joined = own.min(other);
            for group in [own, other] {
                is_done[group] = group != joined;
                findings[group] = Findings::default();
            }
            for group in groups.iter_mut().filter(|group| **group == own || **group == other) {
                *group = joined;
            }
        }
        found
    }

    /// Integrates a group and writes its members' increments.
    fn integrate(
        &mut self,
        group: usize,
        masses: &PlanetMasses,
        planets: &Planets<T>,
        time: f64,
        moment: Moment,
        increments: &mut [Increment<T>],
    ) -> Result<(), Failure> {
        let Self { sizes, arcs, groups, together, method, last_step, findings, evaluations, .. } = self;
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
            moment,
            others: members.len() < groups.len(),
            values: vec![T::zero(); 2 * freedom],
            findings: Findings::default(),
        };
        for &member in &members {
            watch.arcs[member].excursion = 0.0;
        }
        let mut state = State::new(0.0, vec![T::zero(); 2 * freedom]).map_err(IntegratorsError::with_field_error)?;
        if let Ok(hasty) = core::mem::take(method).with_first_step(*last_step) {
            *method = hasty;
        }
        let run = method.integrate(together, &mut state, time, |step| {
            // A look must not change the run.
            if moment.is_of_run {
                *last_step = (step.time() - step.start()).abs();
            }
            watch.see(step)
        });
        *evaluations += run.map_err(|error| later(error, moment.t))?.evaluations;
        findings[group] = watch.findings;
        for (rank, &member) in members.iter().enumerate() {
            let [position, velocity] = together.increment(rank, T::lit(time), &state.values);
            increments[member] = Increment { position, velocity };
        }
        Ok(())
    }

    /// Takes over the nearest approaches of a motion, or returns its collision.
    fn collect(&mut self) -> Result<(), Failure> {
        for findings in &mut self.findings {
            let Findings { closest, collision } = core::mem::take(findings);
            if let Some(collision) = collision {
                return Err(collision);
            }
            if let Some(found) = closest
                && self.closest.is_none_or(|closest| found.distance < closest.distance)
            {
                self.closest = Some(found);
            }
        }
        Ok(())
    }

    /// Refuses planets that come too near the central body on their arcs; those that move together are watched meanwhile.
    fn check_centre(&self, t: f64) -> Result<(), Failure> {
        if !self.sizes.watch_the_centre() {
            return Ok(());
        }
        for (planet, arc) in self.arcs.iter().enumerate() {
            let is_alone = self.groups.iter().filter(|group| **group == self.groups[planet]).count() == 1;
            if let Some(source) = self.sizes.too_near(planet + 1, arc.nearest()).filter(|_| is_alone) {
                return Err(IntegratorsError::Field { t, source });
            }
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
    const NAME: &'static str = NAME;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn weight(&self, first: usize, second: usize, distance: [T; 3]) -> T {
        far(self.sizes.critical(first, second), distance)
    }

    fn correct(
        &mut self,
        masses: &PlanetMasses,
        planets: &Planets<T>,
        time: f64,
        moment: Moment,
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
        for (planet, group) in self.groups.iter_mut().enumerate() {
            *group = planet;
        }
        self.is_done.fill(true);
        let mut are_together = false;
        // A planet that leaves its arc may come near others.
        while self.join(time) {
            are_together = true;
            for group in 0..self.groups.len() {
                if !self.is_done[group] {
                    self.integrate(group, masses, planets, time, moment, increments)?;
                    self.is_done[group] = true;
                }
            }
        }
        if !moment.is_of_run {
            return Ok(());
        }
        if are_together {
            self.steps += u64::from(!self.is_counted);
            self.is_counted = true;
            self.collect()?;
        }
        self.check_centre(moment.t)
    }

    fn end_step(&mut self) {
        self.is_counted = false;
    }

    fn numbers(&self) -> usize {
        NUMBERS + self.sizes.critical.len()
    }

    /// The last step of the integrator, the counts, the nearest approach, the critical radii.
    fn saved(&self) -> Vec<f64> {
        let closest = self.closest.map_or([-1.0, 0.0, 0.0, 0.0], |closest| {
            [closest.first as f64, closest.second as f64, closest.distance, closest.t]
        });
        let counts = [self.last_step, self.steps as f64, self.evaluations as f64];
        // So many as NUMBERS says, then the radii.
        [&counts[..], &closest, &self.sizes.critical].concat()
    }

    fn restore(&mut self, saved: &[f64]) {
        let [last_step, steps, evaluations, first, second, distance, t, ..] = *saved else { return };
        self.last_step = last_step;
        (self.steps, self.evaluations) = (count_of(steps), count_of(evaluations));
        let index = |value: f64| usize::try_from(count_of(value)).unwrap_or(usize::MAX);
        self.closest = (0.0 <= first).then(|| {
            let (first, second) = (index(first), index(second));
            ClosestApproach { first, second, distance, t }
        });
    }
}
