//! Planets near each other about the central body, integrated together.
//!
//! ```text
//! xᵢ = Qᵢ + Vᵢ t + εᵢ        ε̈ᵢ = −Gm₀ xᵢ/|xᵢ|³ + Σⱼ Gmⱼ w(|dᵢⱼ|) dᵢⱼ        ε = ε̇ = 0 at the start
//! dᵢⱼ = (Qⱼ − Qᵢ) + (Vⱼ − Vᵢ) t + (εⱼ − εᵢ)
//! ```
//!
//! The integrator sums only the small ε. Distances are differences of starts and of ε, so close planets far from the centre keep
//! the digits of their distance.

use piola_integrators::SecondOrder;
use piola_numerics::{Mask, Real};

use super::changeover::changeover;
use crate::GravitationError;
use crate::attraction::inverse_cube;
use crate::wisdom_holman::planets::{PlanetMasses, Planets};

/// Two members of a group, by index.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<T> {
    pub(super) members: [usize; 2],
    /// Qⱼ − Qᵢ, m, and Vⱼ − Vᵢ, m/s.
    start: [[T; 3]; 2],
    /// Gm of both.
    parameters: [f64; 2],
    /// R, m.
    pub(super) critical: f64,
}

/// Planets that move together.
#[derive(Clone, Debug)]
pub(super) struct Together<T> {
    pub(super) members: Vec<usize>,
    pub(super) pairs: Vec<Pair<T>>,
    start: Vec<[[T; 3]; 2]>,
    centre: f64,
}

impl<T: Real> Together<T> {
    pub(super) const fn new() -> Self {
        Self { members: Vec::new(), pairs: Vec::new(), start: Vec::new(), centre: 0.0 }
    }

    /// Becomes the group of these planets.
    pub(super) fn begin(
        &mut self,
        masses: &PlanetMasses,
        planets: &Planets<T>,
        members: impl Iterator<Item = usize>,
        critical: impl Fn(usize, usize) -> f64,
    ) {
        self.centre = masses.centre;
        self.members.clear();
        self.members.extend(members);
        self.start.clear();
        self.pairs.clear();
        for (rank, &own) in self.members.iter().enumerate() {
            let planet = &planets.planets[own];
            self.start.push([planet.position, planet.velocity]);
            for (other_rank, &other) in self.members.iter().enumerate().skip(rank + 1) {
                let parameters = [masses.planets[own], masses.planets[other]];
                if parameters[0] + parameters[1] <= 0.0 {
                    continue;
                }
                let next = &planets.planets[other];
                let place = |axis: usize| {
                    let carry = next.position_carry[axis] - planet.position_carry[axis];
                    (next.position[axis] - planet.position[axis]) + carry
                };
                let velocity = |axis: usize| {
                    let carry = next.velocity_carry[axis] - planet.velocity_carry[axis];
                    (next.velocity[axis] - planet.velocity[axis]) + carry
                };
                let start = [core::array::from_fn(place), core::array::from_fn(velocity)];
                let critical = critical(own, other);
                self.pairs.push(Pair { members: [rank, other_rank], start, parameters, critical });
            }
        }
    }

    /// Change of a member's position (m) and velocity (m/s) in the time t, computed from the integrator's state.
    pub(super) fn increment(&self, rank: usize, t: T, state: &[T]) -> [[T; 3]; 2] {
        let (epsilon, rate) = state.split_at(state.len() / 2);
        let velocity = self.start[rank][1];
        let place = [0, 1, 2].map(|axis| velocity[axis] * t + epsilon[3 * rank + axis]);
        [place, [0, 1, 2].map(|axis| rate[3 * rank + axis])]
    }

    /// The relative place (m) and velocity (m/s) of a pair.
    pub(super) fn relative(pair: &Pair<T>, t: T, state: &[T]) -> [[T; 3]; 2] {
        let (epsilon, rate) = state.split_at(state.len() / 2);
        let velocity = core::array::from_fn(|axis| pair.start[1][axis] + difference(rate, pair.members, axis));
        [pair.distance(t, epsilon), velocity]
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn difference<T: Real>(values: &[T], [first, second]: [usize; 2], axis: usize) -> T {
    values[3 * second + axis] - values[3 * first + axis]
}

impl<T: Real> Pair<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn distance(&self, t: T, epsilon: &[T]) -> [T; 3] {
        let [place, velocity] = self.start;
        let moved = |axis: usize| velocity[axis] * t + difference(epsilon, self.members, axis);
        [place[0] + moved(0), place[1] + moved(1), place[2] + moved(2)]
    }
}

impl<T: Real> SecondOrder<T> for Together<T> {
    type Error = GravitationError;
    const VELOCITY_DEPENDENT: bool = false;

    fn freedom(&self) -> usize {
        3 * self.members.len()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), GravitationError> {
        for (rank, [place, velocity]) in self.start.iter().enumerate() {
            let own = 3 * rank;
            let x = [0, 1, 2].map(|axis| place[axis] + (velocity[axis] * t + q[own + axis]));
            let factor = T::lit(-self.centre) * inverse_cube(x, T::zero());
            for axis in 0..3 {
                acceleration[own + axis] = factor * x[axis];
            }
        }
        for pair in &self.pairs {
            let d = pair.distance(t, q);
            let weight = near(pair.critical, d);
            let [first, second] = pair.members;
            for axis in 0..3 {
                let force = weight * d[axis];
                acceleration[3 * first + axis] += T::lit(pair.parameters[1]) * force;
                acceleration[3 * second + axis] -= T::lit(pair.parameters[0]) * force;
            }
        }
        Ok(())
    }
}

/// Factor of d in the force of the Kepler part: (1 − K + r K′)/|d|³.
#[cfg_attr(not(debug_assertions), inline(always))]
fn near<T: Real>(critical: f64, d: [T; 3]) -> T {
    match part_of_critical(critical, d) {
        None => T::zero(),
        Some(y) => {
            let [value, slope] = changeover(y);
            ((T::one() - value) + slope) * inverse_cube(d, T::zero())
        }
    }
}

/// Factor of d in the force of the part of attractions: (K − r K′)/|d|³.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn far<T: Real>(critical: f64, d: [T; 3]) -> T {
    let Some(y) = part_of_critical(critical, d) else { return inverse_cube(d, T::zero()) };
    let [value, slope] = changeover(y);
    let part = value - slope;
    // The factor is zero. The attraction itself may be infinite here.
    if part.abs().at_most(T::zero()).all() { T::zero() } else { part * inverse_cube(d, T::zero()) }
}

/// y = r/R below one.
#[cfg_attr(not(debug_assertions), inline(always))]
fn part_of_critical<T: Real>(critical: f64, d: [T; 3]) -> Option<T> {
    let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let is_far = T::lit(critical * critical).at_most(square).all();
    if is_far { None } else { Some(square.sqrt() / T::lit(critical)) }
}
