//! Bodies as a chain: vectors from each to the next, so that close pairs keep all digits of their distance.

use piola_numerics::Real;
use piola_numerics::sums::two_sum;

/// Vectors from body to body along the chain, first the places, then the velocities; and what rounding left of them.
#[derive(Clone, Debug)]
pub(super) struct Chain<T> {
    /// The bodies in the order of the chain.
    pub(super) order: Vec<usize>,
    pub(super) vectors: Vec<[T; 3]>,
    pub(super) carries: Vec<[T; 3]>,
    /// For building it again.
    spare: Spare<T>,
}

#[derive(Clone, Debug)]
struct Spare<T> {
    order: Vec<usize>,
    vectors: Vec<[T; 3]>,
    carries: Vec<[T; 3]>,
}

impl<T: Real> Chain<T> {
    /// The chain in the order of the bodies, from a state by components.
    pub(super) fn new(bodies: usize, state: &[T]) -> Self {
        let component = |body: usize, half: usize| [0, 1, 2].map(|axis| state[(3 * half + axis) * bodies + body]);
        let links = 2 * (bodies - 1);
        let vectors = (0..links).map(|link| {
            let (half, first) = (link / (bodies - 1), link % (bodies - 1));
            difference(component(first + 1, half), component(first, half))
        });
        let zero = vec![[T::zero(); 3]; links];
        let spare = Spare { order: vec![0; bodies], vectors: zero.clone(), carries: zero.clone() };
        Self { order: (0..bodies).collect(), vectors: vectors.collect(), carries: zero, spare }
    }

    /// Whether a pair that is not linked is nearer than the longer of the links beside it, by more than a tenth.
    pub(super) fn is_stale(&self) -> bool {
        let links = self.order.len() - 1;
        (0..links).any(|first| {
            let mut sum = self.vectors[first];
            (first + 1..links).any(|last| {
                sum = total(sum, self.vectors[last]);
                let longest = squared(self.vectors[first]).max(squared(self.vectors[last]));
                squared(sum) < 0.8 * longest
            })
        })
    }

    /// Links the bodies anew: the nearest pair, then at either end whoever is nearest to it.
    pub(super) fn rebuild(&mut self) {
        let bodies = self.order.len();
        // By places in the old chain.
        let places = &self.vectors[..bodies - 1];
        let distance = |first: usize, second: usize| squared(between(places, first, second));
        let mut pairs = (0..bodies).flat_map(|first| (first + 1..bodies).map(move |second| (first, second)));
        let mut nearest = (0, 1);
        for pair in &mut pairs {
            if distance(pair.0, pair.1) < distance(nearest.0, nearest.1) {
                nearest = pair;
            }
        }
        let mut chain = core::mem::take(&mut self.spare.order);
        chain.clear();
        chain.extend([nearest.0, nearest.1]);
        while chain.len() < bodies {
            let ends = [chain[0], chain[chain.len() - 1]];
            let mut best: Option<(bool, usize, f64)> = None;
            for candidate in (0..bodies).filter(|link| !chain.contains(link)) {
                for (at_end, end) in [false, true].into_iter().zip(ends) {
                    let distance = distance(candidate, end);
                    if best.is_none_or(|(_, _, least)| distance < least) {
                        best = Some((at_end, candidate, distance));
                    }
                }
            }
            match best {
                Some((true, candidate, _)) => chain.push(candidate),
                Some((false, candidate, _)) => chain.insert(0, candidate),
                None => break,
            }
        }
        for half in 0..2 {
            let start = half * (bodies - 1);
            let range = start..start + bodies - 1;
            for link in 0..bodies - 1 {
                let (from, to) = (chain[link], chain[link + 1]);
                let vector = between(&self.vectors[range.clone()], from, to);
                let carry = between(&self.carries[range.clone()], from, to);
                for axis in 0..3 {
                    let (value, rest) = two_sum(vector[axis], carry[axis]);
                    self.spare.vectors[start + link][axis] = value;
                    self.spare.carries[start + link][axis] = rest;
                }
            }
        }
        for link in &mut chain {
            *link = self.order[*link];
        }
        core::mem::swap(&mut self.vectors, &mut self.spare.vectors);
        core::mem::swap(&mut self.carries, &mut self.spare.carries);
        self.spare.order = core::mem::replace(&mut self.order, chain);
    }

    /// Writes places or velocities of all bodies, given those of the mass centre.
    pub(super) fn write(&self, half: usize, parameters: &[T], all: T, centre: [T; 3], out: &mut [T]) {
        let bodies = self.order.len();
        let links = &self.vectors[half * (bodies - 1)..][..bodies - 1];
        for axis in 0..3 {
            let out = &mut out[axis * bodies..][..bodies];
            let (mut place, mut moment) = (T::zero(), T::zero());
            out[self.order[0]] = T::zero();
            for (link, &body) in links.iter().zip(&self.order[1..]) {
                place += link[axis];
                moment += parameters[body] * place;
                out[body] = place;
            }
            let shift = centre[axis] - moment / all;
            for x in out {
                *x += shift;
            }
        }
    }
}

/// From one place of a chain to another: the sum of the links between.
fn between<T: Real>(links: &[[T; 3]], from: usize, to: usize) -> [T; 3] {
    let (low, high) = (from.min(to), from.max(to));
    let sum = links[low + 1..high].iter().fold(links[low], |sum, &link| total(sum, link));
    if from < to { sum } else { sum.map(|x| -x) }
}

pub(super) fn difference<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn total<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// |x|², as a number that decides.
pub(super) fn squared<T: Real>(x: [T; 3]) -> f64 {
    x.iter().map(|x| x.primal(0) * x.primal(0)).sum()
}
