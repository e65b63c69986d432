//! Sources of several quantities, side by side: a stress and a tangent, two directions.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::rates::{GradientRate, VelocityGradient};
use piola_continuum::stress::tangents::{MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, SecondPiola};
use piola_numerics::{Element, Lanes};
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::Rows;

use super::destinations::Destination;
use super::scalar::BatchScalar;
use super::sources::{Source, by_rows};
use crate::BatchError;

/// Nine components by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn flat<T: Copy>([[a, b, c], [d, e, f], [g, h, i]]: Rows<T>) -> [T; 9] {
    [a, b, c, d, e, f, g, h, i]
}

/// Three rows of nine components.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn rows<T: Copy>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> Rows<T> {
    [[a, b, c], [d, e, f], [g, h, i]]
}

/// A tuple of sources is a source of the components of all of them, one after the other.
macro_rules! tuples {
    ($($($name:ident $quantity:ty, $place:tt [$k:literal]);+ => $total:literal;)*) => { $(
        impl<T, $($name),+> Source<($($quantity,)+), T, $total> for ($($name,)+)
        where
            T: Element,
            $($name: Source<$quantity, T, $k>,)+
        {
            fn count(&self) -> Option<usize> {
                let counts = [$(self.$place.count()),+];
                // Parts of different lengths are as long as no batch.
                if counts.iter().all(|count| *count == counts[0]) { counts[0] } else { Some(usize::MAX) }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn point(&self, index: usize) -> [T; $total] {
                let (mut all, mut at) = ([T::zero(); $total], 0);
                $(at = put(&mut all, at, self.$place.point(index));)+
                debug_assert_eq!(at, $total);
                all
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn load<const N: usize>(&self, first: usize, count: usize) -> [Lanes<T, N>; $total] {
                let (mut all, mut at) = ([Lanes([T::zero(); N]); $total], 0);
                $(at = put(&mut all, at, self.$place.load::<N>(first, count));)+
                debug_assert_eq!(at, $total);
                all
            }
            fn check(&self, quantity: &'static str, index: usize) -> Result<(), BatchError> {
                $(self.$place.check(quantity, index)?;)+
                Ok(())
            }
        }
    )* };
}

/// Writes a part and says where the next begins.
#[cfg_attr(not(debug_assertions), inline(always))]
fn put<X: Copy, const K: usize, const TOTAL: usize>(all: &mut [X; TOTAL], at: usize, part: [X; K]) -> usize {
    let mut k = 0;
    while k < K {
        all[at + k] = part[k];
        k += 1;
    }
    at + K
}

/// Components of a part of the input.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn part<X: Copy, const K: usize, const TOTAL: usize>(all: &[X; TOTAL], at: usize) -> [X; K] {
    let mut part = [all[at]; K];
    let mut k = 0;
    while k < K {
        part[k] = all[at + k];
        k += 1;
    }
    part
}

tuples! {
    A Symmetric, 0 [6]; B Symmetric, 1 [6] => 12;
    A Matrix3<f64>, 0 [9]; B Matrix3<f64>, 1 [9] => 18;
    A Symmetric, 0 [6]; B Matrix3<f64>, 1 [9] => 15;
    A SecondPiola, 0 [6]; B MaterialTangent, 1 [21] => 27;
    A CauchyStress, 0 [6]; B TruesdellTangent, 1 [21] => 27;
}

impl<Q, T: Element> Source<Q, T, 3> for &[Vector3<T>] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 3] {
        let [[x, y, z]] = self[index].data.0;
        [x, y, z]
    }
}

impl<Q, T: Element> Destination<Q, T, 3> for &mut [Vector3<T>] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.len()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, [x, y, z]: [T; 3]) {
        self[index] = Vector3::new(x, y, z);
    }
}

/// Rates as sources.
macro_rules! typed {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 9> for &[$name<T>] {
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
typed!(GradientRate VelocityGradient);
