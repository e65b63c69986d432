//! Observer of a group's steps: nearest approach, collisions, and distances from the Keplerian arcs.

use core::ops::ControlFlow;

use piola_integrators::{GaussRadauStep, IntegratorsError};
use piola_numerics::Real;

use super::ClosestApproach;
use super::critical::Sizes;
use super::paths::{Arc, dot, length};
use super::together::{Pair, Together};
use crate::GravitationError;
use crate::kepler::advance;
use crate::wisdom_holman::run::{Failure, Moment};

/// Halvings of a step in the search for the nearest approach.
const HALVINGS: u32 = 50;

/// The nearest approach and the first collision of a group.
#[derive(Clone, Debug, Default)]
pub(super) struct Findings {
    pub(super) closest: Option<ClosestApproach>,
    pub(super) collision: Option<Failure>,
}

/// Observer of the steps of a group.
pub(super) struct Watch<'a, T> {
    pub(super) members: &'a [usize],
    pub(super) pairs: &'a [Pair<T>],
    pub(super) sizes: &'a Sizes,
    pub(super) arcs: &'a mut [Arc],
    pub(super) mu: f64,
    /// When the motion starts; approaches count in motions of the run alone.
    pub(super) moment: Moment,
    /// Whether there are planets outside the group.
    pub(super) others: bool,
    pub(super) values: Vec<T>,
    pub(super) findings: Findings,
}

impl<T: Real> Watch<'_, T> {
    pub(super) fn see(&mut self, step: &GaussRadauStep<'_, T>) -> ControlFlow<()> {
        if self.others {
            self.measure_excursions(step);
        }
        if !self.moment.is_of_run {
            return ControlFlow::Continue(());
        }
        let start = self.moment.t;
        if self.sizes.watch_the_centre() {
            for (rank, &member) in self.members.iter().enumerate() {
                let distance = length(self.place(rank, step.time(), step.values()));
                if let Some(source) = self.sizes.too_near(member + 1, distance) {
                    let t = start + step.time();
                    self.findings.collision = Some(IntegratorsError::Field { t, source });
                    return ControlFlow::Break(());
                }
            }
        }
        for pair in self.pairs {
            let (t, distance) = self.least_distance(pair, step);
            let [first, second] = pair.members.map(|rank| self.members[rank] + 1);
            let t = start + t;
            if self.findings.closest.is_none_or(|closest| distance < closest.distance) {
                self.findings.closest = Some(ClosestApproach { first, second, distance, t });
            }
            let contact = self.sizes.contact(first, second);
            if distance < contact {
                let source = GravitationError::Collision { first, second, distance, contact };
                self.findings.collision = Some(IntegratorsError::Field { t, source });
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    /// The place of a member (m) from the central body, so long after the start of the motion.
    fn place(&self, rank: usize, time: f64, state: &[T]) -> [f64; 3] {
        let [place, velocity] = self.arcs[self.members[rank]].start();
        [0, 1, 2].map(|axis| place[axis] + (velocity[axis] * time + state[3 * rank + axis].primal(0)))
    }

    /// How far the members leave their Keplerian arcs in a step.
    fn measure_excursions(&mut self, step: &GaussRadauStep<'_, T>) {
        let length_of_step = (step.time() - step.start()).abs();
        for (rank, &member) in self.members.iter().enumerate() {
            let arc = self.arcs[member];
            let [place, velocity] = arc.start();
            let off = |time: f64, state: &[T]| {
                let by = advance(self.mu, place, velocity, time);
                let (own, half) = (3 * rank, state.len() / 2);
                let apart = |axis: usize| velocity[axis] * time + state[own + axis].primal(0) - by.position[axis];
                let rate = |axis: usize| state[half + own + axis].primal(0) - by.velocity[axis];
                [length([0, 1, 2].map(apart)), length([0, 1, 2].map(rate))]
            };
            let [first, last] = [off(step.start(), step.start_values()), off(step.time(), step.values())];
            // The rate is largest at an end of the step, unless the planet turns within it.
            let excursion = first[0].max(last[0]) + 0.5 * length_of_step * first[1].max(last[1]);
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
