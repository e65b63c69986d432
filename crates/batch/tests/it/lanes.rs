//! Lanes of any number hold the points of a view in their order, whatever its blocks are and wherever a part of a batch begins.

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_batch::{BatchError, Components, Deformations, Destination, Gradients, LaneBlocks, Source};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::{Lanes, Real};

const COUNT: usize = 64;

/// Component k of point i: a number that no other has.
fn number(i: usize, k: usize) -> f64 {
    (10 * i + k) as f64
}

fn points<const K: usize>() -> Vec<[f64; K]> {
    (0..COUNT).map(|i| core::array::from_fn(|k| number(i, k))).collect()
}

/// Reads all points, N lanes at a time, and writes them again.
fn carried<const N: usize, const K: usize>(from: impl Source<(), f64, K>, mut to: impl Destination<(), f64, K>) {
    for first in (0..COUNT).step_by(N) {
        let lanes = from.load::<N>(first, N);
        let expected = core::array::from_fn(|k| Lanes(core::array::from_fn(|lane| number(first + lane, k))));
        assert_eq!(lanes, expected, "{N} lanes from point {first} on");
        to.store::<N>(first, N, &lanes);
    }
}

fn through_blocks<const N: usize, const B: usize>() {
    let mut blocks = vec![[[f64::NAN; B]; 3]; COUNT / B];
    for i in 0..COUNT {
        for (k, lanes) in blocks[i / B].iter_mut().enumerate() {
            lanes[i % B] = number(i, k);
        }
    }
    let mut written = vec![[[f64::NAN; B]; 3]; COUNT / B];
    let to = LaneBlocks::new_mut(&mut written, COUNT).expect("as many blocks");
    carried::<N, 3>(LaneBlocks::new(&blocks, COUNT).expect("as many blocks"), to);
    assert_eq!(written, blocks, "{N} lanes and blocks of {B}");
}

#[test]
fn lanes_hold_the_points_of_blocks_that_are_narrower_and_wider() {
    through_blocks::<2, 1>();
    through_blocks::<8, 1>();
    through_blocks::<8, 2>();
    through_blocks::<16, 4>();
    through_blocks::<8, 8>();
    through_blocks::<2, 8>();
    through_blocks::<4, 64>();
}

#[test]
fn blocks_are_divided_into_the_points_before_and_after() {
    let mut blocks = [[[0.0; 8]; 6]; 13];
    let whole = LaneBlocks::new_mut(&mut blocks, 100).expect("as many blocks");
    let (head, tail) = Destination::<(), f64, 6>::split(whole, 64);
    assert_eq!([head, tail].map(|part| Destination::<(), f64, 6>::count(&part)), [64, 36]);
}

fn through_structures<const N: usize>() {
    let components = points::<6>();
    let symmetric: Vec<_> = components.iter().map(|&components| Symmetric { components }).collect();
    let matrices: Vec<_> = points::<9>().iter().map(|by_rows| Matrix3::from_row_slice(by_rows)).collect();
    let (mut tensors, mut gradients) = (vec![Symmetric::zero(); COUNT], vec![Matrix3::zeros(); COUNT]);
    carried::<N, 6>(&symmetric[..], &mut tensors[..]);
    carried::<N, 9>(&matrices[..], &mut gradients[..]);
    assert_eq!((tensors, gradients), (symmetric, matrices), "{N} lanes");
}

#[test]
fn lanes_hold_the_components_of_structures_by_rows() {
    through_structures::<1>();
    through_structures::<2>();
    through_structures::<4>();
    through_structures::<8>();
    through_structures::<16>();
}

/// Stretches 1 + i 2⁻¹⁰ along the first axis: J, and C₁₁ = J², are exact.
fn stretch(i: usize) -> f64 {
    1.0 + i as f64 / 1024.0
}

#[test]
fn stretches_in_arrays_of_components_are_squared_in_place() {
    for count in [1, 2, 3, 8, 37] {
        let mut gradients = [(); 9].map(|()| vec![0.0; count]);
        gradients[0] = (0..count).map(stretch).collect();
        gradients[4].fill(1.0);
        gradients[8].fill(1.0);
        let mut c = [(); 6].map(|()| vec![f64::NAN; count]);
        let f = Gradients(Components::new(gradients.each_ref().map(Vec::as_slice)).expect("equal lengths"));
        let to = Components::new_mut(c.each_mut().map(Vec::as_mut_slice)).expect("equal lengths");
        batch::evaluate(f, batch::right_cauchy_green(to)).expect("deformations");
        let expected: Vec<_> = (0..count).map(|i| stretch(i) * stretch(i)).collect();
        assert_eq!(c[0], expected);
        assert_eq!((&c[1], &c[3]), (&vec![1.0; count], &vec![0.0; count]));
    }
}

#[cfg(feature = "rayon")]
#[test]
fn stretches_in_blocks_are_those_of_their_points_on_any_number_of_threads() {
    const B: usize = 8;
    let count = batch::PARALLEL_POINTS + 4321;
    let mut gradients = vec![[[0.0; B]; 9]; count.div_ceil(B)];
    for i in 0..count {
        let block = &mut gradients[i / B];
        [block[0][i % B], block[4][i % B], block[8][i % B]] = [stretch(i), 1.0, 1.0];
    }
    for threads in [1, 3] {
        let mut j = vec![[[f64::NAN; B]; 1]; gradients.len()];
        let f = Gradients(LaneBlocks::new(&gradients, count).expect("as many blocks"));
        let to = LaneBlocks::new_mut(&mut j, count).expect("as many blocks");
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let report = pool.install(|| batch::evaluate(f, batch::jacobian(to))).expect("deformations");
        assert_eq!(report.points, count);
        let found = j.iter().flat_map(|block| block[0]).take(count);
        assert!(found.eq((0..count).map(stretch)), "{threads} threads");
    }
}

/// Simple shear by the number of the point: nothing is read.
#[derive(Clone, Copy)]
struct Sheared(usize);

impl Deformations<f64> for Sheared {
    type Point<S: Real> = DeformationGradient<S>;
    const TRUSTED: bool = true;
    fn count(&self) -> usize {
        self.0
    }
    fn load<const N: usize>(&self, first: usize, _count: usize) -> DeformationGradient<Lanes<f64, N>> {
        let (zero, one) = (Lanes::splat(0.0), Lanes::splat(1.0));
        let shear = Lanes(core::array::from_fn(|lane| (first + lane) as f64));
        DeformationGradient::new(Matrix3::new(one, shear, zero, zero, one, zero, zero, zero, one)).expect("J = 1")
    }
    fn check(&self, _index: usize) -> Result<(), BatchError> {
        Ok(())
    }
}

#[test]
fn deformations_that_are_computed_from_the_number_of_a_point_are_its_own() {
    let mut c = vec![[0.0; 6]; 101];
    batch::evaluate(Sheared(101), batch::right_cauchy_green(&mut c[..])).expect("deformations");
    for (i, c) in c.iter().enumerate() {
        // C = FᵀF: C₁₂ = γ and C₂₂ = 1 + γ².
        let shear = i as f64;
        assert_eq!((i, *c), (i, [1.0, 1.0 + shear * shear, 1.0, shear, 0.0, 0.0]));
    }
}
