//! The loop over the points of a batch, in lanes and over threads.

use core::marker::PhantomData;

use piola_numerics::{Element, Kernel, Lanes, Mask, Real, dispatch};

use super::deformations::Deformations;
use super::point::Point;
use super::requests::Requests;
use crate::spectral::StretchAnalysis;
use crate::{ContinuumError, Deformation};

/// `f64` or `f32`, with the number of lanes that was measured to be the fastest.
pub trait BatchScalar: Element + Real {
    #[doc(hidden)]
    fn run<D: Deformations<Self>, R: Requests<Self>>(points: D, range: [usize; 2], requests: R) -> Tally;
}

macro_rules! scalar {
    ($float:ident, $lanes:literal) => {
        impl BatchScalar for $float {
            fn run<D: Deformations<Self>, R: Requests<Self>>(points: D, range: [usize; 2], requests: R) -> Tally {
                Evaluation::<Self, _, _, $lanes> { points, range, requests, scalar: PhantomData }.run()
            }
        }
    };
}
scalar!(f64, 4);
scalar!(f32, 8);

/// A batch that was evaluated, all points good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Report {
    /// The number of points.
    pub points: usize,
    /// How many of them took the slow path of the analysis of the stretches, see
    /// [`StretchAnalysis::slow_path`]; 0 where no output needs that analysis.
    pub slow_path: usize,
}

/// A point of a batch at which something is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct BadPoint {
    /// Which point, from 0.
    pub index: usize,
    /// What is wrong, as the constructor of a single point says it.
    pub error: ContinuumError,
}

/// Counts of a part of a batch.
#[doc(hidden)]
#[derive(Debug, Default)]
pub struct Tally {
    slow_path: usize,
    bad: Vec<BadPoint>,
}

/// Points from which on, with feature `rayon`, a batch runs on all threads.
///
/// Where two threads pay for the cheapest requests: of P from T, 8192 points take 5.5 ns each on two threads and 6.6 on
/// one, 4096 points 9.5 and 7.6. R, U and ln U would gain from a thousand points on (65 and 84 ns). Two virtual cores,
/// the shortest of some hundred passes, the halves handed over by a thread outside the pool.
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
/// [`ContinuumError::WrongLength`] when a view does not have n points, before anything is computed;
/// [`ContinuumError::BadPoints`] with *all* bad points when there are any: their outputs are NaN, those of the good
/// points are written all the same. Memory is allocated only then.
///
/// # Accuracy
/// That of the one-point functions, whose formulas run in [`Lanes`]. The results are theirs to the last bit, except that
/// elementary functions (ln) are those of [`Lanes`], within 2 ulp of the standard library's; and they are bit-identical
/// for every place in a batch, number of threads and machine.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, Symmetric, batch};
/// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?; 1000];
/// let (mut j, mut e) = (vec![0.0; 1000], vec![Symmetric::zero(); 1000]);
/// let report = batch::evaluate(&f[..], (batch::jacobian(&mut j[..]), batch::green_strain(&mut e[..])))?;
/// assert_eq!((report.points, j[999], e[999].components[0]), (1000, 2.0, 1.5));
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub fn evaluate<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(
    deformations: D,
    requests: R,
) -> Result<Report, ContinuumError> {
    let points = deformations.count();
    requests.check_lengths(points)?;
    let Tally { slow_path, bad } = divided(deformations, [0, points], requests);
    if bad.is_empty() {
        Ok(Report { points, slow_path })
    } else {
        Err(ContinuumError::BadPoints { points: bad, count: points, slow_path })
    }
}

/// One part after the other, or on several threads.
#[cfg(feature = "rayon")]
fn divided<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(points: D, range: [usize; 2], requests: R) -> Tally {
    if range[1] - range[0] < PARALLEL_POINTS || rayon::current_num_threads() < 2 {
        return T::run(points, range, requests);
    }
    halved(points, range, requests)
}

#[cfg(not(feature = "rayon"))]
fn divided<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(points: D, range: [usize; 2], requests: R) -> Tally {
    T::run(points, range, requests)
}

/// Halves the points until the parts are small; the reports stay in the order of the points.
#[cfg(feature = "rayon")]
fn halved<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(points: D, range: [usize; 2], requests: R) -> Tally {
    let [start, end] = range;
    if end - start < 2 * SMALLEST_PART {
        return T::run(points, range, requests);
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
struct Evaluation<T, D, R, const N: usize> {
    points: D,
    range: [usize; 2],
    requests: R,
    scalar: PhantomData<T>,
}

impl<T: BatchScalar, D: Deformations<T>, R: Requests<T>, const N: usize> Evaluation<T, D, R, N> {
    /// Where much is computed, reading, computing and writing of a block are compiled apart, with the block in memory
    /// between them: together, the compiler would mix the order of the caller's memory into the lanes of the
    /// computation. Within a loop over blocks it would also go through the whole again for each of its thousands of
    /// operations. A few operations are done between reading and writing.
    fn run(mut self) -> Tally {
        let mut tally = Tally::default();
        let [start, end] = self.range;
        let mut buffers = R::buffers::<N>();
        let mut first = start;
        while first < end {
            let count = N.min(end - first);
            let (good, slow) = if R::STAGED {
                let deformation = self.load(first, count, &mut buffers);
                let block = Block { deformation: &deformation, requests: &self.requests, buffers: &mut buffers };
                let masks = dispatch::<Block<'_, T, D, R, N>>(block);
                self.store(first - start, count, &buffers);
                masks
            } else {
                dispatch(Direct { evaluation: &mut self, first, count, buffers: &mut buffers })
            };
            if R::NEEDS_STRETCH && slow.any() {
                tally.slow_path += (0..count).filter(|&lane| slow.lane(lane)).count();
            }
            if !good.all() {
                self.record(first, count, &mut tally);
            }
            first += N;
        }
        tally
    }

    #[inline(never)]
    fn load(&self, first: usize, count: usize, buffers: &mut R::Buffers<N>) -> D::Point<Lanes<T, N>> {
        self.requests.load(first, count, buffers);
        self.points.load::<N>(first, count)
    }

    #[inline(never)]
    fn store(&mut self, at: usize, count: usize, buffers: &R::Buffers<N>) {
        self.requests.store(at, count, buffers);
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

/// A block of N points in lanes.
struct Block<'a, T: BatchScalar, D: Deformations<T>, R: Requests<T>, const N: usize> {
    deformation: &'a D::Point<Lanes<T, N>>,
    requests: &'a R,
    buffers: &'a mut R::Buffers<N>,
}

type LanesMask<T, const N: usize> = <Lanes<T, N> as Real>::Mask;

impl<T: BatchScalar, D: Deformations<T>, R: Requests<T>, const N: usize> Kernel for Block<'_, T, D, R, N> {
    /// Where the points are good and where they took the slow path.
    type Output = (LanesMask<T, N>, LanesMask<T, N>);

    #[inline(always)]
    fn run(self) -> Self::Output {
        let deformation = *self.deformation;
        let mut good: LanesMask<T, N> = Mask::splat(true);
        let mut jacobian = None;
        if !D::TRUSTED {
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
        let point = Point { deformation, jacobian, stretch };
        (good & self.requests.compute(&point, self.buffers), slow)
    }
}

/// The `count` ≤ N points from `first` on, from the caller's memory to the caller's memory.
struct Direct<'a, T: BatchScalar, D: Deformations<T>, R: Requests<T>, const N: usize> {
    evaluation: &'a mut Evaluation<T, D, R, N>,
    first: usize,
    count: usize,
    buffers: &'a mut R::Buffers<N>,
}

impl<T: BatchScalar, D: Deformations<T>, R: Requests<T>, const N: usize> Kernel for Direct<'_, T, D, R, N> {
    type Output = (LanesMask<T, N>, LanesMask<T, N>);

    #[inline(always)]
    fn run(self) -> Self::Output {
        let Self { evaluation: Evaluation { points, range, requests, .. }, first, count, buffers } = self;
        requests.load(first, count, buffers);
        let deformation = points.load::<N>(first, count);
        let block: Block<'_, T, D, R, N> =
            Block { deformation: &deformation, requests: &*requests, buffers: &mut *buffers };
        let masks = block.run();
        requests.store(first - range[0], count, buffers);
        masks
    }
}
