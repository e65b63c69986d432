//! Push-forward and pull-back of tangents.

use piola_numerics::Real;

use super::point::Point;
use super::requests::{Quantity, Request};
use super::{BatchScalar, Destination, Source};
use crate::Deformation;
use crate::stress::tangents::{FirstPiolaTangent, LieTangent, MaterialTangent, TruesdellTangent};
use crate::tensor::MajorSymmetric;

macro_rules! tangents {
    ($($(#[$documentation:meta])* $function:ident $name:ident $from:ident $method:ident $to:ident;)*) => { $(
        $(#[$documentation])*
        #[must_use]
        pub fn $function<S, V>(tangent: S, to: V) -> Request<$name, S, V, 21, 21> {
            Request { quantity: $name, source: tangent, to }
        }

        #[doc = concat!("The output of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Quantity<21, 21> for $name {
            type Input = $from;
            type Output = $to;
            const NEEDS_STRETCH: bool = false;
            const INPUT: &'static str = stringify!($from);

            #[inline(always)]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, components: [T; 21]) -> [T; 21] {
                $from::<T>(MajorSymmetric { components }).$method(point).0.components
            }
        }
    )* };
}

tangents! {
    /// c = `F_iA F_jB F_kC F_lD C_ABCD`, the push-forward of ∂S/∂E: see [`MaterialTangent::lie`].
    ///
    /// # Example
    /// ```
    /// use piola_continuum::batch;
    /// use piola_continuum::{DeformationGradient, tensor::MajorSymmetric};
    /// let f = [DeformationGradient::diagonal([2.0, 1.0, 1.0])?];
    /// let (material, mut spatial) = ([MajorSymmetric::isotropic(1.0, 1.0)], [MajorSymmetric::zero()]);
    /// batch::evaluate(&f[..], batch::push_forward_tangent(&material[..], &mut spatial[..]))?;
    /// assert_eq!(spatial[0].components[0], 48.0); // 2⁴ × 3
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    push_forward_tangent PushForwardTangent MaterialTangent lie LieTangent;
    /// c/J: see [`MaterialTangent::truesdell`].
    truesdell_tangent TruesdellTangentOutput MaterialTangent truesdell TruesdellTangent;
    /// ∂S/∂E of c, the pull-back: see [`LieTangent::material`].
    pull_back_tangent PullBackTangent LieTangent material MaterialTangent;
}

impl<Q, T: BatchScalar> Source<Q, T, 21> for &[MajorSymmetric<T>] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }
    #[inline(always)]
    fn point(&self, index: usize) -> [T; 21] {
        self[index].components
    }
}

impl<Q, T: BatchScalar> Destination<Q, T, 21> for &mut [MajorSymmetric<T>] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[inline(always)]
    fn put(&mut self, index: usize, components: [T; 21]) {
        self[index] = MajorSymmetric { components };
    }
}

macro_rules! typed {
    ($($name:ident)*) => { $(
        impl<T: BatchScalar> Source<$name, T, 21> for &[$name<T>] {
            #[inline(always)]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[inline(always)]
            fn point(&self, index: usize) -> [T; 21] {
                self[index].0.components
            }
        }

        impl<T: BatchScalar> Destination<$name, T, 21> for &mut [$name<T>] {
            #[inline(always)]
            fn count(&self) -> usize {
                self.len()
            }
            #[inline(always)]
            fn split(self, middle: usize) -> (Self, Self) {
                self.split_at_mut(middle)
            }
            #[inline(always)]
            fn put(&mut self, index: usize, components: [T; 21]) {
                self[index] = $name(MajorSymmetric { components });
            }
        }
    )* };
}
typed!(MaterialTangent LieTangent TruesdellTangent);

/// All 81 entries of ∂P/∂F, those of a pair of indices `iA` a row.
impl<T: BatchScalar> Destination<FirstPiolaTangent, T, 81> for &mut [FirstPiolaTangent<T>] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }
    #[inline(always)]
    fn split(self, middle: usize) -> (Self, Self) {
        self.split_at_mut(middle)
    }
    #[inline(always)]
    fn put(&mut self, index: usize, components: [T; 81]) {
        let entries = &mut self[index].0.components;
        for (row, values) in entries.iter_mut().zip(components.as_chunks::<9>().0) {
            *row = *values;
        }
    }
}
