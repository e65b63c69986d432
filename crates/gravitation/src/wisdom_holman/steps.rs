//! Steps of all planets, in lanes.

use core::convert::Infallible;

use piola_integrators::internal::compensated_add;
use piola_numerics::{Kernel, Lanes, dispatch};

use super::alternation::Parts;
use super::jacobi::{Coordinates, Group, Masses, Numbers, total};
use crate::attraction::{Block, LANES, accumulate, attraction};
use crate::kepler::advance;

/// What steps work in: by groups, places from the central body and accelerations.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    places: Vec<Block>,
    accelerations: Vec<Block>,
}

impl Memory {
    pub(super) fn new(masses: &Masses) -> Self {
        let zero = vec![[Lanes::splat(0.0); 3]; masses.groups.len()];
        Self { places: zero.clone(), accelerations: zero }
    }
}

/// What moves all planets.
pub(super) struct Moving<'a> {
    pub(super) masses: &'a Masses,
    pub(super) memory: &'a mut Memory,
    pub(super) coordinates: &'a mut Coordinates,
}

/// Kepler's motion of all planets for a time.
struct Motion<'a>(Moving<'a>, f64);

/// What Kepler's motions leave out, for a time.
struct Attraction<'a>(Moving<'a>, f64);

// One kernel for each part and not for whole steps: compilers then have each part once for a set of instructions.
impl Kernel for Motion<'_> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(mut self) {
        self.0.motion_in_lanes(self.1);
    }
}

impl Kernel for Attraction<'_> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(mut self) {
        self.0.attraction_in_lanes(self.1);
    }
}

impl Parts for Moving<'_> {
    type Error = Infallible;

    fn motion(&mut self, time: f64) -> Result<(), Infallible> {
        dispatch(Motion(self.borrowed(), time));
        Ok(())
    }

    fn attraction(&mut self, time: f64) {
        dispatch(Attraction(self.borrowed(), time));
    }
}

impl Moving<'_> {
    fn borrowed(&mut self) -> Moving<'_> {
        Moving { masses: self.masses, memory: self.memory, coordinates: self.coordinates }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn motion_in_lanes(&mut self, time: f64) {
        for (group, masses) in self.coordinates.groups.iter_mut().zip(&self.masses.groups) {
            let increment = advance(masses.up_to, group.position, group.velocity, Lanes::splat(time));
            group.shift(&increment.position);
            group.push(&increment.velocity);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn attraction_in_lanes(&mut self, time: f64) {
        let Self { masses, memory, coordinates } = self;
        let Memory { places, accelerations } = &mut **memory;
        let zero = Lanes::splat(0.0);
        let is_single = masses.groups.len() == 1;
        // Mass centres, seen from the central body, of the bodies before each planet.
        let mut before = [0.0; 3];
        for ((places, group), masses) in places.iter_mut().zip(&coordinates.groups).zip(&masses.groups) {
            for axis in 0..3 {
                let relative = group.position[axis];
                places[axis] = relative + sum_before(before[axis], relative, &masses.share_after, masses.planets);
                if !is_single {
                    before[axis] += total(masses.shares * relative);
                }
            }
        }
        let mut on_centre = [zero; 3];
        for (number, (acceleration, own)) in accelerations.iter_mut().zip(&masses.groups).enumerate() {
            let target = places[number];
            let mut sum = [zero; 3];
            for (other, (source, others)) in places.iter().zip(&masses.groups).enumerate() {
                for j in 0..others.planets {
                    let mut distance: Block =
                        core::array::from_fn(|axis| Lanes::splat(source[axis].0[j]) - target[axis]);
                    if other == number {
                        // A planet does not attract itself: its distance is made one, and its mass zero.
                        distance[0] += own.own[j];
                        accumulate(&mut sum, attraction(distance, own.parameter_of_others[j], zero));
                    } else {
                        accumulate(&mut sum, attraction(distance, Lanes::splat(others.parameters.0[j]), zero));
                    }
                }
            }
            // The central body is at the origin.
            let by_unit = attraction(target, Lanes::splat(1.0), zero);
            let centre = own.centre_but_first;
            accumulate(&mut sum, [-centre * by_unit[0], -centre * by_unit[1], -centre * by_unit[2]]);
            let parameters = own.parameters_but_first;
            accumulate(&mut on_centre, [parameters * by_unit[0], parameters * by_unit[1], parameters * by_unit[2]]);
            *acceleration = sum;
        }
        // Gm times the acceleration of the bodies before each planet.
        let mut before = on_centre.map(|lanes| masses.centre * total(lanes));
        let time = Lanes::splat(time);
        for ((group, acceleration), masses) in coordinates.groups.iter_mut().zip(accelerations).zip(&masses.groups) {
            let mut change = attraction(group.position, masses.up_to_but_first, zero);
            for axis in 0..3 {
                let own = acceleration[axis];
                let all = sum_before(before[axis], own, &masses.parameter_after, masses.planets);
                if !is_single {
                    before[axis] += total(masses.parameters * own);
                }
                change[axis] = time * (change[axis] + (own - masses.inverse_before * all));
            }
            group.push(&change);
        }
    }
}

/// In each lane the sum of all lanes before it, times their weights, and of what was before all.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum_before(before: f64, values: Numbers, weights_after: &[Numbers; LANES], count: usize) -> Numbers {
    let mut sum = Lanes::splat(before);
    for (value, weights) in values.0.iter().zip(weights_after).take(count) {
        sum += Lanes::splat(*value) * *weights;
    }
    sum
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
        compensated_add(value, carry, *change);
    }
}
