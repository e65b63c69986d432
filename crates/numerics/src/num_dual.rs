//! [`Real`] for the dual numbers of the `num-dual` crate, over f64 and f32.
//!
//! A formula of Piola can so be differentiated with that crate, for instance as an independent check. Its
//! types compare by their real part alone, which `Real` wants too, and so does their `is_zero`.
//!
//! Two functions are completed here: `atan2`, which `num-dual` differentiates through y/x and so not at
//! x = 0, and powers with an exponent that is a constant, which need no logarithm of the base.

use nalgebra::{Const, Scalar};
use num_dual::{Derivative, Dual, Dual2, Dual2Vec, Dual3, DualNum, DualVec, HyperDual, HyperDualVec, HyperHyperDual};
use num_traits::{Signed, Zero};

use crate::Real;

/// Whether a derivative part is zero altogether.
trait Vanishes {
    fn vanishes(&self) -> bool;
}

impl Vanishes for f64 {
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
}

impl Vanishes for f32 {
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
}

impl<T: Scalar + Zero, const R: usize, const C: usize> Vanishes for Derivative<T, Const<R>, Const<C>> {
    fn vanishes(&self) -> bool {
        self.0.as_ref().is_none_or(|parts| parts.iter().all(Zero::is_zero))
    }
}

/// Functions of one number that the crate has under the same name.
macro_rules! dual_functions {
    ($($name:ident)*) => {$(
        #[inline]
        fn $name(self) -> Self {
            DualNum::$name(&self)
        }
    )*};
}

macro_rules! real_for_num_dual {
    ($([$($constants:tt)*] $type:ty, $order:literal, $float:ident, [$($part:ident),*];)*) => {$(
        impl<$($constants)*> Real for $type {
            type Mask = bool;
            const LANES: usize = 1;
            const ORDER: usize = $order;

            #[inline]
            fn lit(value: f64) -> Self {
                Self::from(<$float as Real>::lit(value))
            }
            #[inline]
            fn primal(self, _lane: usize) -> f64 {
                f64::from(self.re)
            }
            #[inline]
            fn frozen(self) -> Self {
                Self::from(self.re)
            }
            #[inline]
            fn less_than(self, other: Self) -> bool {
                self.re < other.re
            }
            #[inline]
            fn at_most(self, other: Self) -> bool {
                self.re <= other.re
            }
            #[inline]
            fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
                if mask { if_true } else { if_false }
            }
            #[inline]
            fn is_finite(self) -> bool {
                self.re.is_finite()
            }
            dual_functions!(recip sqrt cbrt exp exp_m1 ln ln_1p tan asin acos atan sinh cosh tanh);
            #[inline]
            fn powi(self, n: i32) -> Self {
                DualNum::powi(&self, n)
            }
            #[inline]
            fn powf(self, exponent: Self) -> Self {
                if $(exponent.$part.vanishes() &&)* true {
                    DualNum::powf(&self, exponent.re)
                } else {
                    DualNum::powd(&self, exponent)
                }
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                DualNum::sin_cos(&self)
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                // The angle from the direction of the value, where the quotient is zero and regular.
                let length = self.re.abs().max(x.re.abs());
                let (c, s) = (x.re / length, self.re / length);
                let mut angle = DualNum::atan(&((self * c - x * s) / (x * c + self * s)));
                angle.re = self.re.atan2(x.re);
                angle
            }
            #[inline]
            fn abs(self) -> Self {
                Signed::abs(&self)
            }
            #[inline]
            fn copysign(self, sign: Self) -> Self {
                if self.re.is_sign_negative() == sign.re.is_sign_negative() { self } else { -self }
            }
        }
    )*};
}

real_for_num_dual! {
    [] Dual<f64>, 1, f64, [eps];
    [] Dual<f32>, 1, f32, [eps];
    [] Dual2<f64>, 2, f64, [v1, v2];
    [] Dual2<f32>, 2, f32, [v1, v2];
    [] Dual3<f64>, 3, f64, [v1, v2, v3];
    [] Dual3<f32>, 3, f32, [v1, v2, v3];
    [] HyperDual<f64>, 2, f64, [eps1, eps2, eps1eps2];
    [] HyperDual<f32>, 2, f32, [eps1, eps2, eps1eps2];
    [] HyperHyperDual<f64>, 3, f64, [eps1, eps2, eps3, eps1eps2, eps1eps3, eps2eps3, eps1eps2eps3];
    [] HyperHyperDual<f32>, 3, f32, [eps1, eps2, eps3, eps1eps2, eps1eps3, eps2eps3, eps1eps2eps3];
    [const N: usize] DualVec<f64, Const<N>>, 1, f64, [eps];
    [const N: usize] DualVec<f32, Const<N>>, 1, f32, [eps];
    [const N: usize] Dual2Vec<f64, Const<N>>, 2, f64, [v1, v2];
    [const N: usize] Dual2Vec<f32, Const<N>>, 2, f32, [v1, v2];
    [const M: usize, const N: usize] HyperDualVec<f64, Const<M>, Const<N>>, 2, f64, [eps1, eps2, eps1eps2];
    [const M: usize, const N: usize] HyperDualVec<f32, Const<M>, Const<N>>, 2, f32, [eps1, eps2, eps1eps2];
}
