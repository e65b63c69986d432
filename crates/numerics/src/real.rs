//! The scalar trait that every formula of Piola is written over.
//!
//! A formula written once over [`Real`] runs unchanged in `f64` and `f32`, in exact derivatives
//! ([`Dual`](crate::Dual), [`Gradient`](crate::Gradient), [`Jet`](crate::Jet), nested at will) and in
//! SIMD lanes ([`Lanes`](crate::Lanes)). Decisions are made with masks, never with `if`, so that lanes
//! can take both sides:
//!
//! ```
//! use piola_numerics::Real;
//! /// |x| written with a mask: works in lanes and has the right derivative on either side of zero.
//! fn modulus<T: Real>(x: T) -> T {
//!     T::select(x.less_than(T::lit(0.0)), -x, x)
//! }
//! assert_eq!(modulus(-2.5_f64), 2.5);
//! ```
//!
//! Why a trait of our own: nalgebra's `RealField` excludes lanes, its `SimdRealField` has no eight-lane
//! `f64` and chooses the instruction set at compile time.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign};

use num_traits::{One, Zero};

use crate::elementary::trigonometric::{LIMIT, sin_cos};
use crate::lanewise::Lanewise;

/// The result of a comparison: one truth value for each lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// The same truth value in every lane.
    #[must_use]
    fn splat(value: bool) -> Self;
    /// True when at least one lane is.
    #[must_use]
    fn any(self) -> bool;
    /// True when every lane is.
    #[must_use]
    fn all(self) -> bool;
}

impl Mask for bool {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn splat(value: bool) -> Self {
        value
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn any(self) -> bool {
        self
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn all(self) -> bool {
        self
    }
}

/// A real scalar: a float, a lane of floats, or either with exact derivatives.
///
/// Angles are in radians. Functions follow the conventions of `f64` outside their domain (NaN) and at
/// their poles (±∞). Comparisons look at the value only: derivatives follow the chosen branch.
///
/// # Example
/// ```
/// use piola_numerics::{Dual, Real};
/// fn kinetic_energy<T: Real>(mass: T, speed: T) -> T {
///     T::lit(0.5) * mass * speed * speed
/// }
/// assert_eq!(kinetic_energy(2.0, 3.0), 9.0);
/// // The momentum is its derivative with respect to the speed.
/// assert_eq!(kinetic_energy(Dual::lit(2.0), Dual::variable(3.0)).tangent, 6.0);
/// ```
pub trait Real:
    nalgebra::Scalar
    + Copy
    + Debug
    + Send
    + Sync
    + Zero
    + One
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// What comparisons return.
    type Mask: Mask;

    /// How many independent values one scalar holds.
    const LANES: usize;
    /// The highest order of the derivatives that the scalar carries: 0 for floats and lanes, 2 for a dual of a dual.
    ///
    /// For algorithms that compute with values first, on [`frozen`](Self::frozen) scalars, and then need to
    /// know how many terms or steps bring in all derivatives.
    const ORDER: usize;

    /// The constant `value`, rounded to this scalar, with zero derivatives, in every lane.
    #[must_use]
    fn lit(value: f64) -> Self;
    /// The value, without derivatives, of one lane: for error messages, tests and step control.
    ///
    /// `lane` is below [`LANES`](Self::LANES).
    #[must_use]
    fn primal(self, lane: usize) -> f64;
    /// The same value in every lane, with zero derivatives.
    ///
    /// ```
    /// use piola_numerics::{Dual, Real};
    /// assert_eq!(Dual::variable(3.0).frozen(), Dual::lit(3.0));
    /// ```
    #[must_use]
    fn frozen(self) -> Self;

    /// `self < other`.
    #[must_use]
    fn less_than(self, other: Self) -> Self::Mask;
    /// `self <= other`.
    #[must_use]
    fn at_most(self, other: Self) -> Self::Mask;
    /// Lane by lane, `if_true` where the mask holds and `if_false` elsewhere. Both are evaluated.
    #[must_use]
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self;
    /// Where the value is neither infinite nor NaN.
    #[must_use]
    fn is_finite(self) -> Self::Mask;

    /// √x.
    #[must_use]
    fn sqrt(self) -> Self;
    /// ∛x, for negative `x` too.
    #[must_use]
    fn cbrt(self) -> Self;
    /// xⁿ for a whole number n.
    #[must_use]
    fn powi(self, n: i32) -> Self;
    /// xʸ for 0 ≤ x.
    #[must_use]
    fn powf(self, exponent: Self) -> Self;
    /// eˣ.
    #[must_use]
    fn exp(self) -> Self;
    /// eˣ − 1 without cancellation.
    #[must_use]
    fn exp_m1(self) -> Self;
    /// ln x.
    #[must_use]
    fn ln(self) -> Self;
    /// ln(1 + x) without cancellation.
    #[must_use]
    fn ln_1p(self) -> Self;
    /// (sin x, cos x).
    #[must_use]
    fn sin_cos(self) -> (Self, Self);
    /// Sines and cosines of eight angles, to 2 ulp. Those of `f64` and `f32` are computed side by side, in less time than one after the other
    /// unless some |angle| exceeds 2.6e7. Their last bits may differ from those of [`sin_cos`](Self::sin_cos).
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos_of_eight(angles: [Self; 8]) -> ([Self; 8], [Self; 8]) {
        let (mut sines, mut cosines) = (angles, angles);
        for k in 0..8 {
            (sines[k], cosines[k]) = angles[k].sin_cos();
        }
        (sines, cosines)
    }
    /// arcsin x ∈ [−π/2, π/2].
    #[must_use]
    fn asin(self) -> Self;
    /// arccos x ∈ [0, π].
    #[must_use]
    fn acos(self) -> Self;
    /// arctan x ∈ (−π/2, π/2).
    #[must_use]
    fn atan(self) -> Self;
    /// The angle of the point (x, y) = (`x`, `self`), in (−π, π].
    #[must_use]
    fn atan2(self, x: Self) -> Self;
    /// sinh x.
    #[must_use]
    fn sinh(self) -> Self;
    /// cosh x.
    #[must_use]
    fn cosh(self) -> Self;
    /// tanh x.
    #[must_use]
    fn tanh(self) -> Self;
    /// |x|.
    #[must_use]
    fn abs(self) -> Self;
    /// |self| with the sign of `sign`.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;

    /// 1/x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn recip(self) -> Self {
        Self::one() / self
    }
    /// 1/∛x, for negative `x` too: in lanes without a division.
    ///
    /// ```
    /// use piola_numerics::{Lanes, Real};
    /// assert_eq!(Lanes([8.0, -0.125, 0.0, f64::INFINITY]).recip_cbrt(), Lanes([0.5, -2.0, f64::INFINITY, 0.0]));
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn recip_cbrt(self) -> Self {
        self.cbrt().recip()
    }
    /// ln(1 + x) of which `sum`, 1 + x rounded, is given too: as [`ln_1p`](Self::ln_1p) where |x| ≤ ½, as the
    /// [`ln`](Self::ln) of the sum elsewhere, where a sum near zero has digits that x has lost. In lanes without a branch.
    ///
    /// ```
    /// use piola_numerics::Real;
    /// assert_eq!(1e-20_f64.ln_1p_given(1.0), 1e-20);
    /// assert_eq!((-1.0_f64).ln_1p_given(1e-20), 1e-20_f64.ln());
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn ln_1p_given(self, sum: Self) -> Self {
        let near = self.abs().at_most(Self::lit(0.5));
        if near.all() {
            return self.ln_1p();
        }
        let plain = sum.ln();
        if near.any() { Self::select(near, self.ln_1p(), plain) } else { plain }
    }
    /// sin x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// cos x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// tan x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn tan(self) -> Self {
        let (s, c) = self.sin_cos();
        s / c
    }
    /// The smaller of two values; NaN when either is.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn min(self, other: Self) -> Self {
        Self::select(self.at_most(other) | self.is_nan(), self, other)
    }
    /// The larger of two values; NaN when either is.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn max(self, other: Self) -> Self {
        Self::select(other.at_most(self) | self.is_nan(), self, other)
    }
    /// The computation at these numbers, in lanes one lane after the other in a loop: see [`Lanewise`].
    ///
    /// ```
    /// use piola_numerics::internal::Lanewise;
    /// use piola_numerics::{Lanes, Real};
    /// struct Hypotenuse;
    /// impl Lanewise<2, 1> for Hypotenuse {
    ///     #[cfg_attr(not(debug_assertions), inline(always))]
    ///     fn run<T: Real>(&self, [x, y]: [T; 2]) -> [T; 1] {
    ///         [(x * x + y * y).sqrt()]
    ///     }
    /// }
    /// assert_eq!(f64::lanewise(&Hypotenuse, [3.0, 4.0]), [5.0]);
    /// assert_eq!(Lanes::lanewise(&Hypotenuse, [Lanes([3.0, 5.0]), Lanes([4.0, 12.0])]), [Lanes([5.0, 13.0])]);
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn lanewise<const I: usize, const O: usize>(computation: &impl Lanewise<I, O>, inputs: [Self; I]) -> [Self; O] {
        computation.run(inputs)
    }
    /// Where the value is not a number.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn is_nan(self) -> Self::Mask {
        // Every number is at most itself.
        !self.at_most(self)
    }
}

/// Functions of one number that the standard library has under the same name.
macro_rules! float_functions {
    ($float:ident: $($name:ident)*) => {$(
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn $name(self) -> Self {
            $float::$name(self)
        }
    )*};
}

macro_rules! real_for_float {
    ($float:ident) => {
        impl Real for $float {
            type Mask = bool;
            const LANES: usize = 1;
            const ORDER: usize = 0;

            #[cfg_attr(not(debug_assertions), inline(always))]
            #[expect(
                clippy::allow_attributes,
                reason = "one macro serves f32, where the cast rounds, and f64, where it is the identity"
            )]
            #[allow(clippy::cast_possible_truncation, reason = "rounding a constant to f32 is the meaning of `lit`")]
            fn lit(value: f64) -> Self {
                value as $float
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn primal(self, _lane: usize) -> f64 {
                f64::from(self)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn frozen(self) -> Self {
                self
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn less_than(self, other: Self) -> bool {
                self < other
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn at_most(self, other: Self) -> bool {
                self <= other
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
                if mask { if_true } else { if_false }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
            float_functions!($float: sqrt cbrt exp exp_m1 ln ln_1p sin cos tan asin acos atan sinh cosh tanh abs);
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn powi(self, n: i32) -> Self {
                $float::powi(self, n)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn powf(self, exponent: Self) -> Self {
                $float::powf(self, exponent)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sin_cos(self) -> (Self, Self) {
                $float::sin_cos(self)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sin_cos_of_eight(angles: [Self; 8]) -> ([Self; 8], [Self; 8]) {
                let (mut sines, mut cosines, mut is_near) = (angles, angles, true);
                for angle in angles {
                    is_near &= f64::from(angle).abs() <= LIMIT;
                }
                if !is_near {
                    for k in 0..8 {
                        (sines[k], cosines[k]) = $float::sin_cos(angles[k]);
                    }
                    return (sines, cosines);
                }
                for k in 0..8 {
                    let (sine, cosine) = sin_cos(f64::from(angles[k]));
                    sines[k] = Self::lit(sine);
                    cosines[k] = Self::lit(cosine);
                }
                (sines, cosines)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn atan2(self, x: Self) -> Self {
                $float::atan2(self, x)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn copysign(self, sign: Self) -> Self {
                $float::copysign(self, sign)
            }
        }
    };
}

real_for_float!(f32);
real_for_float!(f64);
