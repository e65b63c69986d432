//! What the tableau of eight stages costs by itself: its products, without the field, the state and the test of convergence.
//!
//! A sweep multiplies the accelerations of each coordinate by the matrix of positions, takes two weighted sums over the stages,
//! and, where the field has velocities, multiplies by the matrix of velocities. A step begins with two products more, which
//! continue the last one. The entries here are not those of the tableau: the time does not depend on them.

use std::hint::black_box;

use piola_numerics::{Kernel, Lanes, dispatch};

use crate::least;

type Stages = Lanes<f64, 8>;

/// Many sweeps over coordinates, or many starts of steps, each of which begins from the one before.
struct Products<'a> {
    /// Entries so small that the numbers stay finite.
    columns: [[Stages; 8]; 2],
    weights: [Stages; 2],
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
fn times(columns: &[Stages; 8], x: Stages) -> Stages {
    let mut even = columns[0] * Lanes::splat(x.0[0]);
    let mut odd = columns[1] * Lanes::splat(x.0[1]);
    for j in [2, 4, 6] {
        even += columns[j] * Lanes::splat(x.0[j]);
        odd += columns[j + 1] * Lanes::splat(x.0[j + 1]);
    }
    even + odd
}

#[inline(always)]
fn dot(a: Stages, b: Stages) -> f64 {
    let x = (a * b).0;
    ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]))
}

impl Kernel for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Products { columns: [position, velocity], weights, accelerations, kind, count } = self;
        for _ in 0..count {
            for a in &mut *accelerations {
                let x = *a;
                *a = match kind {
                    Kind::Start => times(&position, times(&velocity, x)),
                    Kind::Sweep => times(&position, x) + Lanes::splat(dot(weights[0], x) + dot(weights[1], x)),
                    Kind::SweepWithVelocities => {
                        let moved = times(&position, x) + Lanes::splat(dot(weights[0], x));
                        moved + (times(&velocity, x) + Lanes::splat(dot(weights[1], x)))
                    }
                };
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
            // Sums of eight or sixteen products: the numbers neither grow nor leave the normal range within the count.
            let entry = Lanes([if matches!(kind, Kind::Start) { 0.125 } else { 0.031 }; 8]);
            let columns = black_box([[entry; 8]; 2]);
            accelerations.fill(black_box(Lanes([1.0; 8])));
            dispatch(Products {
                columns,
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
