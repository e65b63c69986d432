//! Points whose numbers lie side by side: they become lanes by a transposition in registers.

use nalgebra::Matrix3;
use piola_continuum::{
    BiotStress, CauchyStress, DeformationGradient, DisplacementGradient, FirstPiola, KirchhoffStress, MandelStress,
    SecondPiola,
};
use piola_numerics::{Element, Lanes, Real};
use piola_tensor::Symmetric;

/// The K numbers of a point as they lie in memory.
pub(super) trait Record<T, const K: usize> {
    /// Whether they are nine by columns.
    const BY_COLUMNS: bool = false;
    /// To be read.
    fn record(&self) -> &[T; K];
}

/// As [`Record`], to be written.
pub(super) trait RecordMut<T, const K: usize>: Record<T, K> {
    /// To be written.
    fn record_mut(&mut self) -> &mut [T; K];
}

impl<T, const K: usize> Record<T, K> for [T; K] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn record(&self) -> &[T; K] {
        self
    }
}

impl<T, const K: usize> RecordMut<T, K> for [T; K] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn record_mut(&mut self) -> &mut [T; K] {
        self
    }
}

impl<T> Record<T, 9> for [[T; 3]; 3] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn record(&self) -> &[T; 9] {
        &self.as_flattened().as_chunks().0[0]
    }
}

impl<T> RecordMut<T, 9> for [[T; 3]; 3] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn record_mut(&mut self) -> &mut [T; 9] {
        &mut self.as_flattened_mut().as_chunks_mut().0[0]
    }
}

macro_rules! records {
    ($k:literal, $by_columns:literal: $($name:ident [$($field:tt)*])*) => { $(
        impl<T: Element> Record<T, $k> for $name<T> {
            const BY_COLUMNS: bool = $by_columns;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn record(&self) -> &[T; $k] {
                self.$($field)*.record()
            }
        }

        impl<T: Element> RecordMut<T, $k> for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn record_mut(&mut self) -> &mut [T; $k] {
                self.$($field)*.record_mut()
            }
        }
    )* };
}
records!(9, true: Matrix3 [data.0] FirstPiola [0] MandelStress [0] BiotStress [0]);
records!(6, false: Symmetric [components] CauchyStress [0] KirchhoffStress [0] SecondPiola [0]);

macro_rules! deformations {
    ($($name:ident)*) => { $(
        impl<T: Real + Element> Record<T, 9> for $name<T> {
            const BY_COLUMNS: bool = true;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn record(&self) -> &[T; 9] {
                self.matrix().record()
            }
        }
    )* };
}
deformations!(DeformationGradient DisplacementGradient);

/// Reads N points from `first` on to lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn gather<R: Record<T, K>, T: Element, const K: usize, const N: usize>(
    points: &[R],
    first: usize,
    lanes: &mut [Lanes<T, N>; K],
) {
    let points = &points[first..first + N];
    let mut records = [points[0].record(); N];
    let mut lane = 1;
    while lane < N {
        records[lane] = points[lane].record();
        lane += 1;
    }
    if R::BY_COLUMNS {
        Lanes::gather::<K, 3>(records, lanes);
    } else {
        Lanes::gather::<K, 1>(records, lanes);
    }
}

/// Writes N lanes to the points from `first` on.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn scatter<R: RecordMut<T, K>, T: Element, const K: usize, const N: usize>(
    points: &mut [R],
    first: usize,
    lanes: &[Lanes<T, N>; K],
) {
    let Some(points) = points[first..].first_chunk_mut::<N>() else { return };
    let records = points.each_mut().map(R::record_mut);
    if R::BY_COLUMNS {
        Lanes::scatter::<K, 3>(lanes, records);
    } else {
        Lanes::scatter::<K, 1>(lanes, records);
    }
}
