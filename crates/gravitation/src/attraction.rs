//! The direct sum of attractions, in lanes over the attracted bodies.

use piola_numerics::{Kernel, Lanes, Real, dispatch};

/// Bodies from which on, with feature `rayon`, the sum runs on all cores. Measured on two cores, in ns a pair:
/// 0.4 to 0.5 with threads and 0.4 without at 512 bodies, 0.2 with threads at 1024 (bench group `nbody`).
pub const PARALLEL_BODIES: usize = 1024;

/// Attracted bodies that are computed together.
pub(crate) const LANES: usize = 8;
pub(crate) type Block = [Lanes<f64, LANES>; 3];

/// The acceleration that a body at distance vector d = xⱼ − xᵢ gives: Gm d / (|d|² + ε²)^(3/2); NaN where
/// |d|² + ε² is zero.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | d | `distance` | 3 | m |
/// | Gm | `parameter` | scalar | m³/s² |
/// | ε² | `softening_squared` | scalar | m² |
/// | returned | | 3 | m/s² |
///
/// # Accuracy
/// 5 ulp.
///
/// # Example
/// ```
/// use piola_gravitation::attraction;
/// assert_eq!(attraction([0.0, 2.0, 0.0], 8.0, 0.0), [0.0, 2.0, 0.0]); // Gm/r² = 8/4
/// ```
///
/// # Source
/// W(4.2) with Newton's law.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn attraction<T: Real>(distance: [T; 3], parameter: T, softening_squared: T) -> [T; 3] {
    // No closures in kernels: they are compiled for the base level.
    let factor = parameter * inverse_cube(distance, softening_squared);
    [factor * distance[0], factor * distance[1], factor * distance[2]]
}

/// (|d|² + ε²)^(−3/2).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn inverse_cube<T: Real>([x, y, z]: [T; 3], softening_squared: T) -> T {
    let r2 = x * x + y * y + z * z + softening_squared;
    (r2 * r2.sqrt()).recip()
}

/// The sum over any scalar: every pair once. Every body meets the others in their order, as in the sum in
/// lanes: the results agree bit for bit.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn sum_over<T: Real>(parameters: &[f64], softening_squared: f64, positions: &[T], out: &mut [T]) {
    let n = parameters.len();
    let softening_squared = T::lit(softening_squared);
    let (x, rest) = positions.split_at(n);
    let (y, z) = rest.split_at(n);
    let (out_x, rest) = out.split_at_mut(n);
    let (out_y, out_z) = rest.split_at_mut(n);
    out_x.fill(T::zero());
    out_y.fill(T::zero());
    out_z.fill(T::zero());
    for i in 0..n {
        let mut own = [out_x[i], out_y[i], out_z[i]];
        for j in i + 1..n {
            if 0.0 < parameters[i] + parameters[j] {
                let d = [x[j] - x[i], y[j] - y[i], z[j] - z[i]];
                let inverse_cube = inverse_cube(d, softening_squared);
                let on_i = T::lit(parameters[j]) * inverse_cube;
                let on_j = T::lit(parameters[i]) * inverse_cube;
                for (own, d) in own.iter_mut().zip(d) {
                    *own += on_i * d;
                }
                out_x[j] -= on_j * d[0];
                out_y[j] -= on_j * d[1];
                out_z[j] -= on_j * d[2];
            }
        }
        (out_x[i], out_y[i], out_z[i]) = (own[0], own[1], own[2]);
    }
}

/// Bodies below which every pair is computed once, one at a time; from there on lanes over the attracted
/// bodies compute every pair twice and are faster (measured; see the bench group `nbody`).
const LANE_BODIES: usize = 14;

/// The buffers of the sum in lanes.
#[derive(Clone, Debug)]
pub(super) struct Summation {
    /// The accelerations, by blocks of attracted bodies; empty where lanes are not used.
    blocks: Vec<Block>,
}

impl Summation {
    pub(super) fn new(bodies: usize) -> Self {
        let blocks = if bodies < LANE_BODIES { 0 } else { bodies.div_ceil(LANES) };
        Self { blocks: vec![[Lanes::splat(0.0); 3]; blocks] }
    }

    pub(super) fn run(&mut self, parameters: &[f64], softening_squared: f64, positions: &[f64], out: &mut [f64]) {
        let n = parameters.len();
        if n < LANE_BODIES {
            return sum_over(parameters, softening_squared, positions, out);
        }
        let attracting = Attracting { parameters, softening_squared, positions };
        #[cfg(feature = "rayon")]
        if PARALLEL_BODIES <= n {
            use rayon::prelude::*;
            const BLOCKS: usize = 8;
            self.blocks
                .par_chunks_mut(BLOCKS)
                .enumerate()
                .for_each(|(chunk, blocks)| dispatch(Sum { attracting, first: chunk * BLOCKS, blocks }));
            return self.gather(n, out);
        }
        dispatch(Sum { attracting, first: 0, blocks: &mut self.blocks });
        self.gather(n, out);
    }

    fn gather(&self, n: usize, out: &mut [f64]) {
        for (component, out) in out.chunks_mut(n.max(1)).enumerate() {
            for (out, block) in out.chunks_mut(LANES).zip(&self.blocks) {
                block[component].store(out);
            }
        }
    }
}

#[derive(Clone, Copy)]
struct Attracting<'a> {
    parameters: &'a [f64],
    softening_squared: f64,
    positions: &'a [f64],
}

/// The accelerations of some blocks of bodies.
struct Sum<'a> {
    attracting: Attracting<'a>,
    /// The index of the first block.
    first: usize,
    blocks: &'a mut [Block],
}

impl Kernel for Sum<'_> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let Attracting { parameters, softening_squared, positions } = self.attracting;
        let n = parameters.len();
        let (x, rest) = positions.split_at(n);
        let (y, z) = rest.split_at(n);
        let softening_squared = Lanes::splat(softening_squared);
        for (number, block) in self.blocks.iter_mut().enumerate() {
            let start = (self.first + number) * LANES;
            let end = (start + LANES).min(n);
            // Lanes beyond the last body compute something that nobody reads.
            let target: Block =
                [Lanes::load(&x[start..end], 0.0), Lanes::load(&y[start..end], 0.0), Lanes::load(&z[start..end], 0.0)];
            let mut sum = [Lanes::splat(0.0); 3];
            for j in 0..start {
                add(&mut sum, &target, [x[j], y[j], z[j]], parameters[j], softening_squared);
            }
            for j in start..end {
                add_except(&mut sum, &target, [x[j], y[j], z[j]], parameters[j], softening_squared, j - start);
            }
            for j in end..n {
                add(&mut sum, &target, [x[j], y[j], z[j]], parameters[j], softening_squared);
            }
            *block = sum;
        }
    }
}

/// Adds the attraction of one body to all lanes. Bodies without mass are passed over.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add(
    sum: &mut Block,
    target: &Block,
    source: [f64; 3],
    parameter: f64,
    softening_squared: Lanes<f64, LANES>,
) {
    if 0.0 < parameter {
        let d = distance(target, source);
        accumulate(sum, attraction(d, Lanes::splat(parameter), softening_squared));
    }
}

/// The same for a body that is itself in lane `own`: there it is moved away and loses its mass.
#[cfg_attr(not(debug_assertions), inline(always))]
fn add_except(
    sum: &mut Block,
    target: &Block,
    source: [f64; 3],
    parameter: f64,
    softening_squared: Lanes<f64, LANES>,
    own: usize,
) {
    if 0.0 < parameter {
        let mut d = distance(target, source);
        let mut parameter = Lanes::splat(parameter);
        d[0].0[own] = 1.0;
        parameter.0[own] = 0.0;
        accumulate(sum, attraction(d, parameter, softening_squared));
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn distance(target: &Block, [x, y, z]: [f64; 3]) -> Block {
    [Lanes::splat(x) - target[0], Lanes::splat(y) - target[1], Lanes::splat(z) - target[2]]
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn accumulate(sum: &mut Block, term: Block) {
    sum[0] += term[0];
    sum[1] += term[1];
    sum[2] += term[2];
}
