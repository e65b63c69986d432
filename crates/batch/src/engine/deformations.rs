//! The deformations of many points: typed ones, and numbers with a meaning.

use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_numerics::{Lanes, Real};

use super::parts::rows;
use super::records::gather;
use super::scalar::BatchScalar;
use super::sources::{Source, by_rows, fill};
use crate::BatchError;

/// The deformations of many points.
///
/// | you have | write | checked |
/// |---|---|---|
/// | `&[DeformationGradient<T>]`, `&[DisplacementGradient<T>]` | the slice itself | when they were made |
/// | F in any [`Source`] of nine components | [`Gradients`] | 0 < det F < ∞ at every point |
/// | ∇u in any [`Source`] of nine components | [`Displacements`] | so too |
/// | stresses alone | [`Undeformed`] | |
pub trait Deformations<T: BatchScalar>: Copy + Send + Sync {
    /// One point, or one in each lane.
    type Point<S: Real>: Deformation<S>;
    /// Whether 0 < det F < ∞ is known.
    const TRUSTED: bool;
    /// Whether they lie in lanes as they are computed with: see [`Source::IN_LANES`].
    const IN_LANES: bool = false;
    /// As [`Source::RECORDS`].
    #[doc(hidden)]
    const RECORDS: bool = false;

    /// The number of points.
    fn count(&self) -> usize;

    /// The deformations at `count` ≤ N points from `first` on, a point a lane.
    fn load<const N: usize>(&self, first: usize, count: usize) -> Self::Point<Lanes<T, N>>;

    /// As [`load`](Self::load), into memory from which [`filled`](Self::filled) makes the deformations.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fill<const N: usize>(&self, _first: usize, _count: usize, _lanes: &mut [Lanes<T, N>; 9], _in_registers: bool) {}

    /// The deformations that [`fill`](Self::fill) has read.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn filled<const N: usize>(&self, first: usize, count: usize, _lanes: [Lanes<T, N>; 9]) -> Self::Point<Lanes<T, N>> {
        self.load(first, count)
    }

    /// What is wrong with a point.
    ///
    /// # Errors
    /// [`BatchError::NotFinite`], [`ContinuumError::NonPositiveJacobian`](piola_continuum::ContinuumError::NonPositiveJacobian).
    fn check(&self, index: usize) -> Result<(), BatchError>;
}

/// Deformation gradients F that may be anything: each point is checked.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_batch::BatchError;
/// use piola_batch as batch;
/// use piola_batch::Gradients;
/// let f = [Matrix3::identity() * 2.0, Matrix3::zeros(), Matrix3::identity() * 3.0];
/// let mut j = [0.0_f64; 3];
/// let result = batch::evaluate(Gradients(&f[..]), batch::jacobian(&mut j[..]));
/// let Err(BatchError::BadPoints { points, .. }) = result else { unreachable!() };
/// assert_eq!((points.len(), points[0].index), (1, 1));
/// assert_eq!((j[0], j[1].is_nan(), j[2]), (8.0, true, 27.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Gradients<S>(
    /// Nine components, by rows, at each point.
    pub S,
);

/// Displacement gradients ∇u = F − 1 that may be anything: each point is checked.
///
/// # Example
/// ```
/// use piola_continuum::Symmetric;
/// use piola_batch as batch;
/// use piola_batch::Displacements;
/// let gradients = [[[1e-20, 0.0, 0.0], [0.0; 3], [0.0; 3]]];
/// let mut strains = [Symmetric::zero()];
/// batch::evaluate(Displacements(&gradients[..]), batch::green_strain(&mut strains[..]))?;
/// assert_eq!(strains[0].components[0], 1e-20);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Displacements<S>(
    /// Nine components, by rows, at each point.
    pub S,
);

/// So many points of which no deformation is needed: invariants of stresses.
///
/// # Example
/// ```
/// use piola_continuum::CauchyStress;
/// use piola_batch as batch;
/// use piola_batch::Undeformed;
/// let stresses = [CauchyStress::new(250.0, 0.0, 0.0, 0.0, 0.0, 0.0)?];
/// let mut equivalent = [0.0];
/// batch::evaluate(Undeformed(1), batch::von_mises(&stresses[..], &mut equivalent[..]))?;
/// assert_eq!(equivalent, [250.0]);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Undeformed(
    /// The number of points.
    pub usize,
);

/// Numbers that may be anything: each point is checked.
macro_rules! unchecked {
    ($view:ident $name:ident) => {
        impl<T: BatchScalar, S: Source<$name, T, 9>> Deformations<T> for $view<S> {
            type Point<U: Real> = $name<U>;
            const TRUSTED: bool = false;
            const IN_LANES: bool = S::IN_LANES;
            const RECORDS: bool = S::RECORDS;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> usize {
                self.0.count().unwrap_or(0)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn load<const N: usize>(&self, first: usize, count: usize) -> $name<Lanes<T, N>> {
                $name::trusted(rows(self.0.load(first, count)))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fill<const N: usize>(
                &self,
                first: usize,
                count: usize,
                lanes: &mut [Lanes<T, N>; 9],
                in_registers: bool,
            ) {
                if in_registers {
                    self.0.gather(first, count, lanes);
                } else {
                    fill(&self.0, first, count, lanes);
                }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn filled<const N: usize>(
                &self,
                _first: usize,
                _count: usize,
                lanes: [Lanes<T, N>; 9],
            ) -> Self::Point<Lanes<T, N>> {
                $name::trusted(rows(lanes))
            }
            fn check(&self, index: usize) -> Result<(), BatchError> {
                $name::from_rows(rows(self.0.point(index)))?;
                Ok(())
            }
        }
    };
}
unchecked!(Gradients DeformationGradient);
unchecked!(Displacements DisplacementGradient);

macro_rules! typed {
    ($name:ident) => {
        impl<T: BatchScalar> Source<$name, T, 9> for &[$name<T>] {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> Option<usize> {
                Some(self.len())
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn point(&self, index: usize) -> [T; 9] {
                by_rows(self[index].matrix())
            }
            const RECORDS: bool = true;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn gather<const N: usize>(&self, first: usize, count: usize, lanes: &mut [Lanes<T, N>; 9]) {
                if count < N {
                    fill::<_, $name, T, 9, N>(self, first, count, lanes);
                } else {
                    gather(self, first, lanes);
                }
            }
        }

        impl<T: BatchScalar> Deformations<T> for &[$name<T>] {
            type Point<U: Real> = $name<U>;
            const TRUSTED: bool = true;
            const RECORDS: bool = true;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn count(&self) -> usize {
                self.len()
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn load<const N: usize>(&self, first: usize, count: usize) -> $name<Lanes<T, N>> {
                $name::trusted(rows(Source::<$name, T, 9>::load(self, first, count)))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fill<const N: usize>(
                &self,
                first: usize,
                count: usize,
                lanes: &mut [Lanes<T, N>; 9],
                in_registers: bool,
            ) {
                if in_registers {
                    Source::<$name, T, 9>::gather(self, first, count, lanes);
                } else {
                    fill::<_, $name, T, 9, N>(self, first, count, lanes);
                }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn filled<const N: usize>(
                &self,
                _first: usize,
                _count: usize,
                lanes: [Lanes<T, N>; 9],
            ) -> Self::Point<Lanes<T, N>> {
                $name::trusted(rows(lanes))
            }
            fn check(&self, _index: usize) -> Result<(), BatchError> {
                Ok(())
            }
        }
    };
}
typed!(DeformationGradient);
typed!(DisplacementGradient);

impl<T: BatchScalar> Deformations<T> for Undeformed {
    type Point<U: Real> = DeformationGradient<U>;
    const TRUSTED: bool = true;
    const IN_LANES: bool = true;
    const RECORDS: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load<const N: usize>(&self, _first: usize, _count: usize) -> DeformationGradient<Lanes<T, N>> {
        DeformationGradient::identity()
    }
    fn check(&self, _index: usize) -> Result<(), BatchError> {
        Ok(())
    }
}
