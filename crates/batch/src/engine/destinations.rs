//! Where results are written: arrays of structures, structures of arrays, strided numbers.

use nalgebra::Matrix3;
use piola_continuum::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use piola_numerics::internal::prefetch_for_writing;
use piola_numerics::{Element, Lanes};
use piola_tensor::Symmetric;

use super::records;
use super::scalar::BatchScalar;
use super::sources::{ahead, transposed};
use super::views::{ColumnMajor, Components, LaneBlocks, Strided};
use crate::BatchError;

/// Memory of the caller for K components at each of many points; `Q` is what is written there.
///
/// | implemented by | layout |
/// |---|---|
/// | `&mut [T]` where K = 1; `&mut [Symmetric<T>]`, `&mut [Matrix3<T>]`, `&mut [[[T; 3]; 3]]`, `&mut [[T; K]]` | a structure for each point |
/// | `&mut [CauchyStress<T>]` and the other measures, each only for that measure | so too |
/// | [`ColumnMajor`] | nine numbers by columns for each point |
/// | [`Strided`] | numbers at a stride |
/// | [`Components`] | an array for each component |
/// | [`LaneBlocks`] | blocks of points, in a block an array for each component: the fastest |
///
/// A symmetric tensor fills all nine components of a `Matrix3<T>`.
pub trait Destination<Q, T: Element, const K: usize>: Send + Sized {
    /// Whether each component of neighbouring points lies side by side, so that [`store`](Self::store) moves nothing from
    /// lane to lane.
    const IN_LANES: bool = false;

    /// Whether the numbers of a point lie side by side, so that lanes become points in registers.
    #[doc(hidden)]
    const RECORDS: bool = false;

    /// The number of points.
    fn count(&self) -> usize;

    /// The first `middle` points and the rest; `middle` is a multiple of 64.
    fn split(self, middle: usize) -> (Self, Self);

    /// Writes the components of one point.
    fn put(&mut self, index: usize, components: [T; K]);

    /// Writes the first `count` ≤ N lanes to the points from `first` on.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn store<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; K]) {
        self.scatter(first, count, values);
    }

    /// As [`store`](Self::store), straight from memory.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scatter<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; K]) {
        scatter(self, first, count, values);
    }
}

/// Point by point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn scatter<V: Destination<Q, T, K>, Q, T: Element, const K: usize, const N: usize>(
    to: &mut V,
    first: usize,
    count: usize,
    values: &[Lanes<T, N>; K],
) {
    for lane in 0..count.min(N) {
        to.put(first + lane, lane_of(values, lane));
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn lane_of<T: Element, const N: usize, const K: usize>(values: &[Lanes<T, N>; K], lane: usize) -> [T; K] {
    let mut point = [T::zero(); K];
    let mut k = 0;
    while k < K {
        point[k] = values[k].0[lane];
        k += 1;
    }
    point
}

/// What a structure of K numbers side by side does better than point by point.
macro_rules! records {
    (record $quantity:ty, $k:tt) => {
        const RECORDS: bool = true;
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn scatter<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; $k]) {
            if count < N {
                scatter::<_, $quantity, T, $k, N>(self, first, count, values);
            } else {
                records::scatter(self, first, values);
            }
        }
    };
}

macro_rules! slice {
    ([$($generics:tt)*] $quantity:ty, $element:ty, $k:tt, |$components:ident| $structure:expr $(, $record:ident)?) => {
        impl<$($generics)*> Destination<$quantity, T, $k> for &mut [$element] {
            $(records!($record $quantity, $k);)?
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> usize {
                self.len()
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn split(self, middle: usize) -> (Self, Self) {
                self.split_at_mut(middle)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn put(&mut self, index: usize, $components: [T; $k]) {
                self[index] = $structure;
            }
        }
    };
}

slice!([Q, T: Element] Q, T, 1, |x| x[0]);
slice!([Q, T: BatchScalar] Q, Symmetric<T>, 6, |x| Symmetric { components: x }, record);
slice!([Q, T: Element] Q, [[T; 3]; 3], 9, |x| [[x[0], x[1], x[2]], [x[3], x[4], x[5]], [x[6], x[7], x[8]]], record);
slice!([Q, T: Element] Q, Matrix3<T>, 9, |x| matrix(x), record);
slice!([Q, T: Element] Q, Matrix3<T>, 6, |x| matrix([x[0], x[3], x[5], x[3], x[1], x[4], x[5], x[4], x[2]]));
slice!([T: BatchScalar] CauchyStress, CauchyStress<T>, 6, |x| CauchyStress(Symmetric { components: x }), record);
slice!([T: BatchScalar] KirchhoffStress, KirchhoffStress<T>, 6, |x| KirchhoffStress(Symmetric { components: x }), record);
slice!([T: BatchScalar] SecondPiola, SecondPiola<T>, 6, |x| SecondPiola(Symmetric { components: x }), record);
slice!([T: BatchScalar] FirstPiola, FirstPiola<T>, 9, |x| FirstPiola(matrix(x)), record);
slice!([T: BatchScalar] MandelStress, MandelStress<T>, 9, |x| MandelStress(matrix(x)), record);
slice!([T: BatchScalar] BiotStress, BiotStress<T>, 9, |x| BiotStress(matrix(x)), record);

impl<Q, T: Element, const K: usize> Destination<Q, T, K> for &mut [[T; K]] {
    records!(record Q, K);
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.len()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; K]) {
        self[index] = components;
    }
}

/// The matrix of nine components by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn matrix<T: Element>(rows: [T; 9]) -> Matrix3<T> {
    let [a, b, c, d, e, f, g, h, i] = transposed(rows);
    Matrix3::from_array_storage(nalgebra::ArrayStorage([[a, b, c], [d, e, f], [g, h, i]]))
}

impl<Q, T: Element> Destination<Q, T, 9> for ColumnMajor<&mut [[T; 9]]> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.0.len()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        let (head, tail) = self.0.split_at_mut(middle);
        (Self(head), Self(tail))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; 9]) {
        self.0[index] = transposed(components);
    }
}

impl<Q, T: Element, const K: usize> Destination<Q, T, K> for Strided<&mut [T], K> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.count
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        let place = (middle * self.stride).min(self.data.len());
        let (head, tail) = self.data.split_at_mut(place);
        (
            Self { data: head, stride: self.stride, places: self.places, count: middle },
            Self { data: tail, stride: self.stride, places: self.places, count: self.count - middle },
        )
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; K]) {
        let data = &mut self.data[index * self.stride..];
        for (place, component) in self.places.into_iter().zip(components) {
            data[place] = component;
        }
    }
}

impl<Q, T: Element, const K: usize, const B: usize> Destination<Q, T, K> for LaneBlocks<&mut [[[T; B]; K]]> {
    const IN_LANES: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.count
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        let (head, tail) = self.blocks.split_at_mut(middle / B);
        (Self { blocks: head, count: middle }, Self { blocks: tail, count: self.count - middle })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; K]) {
        let block = &mut self.blocks[index / B];
        let mut k = 0;
        while k < K {
            block[k][index % B] = components[k];
            k += 1;
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn store<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; K]) {
        if count < N {
            scatter::<_, Q, T, K, N>(self, first, count, values);
        } else if N <= B {
            prefetch_for_writing(self.blocks, first / B + ahead::<[[T; B]; K]>());
            let block = &mut self.blocks[first / B];
            let mut k = 0;
            while k < K {
                block[k].as_chunks_mut().0[first % B / N] = values[k].0;
                k += 1;
            }
        } else {
            for (part, block) in self.blocks[first / B..][..N / B].iter_mut().enumerate() {
                let mut k = 0;
                while k < K {
                    block[k].copy_from_slice(&values[k].0[part * B..][..B]);
                    k += 1;
                }
            }
        }
    }
}

impl<Q, T: Element, const K: usize> Destination<Q, T, K> for Components<&mut [T], K> {
    const IN_LANES: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.0[0].len()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        let mut rest = self.0;
        let head = core::array::from_fn(|k| {
            let (head, tail) = core::mem::take(&mut rest[k]).split_at_mut(middle);
            rest[k] = tail;
            head
        });
        (Self(head), Self(rest))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; K]) {
        for (array, component) in self.0.iter_mut().zip(components) {
            array[index] = component;
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn store<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; K]) {
        for (array, lanes) in self.0.iter_mut().zip(values) {
            lanes.store(&mut array[first..first + count]);
        }
    }
}

impl<'a, T, const K: usize> Components<&'a mut [T], K> {
    /// From an array for each component.
    ///
    /// # Errors
    /// [`BatchError::WrongLength`] when the arrays differ in length.
    pub fn new_mut(arrays: [&'a mut [T]; K]) -> Result<Self, BatchError> {
        let expected = arrays.first().map_or(0, |array| array.len());
        match arrays.iter().find(|array| array.len() != expected) {
            Some(odd) => Err(BatchError::WrongLength { quantity: "array of a component", found: odd.len(), expected }),
            None => Ok(Self(arrays)),
        }
    }
}
