//! How far the mass matrix is from its own arithmetic: the same algorithm for one shape of tree, without anything else.
//!
//! ```sh
//! cargo run --release -p piola-multibody --example mass_matrix_floor
//! ```
//!
//! The bare version knows that the tree is a chain of an even number of hinges with axes y and x in turn: no kinds of joints, no
//! branches, no checks, sizes known to the compiler, the upper triangle alone. Bare and whole take turns; of each the least time.
//!
//! Products and sums of a hinge about a coordinate axis:
//!
//! | part | products | sums |
//! |---|---|---|
//! | axes and origin in space | 21 | 15 |
//! | S about the reference point | 6 | 6 |
//! | composite inertia, turned and moved to the parent | 32 | 43 |
//! | force and moment of a unit acceleration, in space | 24 | 18 |
//! | each entry (i, j), i ≤ j | 6 | 5 |
#![expect(clippy::print_stdout, reason = "it prints its table")]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use piola_numerics::{Kernel, dispatch};

#[path = "../tests/it/trees.rs"]
#[expect(dead_code, reason = "the tests need more trees")]
mod trees;

type Vector = [f64; 3];

/// Behind the last freedom, so that groups of four may end there.
const MORE: usize = 4;

#[inline(always)]
fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn times(a: &[Vector; 3], x: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i][0] * x[0] + a[i][1] * x[1] + a[i][2] * x[2])
}

/// A link in space, and its turn.
#[derive(Clone, Copy, Default)]
struct Place {
    axes: [Vector; 3],
    origin: Vector,
    turn: [f64; 2],
}

/// Mass, first moment and inertia (xx xy xz yy yz zz) about the origin of a link.
#[derive(Clone, Copy, Default)]
struct Inertia {
    mass: f64,
    moment: Vector,
    second: [f64; 6],
}

/// The chain of N rods of the timings.
struct Bare<'a, const N: usize> {
    q: &'a [f64; N],
    own: &'a Inertia,
    step: Vector,
    places: &'a mut [Place; N],
    /// S by components.
    rows: &'a mut [Vec<f64>; 6],
    out: &'a mut [f64],
}

/// A turn about axis A: the other two.
const fn others(axis: usize) -> (usize, usize) {
    ((axis + 1) % 3, (axis + 2) % 3)
}

/// The place of a link after that of its parent.
#[inline(always)]
fn place<const A: usize>(parent: &Place, step: Vector, angle: f64) -> Place {
    let (i, j) = others(A);
    let (sine, cosine) = angle.sin_cos();
    let mut axes = parent.axes;
    for row in &mut axes {
        (row[i], row[j]) = (cosine * row[i] + sine * row[j], cosine * row[j] - sine * row[i]);
    }
    Place { axes, origin: add(parent.origin, times(&parent.axes, step)), turn: [cosine, sine] }
}

/// Force and moment of a unit acceleration about axis A, in space about the first origin.
#[inline(always)]
fn column<const A: usize>(place: &Place, own: &Inertia) -> (Vector, Vector) {
    const ENTRY: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
    let (i, j) = others(A);
    let moment = ENTRY[A].map(|entry| own.second[entry]);
    // e_A × h.
    let mut force = [0.0; 3];
    (force[i], force[j]) = (-own.moment[j], own.moment[i]);
    let force = times(&place.axes, force);
    (add(times(&place.axes, moment), cross(place.origin, force)), force)
}

/// The inertia of a link behind a turn about axis A as its parent feels it, with the parent's own.
#[inline(always)]
fn joined<const A: usize>(place: &Place, beyond: &Inertia, own: &Inertia, r: Vector) -> Inertia {
    const ENTRY: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
    let (i, j) = others(A);
    let [c, s] = place.turn;
    let mut h = beyond.moment;
    (h[i], h[j]) = (c * h[i] - s * h[j], s * h[i] + c * h[j]);
    let a = beyond.second;
    let (ii, jj, ij, ia, ja) = (ENTRY[i][i], ENTRY[j][j], ENTRY[i][j], ENTRY[i][A], ENTRY[j][A]);
    let y = s * (a[ii] - a[jj]) + (c + c) * a[ij];
    let mut turned = a;
    turned[ii] = a[ii] - s * y;
    turned[jj] = a[jj] + s * y;
    turned[ij] = c * y - a[ij];
    turned[ia] = c * a[ia] - s * a[ja];
    turned[ja] = s * a[ia] + c * a[ja];
    let moved = beyond.mass;
    let g = [0, 1, 2].map(|k| h[k] + moved * r[k]);
    let p = [0, 1, 2].map(|k| g[k] * r[k] + h[k] * r[k]);
    let shift = [
        p[1] + p[2],
        -(g[0] * r[1] + r[0] * h[1]),
        -(g[0] * r[2] + r[0] * h[2]),
        p[0] + p[2],
        -(g[1] * r[2] + r[1] * h[2]),
        p[0] + p[1],
    ];
    let mut second = own.second;
    for k in 0..6 {
        second[k] += turned[k] + shift[k];
    }
    Inertia { mass: own.mass + moved, moment: add(own.moment, g), second }
}

impl<const N: usize> Bare<'_, N> {
    #[inline(always)]
    fn put<const A: usize>(&mut self, k: usize) {
        let place = &self.places[k];
        let axis = [0, 1, 2].map(|i| place.axes[i][A]);
        let linear = cross(place.origin, axis);
        for c in 0..3 {
            self.rows[c][k] = axis[c];
            self.rows[c + 3][k] = linear[c];
        }
    }
    #[inline(always)]
    fn entries(&mut self, j: usize, (moment, force): (Vector, Vector)) {
        let mut first = 0;
        while first <= j {
            let row = |c: usize| -> [f64; 4] { self.rows[c][first..first + 4].try_into().unwrap_or_default() };
            let (x, y, z, u, v, w) = (row(0), row(1), row(2), row(3), row(4), row(5));
            let mut sum = [0.0; 4];
            for k in 0..4 {
                sum[k] = (x[k] * moment[0] + y[k] * moment[1] + z[k] * moment[2])
                    + (u[k] * force[0] + v[k] * force[1] + w[k] * force[2]);
            }
            self.out[j * (N + MORE) + first..j * (N + MORE) + first + 4].copy_from_slice(&sum);
            first += 4;
        }
    }
}

impl<const N: usize> Kernel for Bare<'_, N> {
    type Output = ();
    #[inline(always)]
    fn run(mut self) {
        let mut before = Place { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], ..Place::default() };
        for pair in 0..N / 2 {
            let k = 2 * pair;
            self.places[k] = place::<1>(&before, if k == 0 { [0.0; 3] } else { self.step }, self.q[k]);
            self.put::<1>(k);
            self.places[k + 1] = place::<0>(&self.places[k], self.step, self.q[k + 1]);
            self.put::<0>(k + 1);
            before = self.places[k + 1];
        }
        let mut beyond = *self.own;
        for pair in (0..N / 2).rev() {
            let k = 2 * pair;
            let found = column::<0>(&self.places[k + 1], &beyond);
            self.entries(k + 1, found);
            beyond = joined::<0>(&self.places[k + 1], &beyond, self.own, self.step);
            let found = column::<1>(&self.places[k], &beyond);
            self.entries(k, found);
            if k != 0 {
                beyond = joined::<1>(&self.places[k], &beyond, self.own, self.step);
            }
        }
    }
}

fn row<const N: usize>() -> Result<(), Box<dyn Error>> {
    let tree = trees::chain(N);
    let trees::State { q, .. } = trees::state_of(&tree, 1);
    let angles: [f64; N] = q.as_slice().try_into()?;
    // Of a rod of 1 kg about its joint, 0.5 m above its centre.
    let own = Inertia { mass: 1.0, moment: [0.0, 0.0, -0.5], second: [0.334, 0.0, 0.0, 0.334, 0.0, 0.0013] };
    let (mut places, mut bare) = ([Place::default(); N], vec![0.0; N * (N + MORE)]);
    let mut rows: [Vec<f64>; 6] = core::array::from_fn(|_| vec![0.0; N + MORE]);
    let (mut work, mut whole) = (tree.workspace(), vec![0.0; N * N]);
    let (mut best, calls) = ([f64::INFINITY; 2], 20_000 / N);
    for _ in 0..100 {
        let clock = Instant::now();
        for _ in 0..calls {
            let (q, rows, out) = (black_box(&angles), &mut rows, &mut bare[..]);
            dispatch(Bare { q, own: &own, step: [0.0, 0.0, -1.0], places: &mut places, rows, out });
            black_box(&mut bare);
        }
        best[0] = best[0].min(clock.elapsed().as_secs_f64() / calls as f64);
        let clock = Instant::now();
        for _ in 0..calls {
            tree.mass_matrix(&mut work, black_box(&q), black_box(&mut whole))?;
        }
        best[1] = best[1].min(clock.elapsed().as_secs_f64() / calls as f64);
    }
    let mut largest = 0.0_f64;
    for j in 0..N {
        for i in 0..=j {
            largest = largest.max((bare[j * (N + MORE) + i] - whole[j * N + i]).abs() / whole[0]);
        }
    }
    let [bare, whole] = best.map(|time| time * 1e9);
    let operations = 165 * N + 11 * (N * (N + 1) / 2);
    println!("| {N} | {operations} | {bare:.0} | {whole:.0} | {:.2} | {largest:.0e} |", whole / bare);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("| links | operations | bare, ns | mass_matrix, ns | ratio | largest difference over M₁₁ |");
    println!("|---|---|---|---|---|---|");
    row::<6>()?;
    row::<10>()?;
    row::<18>()?;
    row::<30>()?;
    row::<50>()?;
    row::<100>()
}
