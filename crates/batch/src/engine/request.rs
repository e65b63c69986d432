//! Requests to a batch: single outputs and tuples of them.

use piola_continuum::Deformation;
use piola_numerics::{Lanes, Mask, Real};
use piola_tensor::internal::check_finite;

use super::destinations::{Destination, scatter};
use super::point::Point;
use super::refusal::Refusal;
use super::scalar::BatchScalar;
use super::sources::{Source, fill};
use crate::BatchError;

/// A quantity with K components, of the deformation and I components of something else.
///
/// It may have parameters, as a constitutive law has, and it may refuse points.
///
/// # Example
/// One of your own: a multiple of J.
/// ```
/// use piola_batch as batch;
/// use piola_batch::{Point, Quantity, Request};
/// use piola_continuum::{Deformation, DeformationGradient};
/// use piola_numerics::Real;
///
/// #[derive(Clone, Copy)]
/// struct Weighted(f64);
/// impl Quantity<0, 1> for Weighted {
///     type Input = ();
///     type Output = Self;
///     const NEEDS_STRETCH: bool = false;
///     const INPUT: &'static str = "";
///     fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, _input: [T; 0]) -> [T; 1] {
///         [T::lit(self.0) * point.jacobian()]
///     }
/// }
///
/// let (f, mut densities) = ([DeformationGradient::dilatation(2.0)?; 5], [0.0; 5]);
/// batch::evaluate(&f[..], Request::new(Weighted(0.5), (), &mut densities[..]))?;
/// assert_eq!(densities, [4.0; 5]);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
pub trait Quantity<const I: usize, const K: usize>: Copy + Send + Sync {
    /// What the I components are.
    type Input;
    /// What the K components are.
    type Output;
    /// Whether the value is computed from the analysis of the stretches.
    const NEEDS_STRETCH: bool;
    /// Whether [`good`](Self::good) is false wherever F is no deformation. The engine forms no det F of its own then.
    const KNOWS_DEFORMATIONS: bool = false;
    /// What the I components are, for messages.
    const INPUT: &'static str;

    /// The value, at one point or in lanes: the formulas of the one-point types and no others.
    fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: [T; I]) -> [T; K];

    /// Mask of lanes whose value is certainly defined. [`check`](Self::check) runs on the others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exists<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>) -> T::Mask {
        Mask::splat(true)
    }

    /// As [`exists`](Self::exists), of the value too.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn good<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, _value: &[T; K]) -> T::Mask {
        self.exists(point)
    }

    /// Mask of lanes whose input certainly satisfies its condition. [`check_input`](Self::check_input) runs on the others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn admits<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, _input: &[T; I]) -> T::Mask {
        Mask::splat(true)
    }

    /// Refuses finite input that violates a condition, such as symmetry.
    ///
    /// # Errors
    /// What is wrong with it; most quantities take any finite input.
    fn check_input<T: Real, D: Deformation<T>>(&self, _deformation: &D, _input: &[T; I]) -> Result<(), BatchError> {
        Ok(())
    }

    /// Refuses a point that has no value.
    ///
    /// # Errors
    /// What is wrong there; most quantities exist at every deformation.
    fn check<T: Real, D: Deformation<T>>(&self, _deformation: &D) -> Result<(), Refusal> {
        Ok(())
    }
}

/// One output: what, from what beside the deformation, and where to.
///
/// Made by the functions of this crate, such as [`green_strain`](crate::green_strain).
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola};
/// let (f, stress) = (DeformationGradient::diagonal([2.0, 0.5, 0.5])?, [CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?]);
/// let mut converted = [FirstPiola::zero()];
/// let request = batch::cauchy_to_first_piola(&stress[..], &mut converted[..]);
/// assert_eq!(request.at(&f, 0)[0], 2.0); // by rows
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Request<Q, S, V, const I: usize, const K: usize> {
    pub(super) quantity: Q,
    pub(super) source: S,
    pub(super) to: V,
}

impl<Q: Quantity<I, K>, S, V, const I: usize, const K: usize> Request<Q, S, V, I, K> {
    /// A quantity, the source of its input (`()` where it needs none) and its destination.
    #[must_use]
    pub const fn new(quantity: Q, source: S, to: V) -> Self {
        Self { quantity, source, to }
    }
}

impl<Q, S, V, const I: usize, const K: usize> Request<Q, S, V, I, K> {
    /// What a batch would write at one point: from the deformation there, and the input of the request at an index.
    ///
    /// To look into a batch, or to try a quantity of one's own; of a million points [`evaluate`](crate::evaluate) is the
    /// way. Nothing is written, and nothing is checked.
    ///
    /// # Accuracy
    /// The numbers of a batch, but for elementary functions, which are those of the standard library here.
    ///
    /// # Panics
    /// When the source has no such index.
    #[must_use]
    pub fn at<T: BatchScalar, D: Deformation<T> + Copy>(&self, deformation: &D, index: usize) -> [T; K]
    where
        Q: Quantity<I, K>,
        S: Source<Q::Input, T, I>,
        V: Destination<Q::Output, T, K>,
    {
        let point = Point { deformation: *deformation, jacobian: None, stretch: None };
        self.quantity.of(&point, self.source.point(index))
    }
}

/// Outputs to be computed together: a [`Request`] or a tuple of up to eight.
///
/// What is not in the tuple is not computed, what several of them need is computed once; both are decided when the
/// program is compiled.
pub trait Requests<T: BatchScalar>: Send + Sized {
    /// Whether an output is computed from the analysis of the stretches.
    const NEEDS_STRETCH: bool;
    /// Whether all outputs know by themselves where F is no deformation.
    #[doc(hidden)]
    const KNOWS_DEFORMATIONS: bool;

    /// Whether all views have the length of the batch.
    ///
    /// # Errors
    /// [`BatchError::WrongLength`].
    fn check_lengths(&self, expected: usize) -> Result<(), BatchError>;

    /// The requests for the first `middle` points and for the rest.
    fn split(self, middle: usize) -> (Self, Self);

    /// Whether all views hold lanes as they are computed with.
    #[doc(hidden)]
    const IN_LANES: bool;

    /// Whether the numbers of a point lie side by side in all views.
    #[doc(hidden)]
    const RECORDS: bool;

    /// How many components all outputs have.
    #[doc(hidden)]
    const COMPONENTS: usize;

    /// Memory for the inputs and outputs of N points, a point a lane.
    #[doc(hidden)]
    type Buffers<const N: usize>: Copy;

    /// Memory for a block.
    #[doc(hidden)]
    fn buffers<const N: usize>() -> Self::Buffers<N>;

    /// Reads the inputs of `count` ≤ N points from `first` on; in registers or point by point where they lie not in
    /// lanes.
    #[doc(hidden)]
    fn load<const N: usize>(&self, first: usize, count: usize, buffers: &mut Self::Buffers<N>, in_registers: bool);

    /// Computes the outputs in lanes; tells in which lanes the input is finite and the quantities exist.
    #[doc(hidden)]
    fn compute<const N: usize, D: Deformation<Lanes<T, N>>>(
        &self,
        point: &Point<Lanes<T, N>, D>,
        buffers: &mut Self::Buffers<N>,
    ) -> <Lanes<T, N> as Real>::Mask;

    /// As [`load`](Self::load) from `first` on, [`compute`](Self::compute) and [`store`](Self::store) from `at` on of N
    /// points, without memory between them.
    #[doc(hidden)]
    fn pass<const N: usize, D: Deformation<Lanes<T, N>>>(
        &mut self,
        first: usize,
        at: usize,
        point: &Point<Lanes<T, N>, D>,
    ) -> <Lanes<T, N> as Real>::Mask;

    /// Writes the outputs of `count` ≤ N points to the destination's points from `at` on.
    #[doc(hidden)]
    fn store<const N: usize>(&mut self, at: usize, count: usize, buffers: &Self::Buffers<N>, in_registers: bool);

    /// Whether the input of a point is finite and what it is taken for, and the quantities exist there.
    ///
    /// # Errors
    /// [`BatchError::NotFinite`], [`BatchError::Refused`], and those of [`Quantity::check_input`].
    fn check<D: Deformation<Lanes<T, 1>>>(&self, index: usize, deformation: &D) -> Result<(), BatchError>;

    /// Writes NaN at a point.
    fn void(&mut self, at: usize);
}

impl<Q, S, V, const I: usize, const K: usize> Request<Q, S, V, I, K> {
    /// Where the input is finite and the quantity exists.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn good<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, input: &[T; I], value: &[T; K]) -> T::Mask
    where
        Q: Quantity<I, K>,
    {
        let exists = self.quantity.good(point, value);
        if I == 0 {
            return exists;
        }
        // x − x is zero but for ∞ and NaN.
        let mut nothing = T::zero();
        let mut i = 0;
        while i < I {
            #[expect(clippy::eq_op, reason = "the difference is zero but for infinity and NaN")]
            let difference = input[i] - input[i];
            nothing += difference;
            i += 1;
        }
        exists & nothing.is_finite() & self.quantity.admits(point, input)
    }
}

impl<T, Q, S, V, const I: usize, const K: usize> Requests<T> for Request<Q, S, V, I, K>
where
    T: BatchScalar,
    Q: Quantity<I, K>,
    S: Source<Q::Input, T, I>,
    V: Destination<Q::Output, T, K>,
{
    const NEEDS_STRETCH: bool = Q::NEEDS_STRETCH;
    const KNOWS_DEFORMATIONS: bool = Q::KNOWS_DEFORMATIONS;
    const IN_LANES: bool = S::IN_LANES && V::IN_LANES;
    const RECORDS: bool = S::RECORDS && V::RECORDS;
    const COMPONENTS: usize = K;

    fn check_lengths(&self, expected: usize) -> Result<(), BatchError> {
        let read = self.source.count().unwrap_or(expected);
        if read != expected {
            return Err(BatchError::WrongLength { quantity: Q::INPUT, found: read, expected });
        }
        let written = self.to.count();
        if written != expected {
            return Err(BatchError::WrongLength { quantity: "destination of a batch", found: written, expected });
        }
        Ok(())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        let Self { quantity, source, to } = self;
        let (head, tail) = to.split(middle);
        (Self { quantity, source, to: head }, Self { quantity, source, to: tail })
    }

    type Buffers<const N: usize> = ([Lanes<T, N>; I], [Lanes<T, N>; K]);

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn buffers<const N: usize>() -> Self::Buffers<N> {
        ([Lanes([T::zero(); N]); I], [Lanes([T::zero(); N]); K])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load<const N: usize>(&self, first: usize, count: usize, buffers: &mut Self::Buffers<N>, in_registers: bool) {
        if S::IN_LANES {
            buffers.0 = self.source.load::<N>(first, count);
        } else if 0 < I && in_registers {
            self.source.gather(first, count, &mut buffers.0);
        } else if 0 < I {
            fill(&self.source, first, count, &mut buffers.0);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn compute<const N: usize, D: Deformation<Lanes<T, N>>>(
        &self,
        point: &Point<Lanes<T, N>, D>,
        buffers: &mut Self::Buffers<N>,
    ) -> <Lanes<T, N> as Real>::Mask {
        let value = self.quantity.of(point, buffers.0);
        buffers.1 = value;
        self.good(point, &buffers.0, &value)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pass<const N: usize, D: Deformation<Lanes<T, N>>>(
        &mut self,
        first: usize,
        at: usize,
        point: &Point<Lanes<T, N>, D>,
    ) -> <Lanes<T, N> as Real>::Mask {
        let input = self.source.load::<N>(first, N);
        let value = self.quantity.of(point, input);
        let good = self.good(point, &input, &value);
        self.to.store(at, N, &value);
        good
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn store<const N: usize>(&mut self, at: usize, count: usize, buffers: &Self::Buffers<N>, in_registers: bool) {
        if V::IN_LANES {
            self.to.store(at, count, &buffers.1);
        } else if in_registers {
            self.to.scatter(at, count, &buffers.1);
        } else {
            scatter(&mut self.to, at, count, &buffers.1);
        }
    }

    fn check<D: Deformation<Lanes<T, 1>>>(&self, index: usize, deformation: &D) -> Result<(), BatchError> {
        if 0 < I {
            self.source.check(Q::INPUT, index)?;
            let input = self.source.point(index);
            check_finite(Q::INPUT, &input)?;
            self.quantity.check_input(deformation, &input.map(|x| Lanes([x])))?;
        }
        self.quantity.check(deformation).map_err(BatchError::Refused)
    }

    fn void(&mut self, at: usize) {
        self.to.put(at, [T::lit(f64::NAN); K]);
    }
}

macro_rules! tuple {
    ($($name:ident $place:tt),+) => {
        impl<T: BatchScalar, $($name: Requests<T>),+> Requests<T> for ($($name,)+) {
            const NEEDS_STRETCH: bool = $($name::NEEDS_STRETCH)|+;
            const KNOWS_DEFORMATIONS: bool = $($name::KNOWS_DEFORMATIONS)&+;
            const IN_LANES: bool = $($name::IN_LANES)&+;
            const RECORDS: bool = $($name::RECORDS)&+;
            const COMPONENTS: usize = 0 $(+ $name::COMPONENTS)+;

            fn check_lengths(&self, expected: usize) -> Result<(), BatchError> {
                $(self.$place.check_lengths(expected)?;)+
                Ok(())
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn split(self, middle: usize) -> (Self, Self) {
                let parts = ($(self.$place.split(middle),)+);
                (($(parts.$place.0,)+), ($(parts.$place.1,)+))
            }

            type Buffers<const N: usize> = ($($name::Buffers<N>,)+);

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn buffers<const N: usize>() -> Self::Buffers<N> {
                ($($name::buffers::<N>(),)+)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn load<const N: usize>(
                &self,
                first: usize,
                count: usize,
                buffers: &mut Self::Buffers<N>,
                in_registers: bool,
            ) {
                $(self.$place.load(first, count, &mut buffers.$place, in_registers);)+
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn compute<const N: usize, De: Deformation<Lanes<T, N>>>(
                &self,
                point: &Point<Lanes<T, N>, De>,
                buffers: &mut Self::Buffers<N>,
            ) -> <Lanes<T, N> as Real>::Mask {
                let mut good: <Lanes<T, N> as Real>::Mask = Mask::splat(true);
                $(good = good & self.$place.compute(point, &mut buffers.$place);)+
                good
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn pass<const N: usize, De: Deformation<Lanes<T, N>>>(
                &mut self,
                first: usize,
                at: usize,
                point: &Point<Lanes<T, N>, De>,
            ) -> <Lanes<T, N> as Real>::Mask {
                let mut good: <Lanes<T, N> as Real>::Mask = Mask::splat(true);
                $(good = good & self.$place.pass(first, at, point);)+
                good
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn store<const N: usize>(
                &mut self,
                at: usize,
                count: usize,
                buffers: &Self::Buffers<N>,
                in_registers: bool,
            ) {
                $(self.$place.store(at, count, &buffers.$place, in_registers);)+
            }

            fn check<De: Deformation<Lanes<T, 1>>>(
                &self,
                index: usize,
                deformation: &De,
            ) -> Result<(), BatchError> {
                $(self.$place.check(index, deformation)?;)+
                Ok(())
            }

            fn void(&mut self, at: usize) {
                $(self.$place.void(at);)+
            }
        }
    };
}
tuple!(A 0);
tuple!(A 0, B 1);
tuple!(A 0, B 1, C 2);
tuple!(A 0, B 1, C 2, D 3);
tuple!(A 0, B 1, C 2, D 3, E 4);
tuple!(A 0, B 1, C 2, D 3, E 4, F 5);
tuple!(A 0, B 1, C 2, D 3, E 4, F 5, G 6);
tuple!(A 0, B 1, C 2, D 3, E 4, F 5, G 6, H 7);
