//! What the tableau of eight stages costs by itself: its products, without the field, the state and the test of convergence.
//!
//! A sweep takes sums and differences of mirrored stages of each coordinate, multiplies them by the two blocks of the matrix of positions,
//! takes two weighted sums, and, where the field has velocities, multiplies by the two blocks of the matrix of velocities. A step begins with
//! two blocks more and a polynomial, which continue the last one. The entries here are not those of the tableau: the time does not depend on
//! them.

use std::hint::black_box;

use piola_numerics::{Kernel, Lanes, dispatch};

use crate::least;

type Stages = Lanes<f64, 8>;
type Half = Lanes<f64, 4>;

/// Many sweeps over coordinates, or many starts of steps, each of which begins from the one before.
struct Products<'a> {
    /// Entries so small that the numbers stay finite.
    blocks: [[Half; 4]; 4],
    weights: [Half; 2],
    accelerations: &'a mut [Stages],
    kind: Kind,
    count: u32,
}

#[derive(Clone, Copy)]
enum Kind {
    Sweep,
    SweepWithVelocities,
    Start,
}

#[inline(always)]
fn times(columns: &[Half; 4], x: Half) -> Half {
    let product = |j: usize| columns[j] * Lanes::splat(x.0[j]);
    (product(0) + product(2)) + (product(1) + product(3))
}

#[inline(always)]
fn dot(a: Half, b: Half) -> f64 {
    let x = (a * b).0;
    (x[0] + x[2]) + (x[1] + x[3])
}

#[inline(always)]
fn joined(first: Half, last: Half) -> Stages {
    let ([a, b, c, d], [e, f, g, h]) = (first.0, last.0);
    Lanes([a, b, c, d, e, f, g, h])
}

#[inline(always)]
fn polynomial(even: Half, odd: Half, x: Half) -> Half {
    let (square, fourth) = (x * x, x * x * (x * x));
    let two = |c: Half, k: usize| Lanes::<f64, 4>::splat(c.0[k]) + Lanes::splat(c.0[k + 1]) * square;
    (two(even, 0) + two(even, 2) * fourth) + (two(odd, 0) + two(odd, 2) * fourth) * x
}

impl Kernel for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Products { blocks: [first, second, third, fourth], weights, accelerations, kind, count } = self;
        for _ in 0..count {
            for stages in &mut *accelerations {
                let [a, b, c, d, e, f, g, h] = stages.0;
                let (before, after) = (Lanes([a, b, c, d]), Lanes([e, f, g, h]));
                let (sums, differences) = (before + after, before - after);
                if let Kind::Start = kind {
                    let (even, odd) = (times(&first, sums), times(&second, differences));
                    let x = Lanes::splat(1.0);
                    *stages = joined(polynomial(even, odd, x), polynomial(even, odd, x));
                    continue;
                }
                let mut same = times(&first, sums) + Lanes::splat(dot(weights[0], sums));
                let mut opposite = times(&second, differences) + Lanes::splat(dot(weights[1], differences));
                if let Kind::SweepWithVelocities = kind {
                    same += times(&third, differences) + Lanes::splat(dot(weights[0], sums));
                    opposite += times(&fourth, sums);
                }
                *stages = joined(same + opposite, same - opposite);
            }
        }
    }
}

/// Seconds of the products of a sweep and of those that start a step, for so many coordinates.
pub(crate) fn products(coordinates: usize, has_velocities: bool) -> [f64; 2] {
    const COUNT: u32 = 5_000;
    let sweep = if has_velocities { Kind::SweepWithVelocities } else { Kind::Sweep };
    [sweep, Kind::Start].map(|kind| {
        let mut accelerations = vec![Lanes([1.0; 8]); coordinates];
        let seconds = least(|| {
            // The numbers neither grow nor leave the normal range within the count: sums grow by 16, 24 and 32 entries.
            let entry = Lanes(
                [match kind {
                    Kind::Sweep => 0.999 / 16.0,
                    Kind::SweepWithVelocities => 0.999 / 24.0,
                    Kind::Start => 0.999 / 32.0,
                }; 4],
            );
            let blocks = black_box([[entry; 4]; 4]);
            accelerations.fill(black_box(Lanes([1.0; 8])));
            dispatch(Products {
                blocks,
                weights: black_box([entry; 2]),
                accelerations: &mut accelerations,
                kind,
                count: COUNT,
            });
            black_box(&accelerations);
        });
        seconds / f64::from(COUNT)
    })
}
