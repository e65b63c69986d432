//! Arrays of tangents as sources and destinations.

use piola_continuum::stress::tangents::{
    FirstPiolaTangent, JaumannTangent, LieTangent, MaterialTangent, TruesdellTangent,
};
use piola_numerics::Real;
use piola_tensor::{FourthOrder, MajorSymmetric, MinorSymmetric};

use super::destinations::Destination;
use super::scalar::BatchScalar;
use super::sources::Source;

/// The entries of nine rows of nine.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn entries<T: Real>(tensor: &FourthOrder<T>) -> [T; 81] {
    let mut entries = [T::zero(); 81];
    let mut k = 0;
    while k < 81 {
        entries[k] = tensor.components[k / 9][k % 9];
        k += 1;
    }
    entries
}

impl<Q, T: BatchScalar> Destination<Q, T, 36> for &mut [MinorSymmetric<T>] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.len()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; 36]) {
        for (row, values) in self[index].components.iter_mut().zip(components.as_chunks::<6>().0) {
            *row = *values;
        }
    }
}

impl<T: BatchScalar> Source<FirstPiolaTangent, T, 81> for &[FirstPiolaTangent<T>] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 81] {
        entries(&self[index].0)
    }
}

impl<Q, T: BatchScalar> Source<Q, T, 21> for &[MajorSymmetric<T>] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn point(&self, index: usize) -> [T; 21] {
        self[index].components
    }
}

impl<Q, T: BatchScalar> Destination<Q, T, 21> for &mut [MajorSymmetric<T>] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.len()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; 21]) {
        self[index] = MajorSymmetric { components };
    }
}

macro_rules! typed {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 21> for &[$name<T>] {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn point(&self, index: usize) -> [T; 21] {
                self[index].0.components
            }
        }

        impl<T: BatchScalar> Destination<$name, T, 21> for &mut [$name<T>] {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> usize {
                self.len()
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn split(self, middle: usize) -> (Self, Self) {
                self.split_at_mut(middle)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn put(&mut self, index: usize, components: [T; 21]) {
                self[index] = $name(MajorSymmetric { components });
            }
        }
    )* };
}
typed!(MaterialTangent LieTangent TruesdellTangent JaumannTangent);

/// All 81 entries of ∂P/∂F, those of a pair of indices `iA` a row.
impl<T: BatchScalar> Destination<FirstPiolaTangent, T, 81> for &mut [FirstPiolaTangent<T>] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.len()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, components: [T; 81]) {
        let entries = &mut self[index].0.components;
        for (row, values) in entries.iter_mut().zip(components.as_chunks::<9>().0) {
            *row = *values;
        }
    }
}
