//! The loop over the points of a batch, in lanes and over threads.

use core::marker::PhantomData;

use piola_continuum::Deformation;
use piola_continuum::polar::StretchAnalysis;
use piola_numerics::{LaneKernel, Lanes, Mask, Real};

use super::deformations::Deformations;
use super::point::Point;
use super::request::Requests;
use super::scalar::BatchScalar;
use crate::{BadPoint, BatchError};

/// A batch that was evaluated, all points good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// The number of points.
    pub points: usize,
    /// How many of them took the slow path of the analysis of the stretches, see
    /// [`StretchAnalysis::slow_path`]; 0 where no output needs that analysis.
    pub slow_path: usize,
}

/// Counts of a part of a batch.
#[derive(Debug, Default)]
struct Tally {
    slow_path: usize,
    bad: Vec<BadPoint>,
}

/// Points from which on, with feature `rayon`, a batch runs on all threads.
///
/// Where two threads pay: 8192 points of P from T take 5.0 ns each on two threads and 6.3 on one, of R, U and ln U 21
/// and 26; 4096 points 11.5 and 4.9, 42 and 29. Two virtual cores, the shortest of some hundred passes, the halves
/// handed over by a thread outside the pool.
pub const PARALLEL_POINTS: usize = 1 << 13;

/// Points below which a part of a batch is not divided among threads.
#[cfg(feature = "rayon")]
const SMALLEST_PART: usize = 1 << 12;

/// Computes the requested outputs at all points.
///
/// ```text
/// evaluate(deformations, (output₁, output₂, …))
/// ```
/// | argument | what |
/// |---|---|
/// | `deformations` | F or ∇u at n points: see [`Deformations`] |
/// | `requests` | a request or a tuple of up to eight, of the functions of this module |
///
/// # Errors
/// [`BatchError::WrongLength`] when a view does not have n points, before anything is computed;
/// [`BatchError::BadPoints`] with *all* bad points when there are any: their outputs are NaN, those of the good
/// points are written all the same. Memory is allocated only then.
///
/// # Accuracy
/// That of the one-point functions, whose formulas run in [`Lanes`]. The results are theirs to the last bit, except that
/// logarithms are those of [`Lanes`], within 2 ulp of the standard library's relative to the logarithm itself. They are
/// bit-identical for every place in a batch, number of threads and machine.
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{DeformationGradient, Symmetric};
/// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 1000];
/// let (mut j, mut e) = (vec![0.0; 1000], vec![Symmetric::zero(); 1000]);
/// let report = batch::evaluate(&f[..], (batch::jacobian(&mut j[..]), batch::green_strain(&mut e[..])))?;
/// assert_eq!((report.points, j[999], e[999].components[0]), (1000, 2.0, 1.5));
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
pub fn evaluate<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(
    deformations: D,
    requests: R,
) -> Result<Report, BatchError> {
    let points = deformations.count();
    requests.check_lengths(points)?;
    let Tally { slow_path, bad } = divided(deformations, [0, points], requests);
    if bad.is_empty() {
        Ok(Report { points, slow_path })
    } else {
        Err(BatchError::BadPoints { points: bad, count: points, slow_path })
    }
}

/// The points of a range, in lanes.
fn run<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(points: D, range: [usize; 2], requests: R) -> Tally {
    T::in_lanes(Evaluation { points, range, requests, scalar: PhantomData })
}

/// One part after the other, or on several threads.
#[cfg(feature = "rayon")]
fn divided<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(points: D, range: [usize; 2], requests: R) -> Tally {
    if range[1] - range[0] < PARALLEL_POINTS || rayon::current_num_threads() < 2 {
        return run(points, range, requests);
    }
    halved(points, range, requests)
}

#[cfg(not(feature = "rayon"))]
fn divided<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(points: D, range: [usize; 2], requests: R) -> Tally {
    run(points, range, requests)
}

/// Halves the points until the parts are small; the reports stay in the order of the points.
#[cfg(feature = "rayon")]
fn halved<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(points: D, range: [usize; 2], requests: R) -> Tally {
    let [start, end] = range;
    if end - start < 2 * SMALLEST_PART {
        return run(points, range, requests);
    }
    let half = ((end - start) / 2).next_multiple_of(64);
    let (head, tail) = requests.split(half);
    let (mut tally, rest) =
        rayon::join(|| halved(points, [start, start + half], head), || halved(points, [start + half, end], tail));
    tally.slow_path += rest.slow_path;
    tally.bad.extend(rest.bad);
    tally
}

/// The points of a range, whose outputs go to the start of the destinations.
struct Evaluation<T, D, R> {
    points: D,
    range: [usize; 2],
    requests: R,
    scalar: PhantomData<T>,
}

/// Bytes of a batch up to which points become lanes in registers. Of memory that is in no cache whole registers, which lie
/// across its lines, are slower than number by number: P of 10⁶ points takes 13.5 ns a point and 7.7.
const CACHED: usize = 1 << 20;

/// Blocks that are staged together.
const STAGED_BLOCKS: usize = 4;

type LanesMask<T, const N: usize> = <Lanes<T, N> as Real>::Mask;

/// Where points are good, where they took the slow path, and what the outputs need of them.
type Examined<T, P, const N: usize> = (LanesMask<T, N>, LanesMask<T, N>, Point<Lanes<T, N>, P>);

impl<T: BatchScalar, D: Deformations<T>, R: Requests<T>> LaneKernel for Evaluation<T, D, R> {
    type Output = Tally;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(mut self) -> Tally {
        let mut tally = Tally::default();
        if D::IN_LANES && R::IN_LANES {
            self.direct::<N>(&mut tally);
        } else {
            self.staged::<N>(&mut tally);
        }
        tally
    }
}

impl<T: BatchScalar, D: Deformations<T>, R: Requests<T>> Evaluation<T, D, R> {
    /// From the caller's memory to the caller's memory, block by block.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn direct<const N: usize>(&mut self, tally: &mut Tally) {
        let [start, end] = self.range;
        let mut first = start;
        while N <= end - first {
            self.pass::<N>(first, tally);
            first += N;
        }
        if first < end {
            self.singly(first, tally);
        }
    }

    /// The points from `first` on, fewer than a block, one by one: this is compiled once for all numbers of lanes.
    #[inline(never)]
    fn singly(&mut self, first: usize, tally: &mut Tally) {
        for index in first..self.range[1] {
            self.pass::<1>(index, tally);
        }
    }

    /// N points from `first` on.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pass<const N: usize>(&mut self, first: usize, tally: &mut Tally) {
        let (good, slow, point) = Self::point::<N>(self.points.load::<N>(first, N));
        let good = good & self.requests.pass(first, first - self.range[0], &point);
        self.note::<N>(first, N, good, slow, tally);
    }

    /// Where the caller's memory has another order than lanes: a few blocks are read, computed and written, each a
    /// pass of its own. Together, the compiler would mix the order of the memory into the lanes of the computation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn staged<const N: usize>(&mut self, tally: &mut Tally) {
        let [start, end] = self.range;
        if end <= start {
            return;
        }
        // Of the whole batch: its parts on several threads are small, but not their memory.
        let in_registers = Self::in_registers::<N>() && self.points.count() * Self::POINT <= CACHED;
        let no = Mask::splat(false);
        let mut buffers = [R::buffers::<N>(); STAGED_BLOCKS];
        let mut masks: [(LanesMask<T, N>, LanesMask<T, N>); STAGED_BLOCKS] = [(no, no); STAGED_BLOCKS];
        let mut deformations = [[Lanes::splat(T::zero()); 9]; STAGED_BLOCKS];
        let mut first = start;
        while first < end {
            let count = (STAGED_BLOCKS * N).min(end - first);
            self.load(first, count, &mut deformations, &mut buffers, in_registers);
            let blocks = count.div_ceil(N);
            let mut block = 0;
            while block < blocks {
                let at = first + block * N;
                let (good, slow, point) =
                    Self::point::<N>(self.points.filled(at, N.min(end - at), deformations[block]));
                let good = good & self.requests.compute(&point, &mut buffers[block]);
                masks[block] = (good, slow);
                if !good.all() {
                    // A loop with a call is not made one over several blocks at once, which would scatter its lanes.
                    bad_block();
                }
                block += 1;
            }
            self.store(first - start, count, &buffers, in_registers);
            for (block, (good, slow)) in masks[..blocks].iter().enumerate() {
                let at = first + block * N;
                self.note::<N>(at, N.min(end - at), *good, *slow, tally);
            }
            first += STAGED_BLOCKS * N;
        }
    }

    /// What the outputs need of a block; where its points are good, and where they took the slow path.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point<const N: usize>(deformation: D::Point<Lanes<T, N>>) -> Examined<T, D::Point<Lanes<T, N>>, N> {
        let mut good: LanesMask<T, N> = Mask::splat(true);
        let mut jacobian = None;
        if !D::TRUSTED && !R::KNOWS_DEFORMATIONS {
            let determinant = deformation.jacobian();
            good = Lanes::splat(T::zero()).less_than(determinant) & determinant.is_finite();
            jacobian = Some(determinant);
        }
        let mut slow = Mask::splat(false);
        let mut stretch = None;
        if R::NEEDS_STRETCH {
            let analysis = StretchAnalysis::of(&deformation);
            slow = analysis.slow_path() & good;
            stretch = Some(analysis);
        }
        (good, slow, Point { deformation, jacobian, stretch })
    }

    /// Counts points of the slow path, records bad ones.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn note<const N: usize>(
        &mut self,
        first: usize,
        count: usize,
        good: LanesMask<T, N>,
        slow: LanesMask<T, N>,
        tally: &mut Tally,
    ) {
        if R::NEEDS_STRETCH && slow.any() {
            tally.slow_path += (0..count).filter(|&lane| slow.lane(lane)).count();
        }
        if !good.all() {
            self.record(first, count, tally);
        }
    }

    /// Bytes of the deformation and the outputs of a point.
    const POINT: usize = (9 + R::COMPONENTS) * size_of::<T>();

    /// Whether points become lanes by shuffles in registers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    const fn in_registers<const N: usize>() -> bool {
        D::RECORDS && R::RECORDS && Lanes::<T, N>::IN_REGISTERS
    }

    /// Reads `count` points from `first` on.
    #[inline(never)]
    fn load<const N: usize>(
        &self,
        first: usize,
        count: usize,
        deformations: &mut [[Lanes<T, N>; 9]; STAGED_BLOCKS],
        buffers: &mut [R::Buffers<N>; STAGED_BLOCKS],
        in_registers: bool,
    ) {
        let mut done = 0;
        for (deformation, buffers) in deformations.iter_mut().zip(buffers) {
            let (at, left) = (first + done, count - done);
            if N <= left {
                self.points.fill(at, N, deformation, in_registers);
                self.requests.load(at, N, buffers, in_registers);
            } else if 0 < left {
                self.points.fill(at, left, deformation, in_registers);
                self.requests.load(at, left, buffers, in_registers);
            }
            done += N.min(left);
        }
    }

    /// Writes `count` points from `at` on.
    #[inline(never)]
    fn store<const N: usize>(
        &mut self,
        at: usize,
        count: usize,
        buffers: &[R::Buffers<N>; STAGED_BLOCKS],
        in_registers: bool,
    ) {
        let mut done = 0;
        for buffers in buffers {
            let (at, left) = (at + done, count - done);
            if N <= left {
                self.requests.store(at, N, buffers, in_registers);
            } else if 0 < left {
                self.requests.store(at, left, buffers, in_registers);
            }
            done += N.min(left);
        }
    }

    /// Finds the bad points of a block, says what is wrong with them and voids their outputs.
    #[cold]
    #[inline(never)]
    fn record(&mut self, first: usize, count: usize, tally: &mut Tally) {
        for index in first..first + count {
            let checked = self.points.check(index);
            let point = || self.points.load::<1>(index, 1);
            if let Err(error) = checked.and_then(|()| self.requests.check(index, &point())) {
                tally.bad.push(BadPoint { index, error });
                self.requests.void(index - self.range[0]);
            }
        }
    }
}

#[cold]
#[inline(never)]
fn bad_block() {
    core::hint::black_box(());
}
