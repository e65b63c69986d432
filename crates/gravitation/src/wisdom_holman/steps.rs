//! Steps of all planets, in lanes.

use piola_numerics::sums::two_sum;
use piola_numerics::{Kernel, Lanes, dispatch};

use super::jacobi::{Coordinates, Group, Masses};
use super::splitting::{CORRECTOR_MOTION, Stages};
use crate::attraction::{Block, LANES, accumulate, add, add_except, attraction};
use crate::kepler::advance;

/// What steps work in.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    /// Positions of the planets from the central body, by components.
    places: [Vec<f64>; 3],
    /// Accelerations of the planets, by components.
    accelerations: [Vec<f64>; 3],
    /// Gm of each planet over that of all bodies up to it.
    shares: Vec<f64>,
    /// 1/Gm of all bodies before each planet.
    inverse_before: Vec<f64>,
}

impl Memory {
    pub(super) fn new(masses: &Masses) -> Self {
        let room = masses.drawing.len() * LANES;
        let zero = || [vec![0.0; room], vec![0.0; room], vec![0.0; room]];
        let shares = masses.planets.iter().zip(&masses.before[1..]).map(|(planet, all)| planet / all).collect();
        let inverse_before = masses.before.iter().map(|before| before.recip()).collect();
        Self { places: zero(), accelerations: zero(), shares, inverse_before }
    }
}

/// What moves all planets.
pub(super) struct Moving<'a> {
    pub(super) masses: &'a Masses,
    pub(super) memory: &'a mut Memory,
    pub(super) coordinates: &'a mut Coordinates,
}

/// What is done.
#[derive(Clone, Copy)]
pub(super) enum Task {
    /// Kepler's motion for a time.
    Motion(f64),
    /// So many steps from after the first motion of a step to after the first motion of another.
    Steps(u64, f64, Stages),
    /// The corrector of these attractions for a step, or with −1 as last argument its inverse.
    Corrector(&'static [f64], f64, f64),
}

impl Moving<'_> {
    /// At the best set of instructions.
    pub(super) fn run(self, task: Task) {
        dispatch(Run { moving: self, task });
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn motion(&mut self, time: f64) {
        for (group, drawing) in self.coordinates.groups.iter_mut().zip(&self.masses.drawing) {
            let increment = advance(*drawing, group.position, group.velocity, Lanes::splat(time));
            group.shift(&increment.position);
            group.push(&increment.velocity);
        }
    }

    /// Changes velocities by what Kepler's motions leave out, for a time.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn attraction(&mut self, time: f64) {
        let Self { masses, memory, coordinates } = self;
        let planets = masses.planets.len();
        for axis in 0..3 {
            let mut before = 0.0;
            let places = &mut memory.places[axis];
            for (group, places) in coordinates.groups.iter().zip(places.chunks_exact_mut(LANES)) {
                group.position[axis].store(places);
            }
            for (place, share) in places.iter_mut().zip(&memory.shares) {
                let relative = *place;
                *place = before + relative;
                before += share * relative;
            }
        }
        let [x, y, z] = &memory.places;
        let mut on_centre = [Lanes::splat(0.0); 3];
        let unsoftened = Lanes::splat(0.0);
        for number in 0..coordinates.groups.len() {
            let (start, end) = (number * LANES, ((number + 1) * LANES).min(planets));
            let places: Block = [&x, &y, &z].map(|axis| Lanes::load(&axis[start..start + LANES], 0.0));
            let mut sum = [Lanes::splat(0.0); 3];
            for j in 0..start {
                add(&mut sum, &places, [x[j], y[j], z[j]], masses.planets[j], unsoftened);
            }
            for j in start..end {
                add_except(&mut sum, &places, [x[j], y[j], z[j]], masses.planets[j], unsoftened, j - start);
            }
            for j in end..planets {
                add(&mut sum, &places, [x[j], y[j], z[j]], masses.planets[j], unsoftened);
            }
            // The central body is at the origin.
            let by_unit = attraction(places, Lanes::splat(1.0), unsoftened);
            let centre = masses.centre_but_first[number];
            accumulate(&mut sum, [-centre * by_unit[0], -centre * by_unit[1], -centre * by_unit[2]]);
            let mut parameters = Lanes::load(&masses.planets[start..end], 0.0);
            if number == 0 {
                parameters.0[0] = 0.0;
            }
            accumulate(&mut on_centre, [parameters * by_unit[0], parameters * by_unit[1], parameters * by_unit[2]]);
            for (sum, accelerations) in sum.iter().zip(&mut memory.accelerations) {
                sum.store(&mut accelerations[start..start + LANES]);
            }
        }
        for (on_centre, accelerations) in on_centre.iter().zip(&mut memory.accelerations) {
            // Where there is no planet nothing moves.
            accelerations[planets..].fill(0.0);
            // Gm times the acceleration of all bodies before.
            let mut before = masses.centre * on_centre.0.iter().sum::<f64>();
            let bodies = accelerations.iter_mut().zip(&masses.planets).zip(&memory.inverse_before);
            for ((acceleration, parameter), inverse_before) in bodies {
                let own = *acceleration;
                *acceleration = own - before * inverse_before;
                before += parameter * own;
            }
        }
        let time = Lanes::splat(time);
        for (number, group) in coordinates.groups.iter_mut().enumerate() {
            let start = number * LANES;
            let mut change = attraction(group.position, masses.drawing_but_first[number], unsoftened);
            for (change, accelerations) in change.iter_mut().zip(&memory.accelerations) {
                *change = time * (*change + Lanes::load(&accelerations[start..start + LANES], 0.0));
            }
            group.push(&change);
        }
    }

    /// Motion, attraction backwards, motion back, attraction, motion: what is left is the change of the attraction.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn difference(&mut self, motion: f64, attraction: f64) {
        self.motion(motion);
        self.attraction(-attraction);
        self.motion(-2.0 * motion);
        self.attraction(attraction);
        self.motion(motion);
    }
}

struct Run<'a> {
    moving: Moving<'a>,
    task: Task,
}

impl Kernel for Run<'_> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let Self { mut moving, task } = self;
        match task {
            Task::Motion(time) => moving.motion(time),
            Task::Steps(count, step, Stages { motions, attractions }) => {
                // The last motion of a step and the first of the next are one.
                let ends = motions[0] + motions[motions.len() - 1];
                for _ in 0..count {
                    for (stage, attraction) in attractions.iter().enumerate() {
                        moving.attraction(attraction * step);
                        let motion = if stage + 1 == attractions.len() { ends } else { motions[stage + 1] };
                        moving.motion(motion * step);
                    }
                }
            }
            Task::Corrector(attractions, step, direction) => {
                let last = attractions.len();
                for index in 0..last {
                    // The inverse takes the same way back.
                    let index = if 0.0 < direction { last - 1 - index } else { index };
                    let motion = (index + 1) as f64 * CORRECTOR_MOTION * step;
                    let attraction = direction * attractions[index] * step;
                    moving.difference(motion, attraction);
                    moving.difference(-motion, -attraction);
                }
            }
        }
    }
}

impl Group {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shift(&mut self, change: &Block) {
        add_compensated(&mut self.position, &mut self.position_carry, change);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn push(&mut self, change: &Block) {
        add_compensated(&mut self.velocity, &mut self.velocity_carry, change);
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn add_compensated(values: &mut Block, carries: &mut Block, changes: &Block) {
    for ((value, carry), change) in values.iter_mut().zip(carries).zip(changes) {
        (*value, *carry) = two_sum(*value, *carry + *change);
    }
}
