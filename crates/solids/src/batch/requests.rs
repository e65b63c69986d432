//! Requests of the energy and the stresses.

use piola_batch::{Point, Quantity, Refusal, Request};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Mask, Real};

use crate::Hyperelastic;
use crate::SolidsError;

/// Nine components by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn flat<T: Real>(stress: &FirstPiola<T>) -> [T; 9] {
    let [[a, b, c], [d, e, f], [g, h, i]] = rows_of(&stress.0);
    [a, b, c, d, e, f, g, h, i]
}

/// All lanes of a block whose deformations the law accepts, or none: each point is asked then.
#[cfg_attr(not(debug_assertions), inline(always))]
fn accepted<T: Real, L: Hyperelastic>(law: &L, deformation: &impl Deformation<T>) -> T::Mask {
    // The error is moved out where there is one: a result is dropped by a function that is not compiled for lanes.
    match law.check(deformation) {
        Ok(()) => Mask::splat(true),
        Err(error) => refused(error),
    }
}

#[cold]
#[inline(never)]
fn refused<M: Mask>(error: SolidsError) -> M {
    drop(error);
    M::splat(false)
}

/// Lanes that the law accepts, by the answer itself where that tells; an answer beyond the range of the scalar is none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn answered<T: Real, L: Hyperelastic, const K: usize>(
    law: &L,
    deformation: &impl Deformation<T>,
    answer: &[T; K],
) -> T::Mask {
    // Where it refuses the first component is not finite if this says so.
    let finite = answer[0].is_finite();
    if L::REFUSED_IS_NOT_FINITE { finite } else { finite & accepted(law, deformation) }
}

/// Refuses an answer whose first component is not finite.
pub(super) fn within_range<T: Real, const K: usize>(answer: &[T; K], name: &'static str) -> Result<(), Refusal> {
    if answer[0].is_finite().all() { Ok(()) } else { Err(Refusal::new(SolidsError::Overflow { answer: name })) }
}

macro_rules! quantities {
    (@knows $law:ident knows) => {
        $law::KNOWS_DEFORMATIONS
    };
    (@knows $law:ident) => {
        false
    };
    ($($(#[$documentation:meta])* $visibility:vis $function:ident $name:ident [$k:literal $($knows:ident)?] $output:ty, |$law:ident, $point:ident| $value:expr;)*) => { $(
        $(#[$documentation])*
        #[must_use]
        $visibility fn $function<L: Hyperelastic + Sync, V>(law: &L, to: V) -> Request<$name<'_, L>, (), V, 0, $k> {
            Request::new($name(law), (), to)
        }

        #[doc = concat!("The output of `", stringify!($function), "`.")]
        #[derive(Debug)]
        pub struct $name<'a, L>(&'a L);

        impl<L> Clone for $name<'_, L> {
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<L> Copy for $name<'_, L> {}

        impl<L: Hyperelastic + Sync> Quantity<0, $k> for $name<'_, L> {
            type Input = ();
            type Output = $output;
            const NEEDS_STRETCH: bool = false;
            const KNOWS_DEFORMATIONS: bool = $crate::batch::requests::quantities!(@knows L $($knows)?);
            const INPUT: &'static str = "";

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn of<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, _input: [T; 0]) -> [T; $k] {
                Self::answer(self.0, point)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn good<T: Real, D: Deformation<T>>(&self, point: &Point<T, D>, value: &[T; $k]) -> T::Mask {
                $crate::batch::requests::answered(self.0, point, value)
            }

            fn check<T: Real, D: Deformation<T>>(&self, deformation: &D) -> Result<(), Refusal> {
                self.0.check(deformation).map_err(Refusal::new)?;
                $crate::batch::requests::within_range(&Self::answer(self.0, deformation), stringify!($function))
            }
        }

        impl<L: Hyperelastic> $name<'_, L> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn answer<T: Real>($law: &L, $point: &impl Deformation<T>) -> [T; $k] {
                $value
            }
        }
    )* };
}
pub(super) use quantities;

quantities! {
    /// W(F) − W(1): see [`Hyperelastic::energy`].
    pub energy EnergyOf [1] EnergyOf<'static, ()>, |law, point| [law.energy(point)];
    /// P: see [`Hyperelastic::first_piola`].
    pub first_piola FirstPiolaOf [9 knows] FirstPiola, |law, point| flat(&law.first_piola(point));
    /// S: see [`Hyperelastic::second_piola`].
    pub second_piola SecondPiolaOf [6] SecondPiola, |law, point| law.second_piola(point).0.components;
    /// τ: see [`Hyperelastic::kirchhoff`].
    pub kirchhoff KirchhoffOf [6] KirchhoffStress, |law, point| law.kirchhoff(point).0.components;
    /// T: see [`Hyperelastic::cauchy`].
    pub cauchy CauchyOf [6] CauchyStress, |law, point| law.cauchy(point).0.components;
}
