//! Where the components of points are read from: arrays of structures, structures of arrays, strided numbers.

use nalgebra::Matrix3;
use piola_continuum::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use piola_numerics::internal::prefetch;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Element, Lanes, Real};
use piola_tensor::Symmetric;

use super::records::gather;
use super::scalar::BatchScalar;
use super::views::{AllEntries, ColumnMajor, Components, LaneBlocks, Strided};
use crate::BatchError;

/// K components at each of many points, read without a copy; `Q` is what they may be taken for.
///
/// Symmetric tensors have the components 11, 22, 33, 12, 23, 13, general ones nine by rows.
///
/// | implemented by | layout |
/// |---|---|
/// | `&[Symmetric<T>]`, `&[Matrix3<T>]`, `&[[[T; 3]; 3]]`, `&[[T; K]]` | a structure for each point |
/// | `&[CauchyStress<T>]` and the other measures, each only where that measure is asked for | so too |
/// | [`ColumnMajor`] | nine numbers by columns for each point |
/// | [`AllEntries`] | symmetric tensors by any layout of nine numbers, which are checked |
/// | [`Strided`] | numbers at a stride, from [`points_of`](crate::points_of) where it is K |
/// | [`Components`] | an array for each component |
/// | [`LaneBlocks`] | blocks of points, in a block an array for each component: the fastest |
pub trait Source<Q, T: Element, const K: usize>: Copy + Send + Sync {
    /// Whether each component of neighbouring points lies side by side, so that [`load`](Self::load) moves nothing from
    /// lane to lane.
    const IN_LANES: bool = false;

    /// Whether the numbers of a point lie side by side, so that they become lanes in registers.
    #[doc(hidden)]
    const RECORDS: bool = false;

    /// The number of points; none where nothing is read.
    fn count(&self) -> Option<usize>;

    /// The components at one point.
    fn point(&self, index: usize) -> [T; K];

    /// The components at `count` ≤ N points from `first` on, a point a lane; lanes beyond hold the last of them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load<const N: usize>(&self, first: usize, count: usize) -> [Lanes<T, N>; K] {
        let mut lanes = [Lanes([T::zero(); N]); K];
        self.gather(first, count, &mut lanes);
        lanes
    }

    /// Whether the numbers at a point are what they are taken for; errors name the quantity.
    ///
    /// # Errors
    /// [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric) from [`AllEntries`].
    #[doc(hidden)]
    fn check(&self, _quantity: &'static str, _index: usize) -> Result<(), BatchError> {
        Ok(())
    }

    /// As [`load`](Self::load), straight into memory.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; K]) {
        fill(self, first, count, lanes);
    }
}

/// Point by point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn fill<S: Source<Q, T, K>, Q, T: Element, const K: usize, const N: usize>(
    source: &S,
    first: usize,
    count: usize,
    lanes: &mut [Lanes<T, N>; K],
) {
    for lane in 0..N {
        let point = source.point(first + lane.min(count - 1));
        let mut k = 0;
        while k < K {
            lanes[k].0[lane] = point[k];
            k += 1;
        }
    }
}

/// Nothing is read.
impl<Q, T: Element> Source<Q, T, 0> for () {
    const IN_LANES: bool = true;
    const RECORDS: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        None
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, _index: usize) -> [T; 0] {
        []
    }
}

impl<Q, T: BatchScalar> Source<Q, T, 6> for &[Symmetric<T>] {
    const RECORDS: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; 6]) {
        if count < N {
            fill::<_, Q, T, 6, N>(self, first, count, lanes);
        } else {
            gather(self, first, lanes);
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 6] {
        self[index].components
    }
}

impl<Q, T: Element, const K: usize> Source<Q, T, K> for &[[T; K]] {
    const RECORDS: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; K]) {
        if count < N {
            fill::<_, Q, T, K, N>(self, first, count, lanes);
        } else {
            gather(self, first, lanes);
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; K] {
        self[index]
    }
}

impl<Q, T: Element> Source<Q, T, 9> for &[[[T; 3]; 3]] {
    const RECORDS: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; 9]) {
        if count < N {
            fill::<_, Q, T, 9, N>(self, first, count, lanes);
        } else {
            gather(self, first, lanes);
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 9] {
        let [[a, b, c], [d, e, f], [g, h, i]] = self[index];
        [a, b, c, d, e, f, g, h, i]
    }
}

/// Nine numbers by rows of nine by columns.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn transposed<T: Copy>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> [T; 9] {
    [a, d, g, b, e, h, c, f, i]
}

/// The numbers of a nalgebra matrix by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn by_rows<T: Element>(matrix: &Matrix3<T>) -> [T; 9] {
    let [[a, b, c], [d, e, f], [g, h, i]] = matrix.data.0;
    transposed([a, b, c, d, e, f, g, h, i])
}

impl<Q, T: Element> Source<Q, T, 9> for &[Matrix3<T>] {
    const RECORDS: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; 9]) {
        if count < N {
            fill::<_, Q, T, 9, N>(self, first, count, lanes);
        } else {
            gather(self, first, lanes);
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 9] {
        by_rows(&self[index])
    }
}

impl<Q, T: Element> Source<Q, T, 9> for ColumnMajor<&[[T; 9]]> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.0.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 9] {
        transposed(self.0[index])
    }
}

impl<Q, T: Element, const K: usize> Source<Q, T, K> for Strided<&[T], K> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.count)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; K] {
        let data = &self.data[index * self.stride..];
        self.places.map(|place| data[place])
    }
}

/// Prefetch distance in blocks, about 4.6 kB: eight blocks of nine doubles, or one block of a tangent. More would evict data
/// still in use.
pub(super) const fn ahead<Block>() -> usize {
    let size = size_of::<Block>();
    if 0 < size && size < 4608 { 4608 / size } else { 1 }
}

impl<Q, T: Element, const K: usize, const B: usize> Source<Q, T, K> for LaneBlocks<&[[[T; B]; K]]> {
    const IN_LANES: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.count)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; K] {
        let block = &self.blocks[index / B];
        let mut point = [T::zero(); K];
        let mut k = 0;
        while k < K {
            point[k] = block[k][index % B];
            k += 1;
        }
        point
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load<const N: usize>(&self, first: usize, count: usize) -> [Lanes<T, N>; K] {
        let mut lanes = [Lanes([T::zero(); N]); K];
        if count < N {
            fill::<_, Q, T, K, N>(self, first, count, &mut lanes);
            return lanes;
        }
        if N <= B {
            prefetch(self.blocks, first / B + ahead::<[[T; B]; K]>());
            let block = &self.blocks[first / B];
            let mut k = 0;
            while k < K {
                lanes[k] = Lanes(block[k].as_chunks().0[first % B / N]);
                k += 1;
            }
        } else {
            for (part, block) in self.blocks[first / B..][..N / B].iter().enumerate() {
                let mut k = 0;
                while k < K {
                    lanes[k].0[part * B..][..B].copy_from_slice(&block[k]);
                    k += 1;
                }
            }
        }
        lanes
    }
}

impl<Q, T: BatchScalar, A: Source<Q, T, 9>> Source<Q, T, 6> for AllEntries<A> {
    const IN_LANES: bool = A::IN_LANES;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        self.0.count()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 6] {
        symmetric_or_not_finite(self.0.point(index))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load<const N: usize>(&self, first: usize, count: usize) -> [Lanes<T, N>; 6] {
        symmetric_or_not_finite(self.0.load::<N>(first, count))
    }
    fn check(&self, quantity: &'static str, index: usize) -> Result<(), BatchError> {
        let [a, b, c, d, e, f, g, h, i] = self.0.point(index);
        Symmetric::of_quantity(quantity, [[a, b, c], [d, e, f], [g, h, i]])?;
        Ok(())
    }
}

/// The symmetric part where opposite entries agree as [`Symmetric::from_rows`] asks, otherwise not finite, by which the
/// point is looked at.
#[cfg_attr(not(debug_assertions), inline(always))]
fn symmetric_or_not_finite<X: Real>([xx, xy, xz, yx, yy, yz, zx, zy, zz]: [X; 9]) -> [X; 6] {
    let largest = xx.abs().max(yy.abs()).max(zz.abs()).max(xy.abs()).max(yz.abs()).max(xz.abs());
    let scale = largest.max(yx.abs()).max(zy.abs()).max(zx.abs());
    let tolerance = scale * X::lit(32.0 * unit_in_last_place::<X>());
    let agree =
        (xy - yx).abs().at_most(tolerance) & (yz - zy).abs().at_most(tolerance) & (xz - zx).abs().at_most(tolerance);
    let (half, xx) = (X::lit(0.5), X::select(agree, xx, X::lit(f64::NAN)));
    [xx, yy, zz, half * (xy + yx), half * (yz + zy), half * (xz + zx)]
}

impl<Q, T: Element, const K: usize> Source<Q, T, K> for Components<&[T], K> {
    const IN_LANES: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.0[0].len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; K] {
        self.0.map(|component| component[index])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load<const N: usize>(&self, first: usize, count: usize) -> [Lanes<T, N>; K] {
        let mut lanes = [Lanes([T::zero(); N]); K];
        for (lanes, component) in lanes.iter_mut().zip(self.0) {
            let points = &component[first..first + count];
            *lanes = Lanes::load(points, points[count - 1]);
        }
        lanes
    }
}

macro_rules! symmetric_measures {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 6> for &[$name<T>] {
            const RECORDS: bool = true;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; 6]) {
                if count < N {
                    fill::<_, $name, T, 6, N>(self, first, count, lanes);
                } else {
                    gather(self, first, lanes);
                }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn point(&self, index: usize) -> [T; 6] {
                self[index].0.components
            }
        }
    )* };
}
symmetric_measures!(CauchyStress KirchhoffStress SecondPiola);

macro_rules! general_measures {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 9> for &[$name<T>] {
            const RECORDS: bool = true;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; 9]) {
                if count < N {
                    fill::<_, $name, T, 9, N>(self, first, count, lanes);
                } else {
                    gather(self, first, lanes);
                }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn point(&self, index: usize) -> [T; 9] {
                by_rows(&self[index].0)
            }
        }
    )* };
}
general_measures!(FirstPiola MandelStress BiotStress);

impl<'a, T, const K: usize> Components<&'a [T], K> {
    /// From an array for each component.
    ///
    /// # Errors
    /// [`BatchError::WrongLength`] when the arrays differ in length.
    pub fn new(arrays: [&'a [T]; K]) -> Result<Self, BatchError> {
        let expected = arrays.first().map_or(0, |array| array.len());
        match arrays.iter().find(|array| array.len() != expected) {
            Some(odd) => Err(BatchError::WrongLength { quantity: "array of a component", found: odd.len(), expected }),
            None => Ok(Self(arrays)),
        }
    }
}
