//! The leapfrog of the logarithmic Hamiltonian, along a chain.

use piola_integrators::internal::compensated_add;
use piola_numerics::Real;

use super::chain::{Chain, total};
use crate::attraction::inverse_cube;

/// What the leapfrog needs to know of the bodies.
pub(super) struct Bodies<'a, T> {
    /// Gm, by bodies.
    pub(super) parameters: &'a [T],
    /// Σ Gm.
    pub(super) all: T,
    /// G times the energy that the bodies lack to fly apart: U − T, a constant.
    pub(super) binding: T,
}

/// Increments of a step: of each link of the chain, places first, and of the time.
#[derive(Clone, Debug)]
pub(super) struct Increments<T> {
    pub(super) links: Vec<[T; 3]>,
    pub(super) time: T,
}

/// What a leapfrog works in.
#[derive(Clone, Debug)]
pub(super) struct Memory<T> {
    /// Places or velocities from the first body of the chain, in the order of the chain.
    along: Vec<[T; 3]>,
    accelerations: Vec<[T; 3]>,
    /// What rounding left of the increments of the links and of the time.
    carries: Vec<[T; 3]>,
    time_carry: T,
}

impl<T: Real> Memory<T> {
    pub(super) fn new(bodies: usize) -> Self {
        let zero = vec![[T::zero(); 3]; bodies];
        let carries = vec![[T::zero(); 3]; 2 * (bodies - 1)];
        Self { along: zero.clone(), accelerations: zero, carries, time_carry: T::zero() }
    }
}

impl<T: Real> Bodies<'_, T> {
    /// What `count` equal substeps of the total length `step` add to the chain.
    ///
    /// Increments are summed apart from the places that they belong to: each addition then rounds to the size of an increment.
    pub(super) fn leap(&self, chain: &Chain<T>, step: T, count: u32, memory: &mut Memory<T>, out: &mut Increments<T>) {
        out.links.fill([T::zero(); 3]);
        out.time = T::zero();
        memory.carries.fill([T::zero(); 3]);
        memory.time_carry = T::zero();
        let substep = step / T::lit(f64::from(count));
        self.drift(chain, T::lit(0.5) * substep, memory, out);
        for number in 1..=count {
            self.kick(chain, substep, memory, out);
            let length = if number == count { T::lit(0.5) * substep } else { substep };
            self.drift(chain, length, memory, out);
        }
        for (link, carry) in out.links.iter_mut().zip(&memory.carries) {
            *link = total(*link, *carry);
        }
        out.time += memory.time_carry;
    }

    /// Moves along the velocities for the time step/(T + B).
    fn drift(&self, chain: &Chain<T>, step: T, memory: &mut Memory<T>, out: &mut Increments<T>) {
        let links = chain.order.len() - 1;
        let kinetic = self.kinetic(chain, Some(&*out), memory);
        let time = step / (kinetic + self.binding);
        compensated_add(&mut out.time, &mut memory.time_carry, time);
        let (places, velocities) = out.links.split_at_mut(links);
        let places = places.iter_mut().zip(&mut memory.carries);
        for (((place, carry), velocity), start) in places.zip(velocities).zip(&chain.vectors[links..]) {
            for axis in 0..3 {
                compensated_add(&mut place[axis], &mut carry[axis], time * (start[axis] + velocity[axis]));
            }
        }
    }

    /// Changes velocities by the attractions for the time step/U.
    fn kick(&self, chain: &Chain<T>, step: T, memory: &mut Memory<T>, out: &mut Increments<T>) {
        let links = chain.order.len() - 1;
        let potential = self.attract(chain, Some(&*out), memory);
        let time = step / potential;
        let velocities = out.links[links..].iter_mut().zip(&mut memory.carries[links..]);
        for ((velocity, carry), pair) in velocities.zip(memory.accelerations.windows(2)) {
            for axis in 0..3 {
                compensated_add(&mut velocity[axis], &mut carry[axis], time * (pair[1][axis] - pair[0][axis]));
            }
        }
    }

    /// G times the kinetic energy about the mass centre.
    pub(super) fn kinetic(&self, chain: &Chain<T>, plus: Option<&Increments<T>>, memory: &mut Memory<T>) -> T {
        let links = chain.order.len() - 1;
        let mut velocity = [T::zero(); 3];
        let mut moment = [T::zero(); 3];
        memory.along[0] = velocity;
        for (link, start) in chain.vectors[links..].iter().enumerate() {
            let change = plus.map_or([T::zero(); 3], |plus| plus.links[links + link]);
            velocity = total(velocity, total(*start, change));
            memory.along[link + 1] = velocity;
            let parameter = self.parameters[chain.order[link + 1]];
            for axis in 0..3 {
                moment[axis] += parameter * velocity[axis];
            }
        }
        let centre = moment.map(|moment| moment / self.all);
        let mut sum = T::zero();
        for (&body, velocity) in chain.order.iter().zip(&memory.along) {
            let own: [T; 3] = core::array::from_fn(|axis| velocity[axis] - centre[axis]);
            sum += self.parameters[body] * (own[0] * own[0] + own[1] * own[1] + own[2] * own[2]);
        }
        T::lit(0.5) * sum
    }

    /// Writes accelerations in the order of the chain; returns U, G times what the attractions have done since all were far.
    pub(super) fn attract(&self, chain: &Chain<T>, plus: Option<&Increments<T>>, memory: &mut Memory<T>) -> T {
        let bodies = chain.order.len();
        let link = |link: usize| {
            let change = plus.map_or([T::zero(); 3], |plus| plus.links[link]);
            total(chain.vectors[link], change)
        };
        memory.along[0] = [T::zero(); 3];
        for number in 0..bodies - 1 {
            memory.along[number + 1] = total(memory.along[number], link(number));
        }
        memory.accelerations.fill([T::zero(); 3]);
        let mut potential = T::zero();
        for first in 0..bodies {
            let own = self.parameters[chain.order[first]];
            for second in first + 1..bodies {
                // Of neighbours the links themselves: the difference of places has lost what makes them differ.
                let distance = match second - first {
                    1 => link(first),
                    2 => total(link(first), link(first + 1)),
                    _ => core::array::from_fn(|axis| memory.along[second][axis] - memory.along[first][axis]),
                };
                let other = self.parameters[chain.order[second]];
                let inverse_cube = inverse_cube(distance, T::zero());
                for (axis, component) in distance.into_iter().enumerate() {
                    let by_unit = inverse_cube * component;
                    memory.accelerations[first][axis] += other * by_unit;
                    memory.accelerations[second][axis] -= own * by_unit;
                }
                let [x, y, z] = distance;
                potential += own * other * inverse_cube * (x * x + y * y + z * z);
            }
        }
        potential
    }
}
