//! Jacobi's coordinates: each body from the mass centre of all before it.

use piola_numerics::Lanes;

use crate::attraction::{Block, LANES};
use crate::checkpoint::take;

pub(super) type Numbers = Lanes<f64, LANES>;

/// As many planets as there are lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// x′, m, and what rounding left of it.
    pub(super) position: Block,
    pub(super) position_carry: Block,
    /// v′, m/s, and what rounding left of it.
    pub(super) velocity: Block,
    pub(super) velocity_carry: Block,
}

/// The masses of all bodies, and the sums of masses that the steps of a run use.
#[derive(Clone, Debug)]
pub(super) struct Masses {
    /// Gm of the central body.
    pub(super) centre: f64,
    /// Gm of the planets.
    pub(super) planets: Vec<f64>,
    /// Gm of all bodies up to the one before each planet, and one more: of all bodies.
    pub(super) before: Vec<f64>,
    pub(super) groups: Vec<GroupMasses>,
}

/// The masses of up to eight planets, in lanes. Lanes without a planet hold zero.
#[derive(Clone, Debug)]
pub(super) struct GroupMasses {
    /// How many planets the group has.
    pub(super) planets: usize,
    /// Gm.
    pub(super) parameters: Numbers,
    /// Gm of all bodies up to each planet, itself included: the parameter μ of its Kepler's motion.
    pub(super) up_to: Numbers,
    /// The same, Gm of the central body, and Gm of the planets, but none of the first planet: its attraction by the central
    /// body is Kepler's motion.
    pub(super) up_to_but_first: Numbers,
    pub(super) centre_but_first: Numbers,
    pub(super) parameters_but_first: Numbers,
    /// 1/Gm of all bodies before.
    pub(super) inverse_before: Numbers,
    /// Of each planet: its Gm over that of all bodies up to it, and its Gm, in the lanes of the planets after it.
    pub(super) share_after: [Numbers; LANES],
    pub(super) parameter_after: [Numbers; LANES],
    /// Gm of each planet over that of all bodies up to it.
    pub(super) shares: Numbers,
    /// Of each planet: its Gm in the lanes of all others.
    pub(super) parameter_of_others: [Numbers; LANES],
    /// Of each planet: one in its own lane.
    pub(super) own: [Numbers; LANES],
}

impl Masses {
    pub(super) fn new(parameters: &[f64]) -> Self {
        let (centre, planets) = parameters.split_first().map_or((0.0, &[][..]), |(first, rest)| (*first, rest));
        let mut before = vec![centre];
        for planet in planets {
            before.push(before[before.len() - 1] + planet);
        }
        let starts = (0..planets.len()).step_by(LANES);
        let groups = starts.map(|start| GroupMasses::new(centre, planets, &before, start)).collect();
        Self { centre, planets: planets.to_vec(), before, groups }
    }
}

impl GroupMasses {
    fn new(centre: f64, planets: &[f64], before: &[f64], start: usize) -> Self {
        let count = LANES.min(planets.len() - start);
        let lanes = |of: &dyn Fn(usize) -> f64| -> Numbers {
            core::array::from_fn(|lane| if lane < count { of(start + lane) } else { 0.0 }).into()
        };
        let where_lane = |of: &dyn Fn(usize) -> f64, holds: fn(usize, usize) -> bool| -> [Numbers; LANES] {
            core::array::from_fn(|own| {
                let value = if own < count { of(start + own) } else { 0.0 };
                core::array::from_fn(|lane| if holds(own, lane) { value } else { 0.0 }).into()
            })
        };
        let but_first = |planet: usize, value: f64| if planet == 0 { 0.0 } else { value };
        let share = |planet: usize| planets[planet] / before[planet + 1];
        Self {
            planets: count,
            parameters: lanes(&|planet| planets[planet]),
            up_to: lanes(&|planet| before[planet + 1]),
            up_to_but_first: lanes(&|planet| but_first(planet, before[planet + 1])),
            centre_but_first: lanes(&|planet| but_first(planet, centre)),
            parameters_but_first: lanes(&|planet| but_first(planet, planets[planet])),
            inverse_before: lanes(&|planet| before[planet].recip()),
            share_after: where_lane(&share, |own, lane| own < lane),
            parameter_after: where_lane(&|planet| planets[planet], |own, lane| own < lane),
            shares: lanes(&share),
            parameter_of_others: where_lane(&|planet| planets[planet], |own, lane| own != lane),
            own: where_lane(&|_| 1.0, |own, lane| own == lane),
        }
    }
}

/// The sum of all lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn total(lanes: Numbers) -> f64 {
    let [a, b, c, d, e, f, g, h] = lanes.0;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

/// A state in Jacobi's coordinates.
#[derive(Clone, Debug)]
pub(super) struct Coordinates {
    pub(super) groups: Vec<Group>,
    /// The mass centre of all bodies: where it was at the start of the run, and its velocity.
    centre_of_mass: [[f64; 3]; 2],
}

impl Coordinates {
    pub(super) fn new(masses: &Masses, state: &[f64]) -> Self {
        let bodies = masses.before.len();
        // Where there is no planet a body rests beside a centre that does not draw it.
        let resting = [Lanes::splat(1.0), Lanes::splat(0.0), Lanes::splat(0.0)];
        let zero = [Lanes::splat(0.0); 3];
        let group = Group { position: resting, position_carry: zero, velocity: zero, velocity_carry: zero };
        let mut groups = vec![group; masses.groups.len()];
        let mut centre_of_mass = [[0.0; 3]; 2];
        for component in 0..6 {
            let (kind, axis) = (component / 3, component % 3);
            let values = &state[component * bodies..(component + 1) * bodies];
            let mut centre = values[0];
            for (planet, (&parameter, &value)) in masses.planets.iter().zip(&values[1..]).enumerate() {
                let relative = value - centre;
                centre += parameter / masses.before[planet + 1] * relative;
                let group = &mut groups[planet / LANES];
                let block = if kind == 0 { &mut group.position } else { &mut group.velocity };
                block[axis].0[planet % LANES] = relative;
            }
            centre_of_mass[kind][axis] = centre;
        }
        Self { groups, centre_of_mass }
    }

    /// How many numbers a state in so many groups is saved in.
    pub(super) const fn numbers(groups: usize) -> usize {
        12 * LANES * groups + 6
    }

    /// All numbers of the state, for a checkpoint.
    pub(super) fn saved(&self) -> Vec<f64> {
        let groups = self.groups.iter().flat_map(|group| {
            let blocks = [group.position, group.position_carry, group.velocity, group.velocity_carry];
            blocks.into_iter().flatten().flat_map(|lanes| lanes.0)
        });
        groups.chain(self.centre_of_mass.into_iter().flatten()).collect()
    }

    /// Takes back what was saved of the same bodies.
    pub(super) fn restore(&mut self, mut saved: &[f64]) {
        for group in &mut self.groups {
            let Group { position, position_carry, velocity, velocity_carry } = group;
            for lanes in [position, position_carry, velocity, velocity_carry].into_iter().flatten() {
                lanes.0 = take(&mut saved).unwrap_or(lanes.0);
            }
        }
        for triple in &mut self.centre_of_mass {
            *triple = take(&mut saved).unwrap_or(*triple);
        }
    }

    /// Becomes `other`, of the same bodies, without a new allocation.
    pub(super) fn copy(&mut self, other: &Self) {
        self.groups.copy_from_slice(&other.groups);
        self.centre_of_mass = other.centre_of_mass;
    }

    /// The first number that is not finite, with its index in the state.
    pub(super) fn not_finite(&self, masses: &Masses) -> Option<(usize, f64)> {
        let bodies = masses.before.len();
        (0..6).find_map(|component| {
            let (kind, axis) = (component / 3, component % 3);
            let values = (0..masses.planets.len()).map(|planet| {
                let group = &self.groups[planet / LANES];
                let block = if kind == 0 { &group.position } else { &group.velocity };
                (component * bodies + planet + 1, block[axis].0[planet % LANES])
            });
            values.into_iter().find(|(_, value)| !value.is_finite())
        })
    }

    /// Writes the state, so many seconds after the start of the run.
    pub(super) fn write(&self, masses: &Masses, elapsed: f64, state: &mut [f64]) {
        let bodies = masses.before.len();
        for component in 0..6 {
            let (kind, axis) = (component / 3, component % 3);
            let values = &mut state[component * bodies..(component + 1) * bodies];
            let relative = |planet: usize| {
                let group = &self.groups[planet / LANES];
                let block = if kind == 0 { group.position } else { group.velocity };
                block[axis].0[planet % LANES]
            };
            // The mass centre of the bodies before each planet, seen from the central body.
            let mut before = 0.0;
            values[0] = 0.0;
            for (planet, &parameter) in masses.planets.iter().enumerate() {
                values[planet + 1] = before + relative(planet);
                before += parameter / masses.before[planet + 1] * relative(planet);
            }
            let [place, velocity] = self.centre_of_mass.map(|of| of[axis]);
            let shift = if kind == 0 { (place - before) + velocity * elapsed } else { velocity - before };
            for value in values {
                *value += shift;
            }
        }
    }
}
