//! `Lanes<T, N>`: N independent floats that are computed with at once.
//!
//! Every operation is written over arrays, without intrinsics, so that the compiler turns it into vector
//! instructions of whatever width the caller was compiled for; [`dispatch`](crate::dispatch) chooses that
//! width at run time. All functions are inlined without exception: one that is not would be compiled for
//! the least capable machine.
//!
//! # Which N?
//! One register holds 4 `f64` or 8 `f32` at [`Level::Avx2`](crate::Level::Avx2), and twice that at
//! [`Level::Avx512`](crate::Level::Avx512). More lanes than that help only while all live values stay in
//! registers, so measure; on one Zen 5 core, in cargo's default release profile, nanoseconds a point are
//! (ranges: where the caller's buffers happen to lie)
//!
//! | kernel | scalar loop | `f64` ×4, AVX2 | ×8, AVX2 | ×4, AVX-512 | ×8, AVX-512 |
//! |---|---|---|---|---|---|
//! | products of 3×3 arrays, many live values | 2.2 | **1.5–1.9** | 1.7–2.2 | **0.7–0.9** | 1.3–1.9 |
//! | polynomial of degree 15 | 4.1 | **1.6** | 2.0 | **0.9** | 1.0 |
//! | eˣ | 2.4 | 1.1 | **1.0** | 0.6 | **0.5** |
//! | sin x and cos x | 8.3 | 2.6 | **2.5** | 2.4 | **1.4** |
//! | xʸ | 7.7 | **5.8** | 7.0 | 5.6 | **3.0** |
//!
//! So: 4 for `f64` kernels that mix much state, 8 for loops of elementary functions on AVX-512. For `f32`
//! double these. The alignment is that of the element: a larger one pads short lanes and measured no faster.
//!
//! # Accuracy
//! Largest error in ulp, `f64`, over reference values and 6000 random points for each function, against 160
//! bits. For `f32` all are below 0.51 (0.56 for sin and cos, 1.4 for tan beyond |x| = 2.6·10⁷).
//!
//! | exp | `exp_m1` | ln | `ln_1p` | sin | cos | tan | asin | acos | atan | atan2 | sinh | cosh | tanh | cbrt | `recip_cbrt` | powf | powi |
//! |---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
//! | 0.9 | 1.0 | 0.7 | 0.8 | 0.7 | 0.8 | 1.3 | 0.8 | 0.8 | 0.8 | 1.2 | 1.5 | 0.7 | 1.3 | 0.7 | 1.1 | 1.5 | 1.7 |
//!
//! `ln_1p_given` is `ln_1p` near zero and ln elsewhere, digit for digit.

mod records;

use core::ops::{Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign};

use num_traits::{One, Zero};

use crate::elementary::{double, power, single, trigonometric};
use crate::lanewise::Lanewise;
use crate::{Mask, Real};

/// N independent values of type `T` (`f32` or `f64`).
///
/// Elementary functions are accurate to 2 ulp over their whole domain, with the conventions of `f64` at
/// and beyond its edges, and bit-identical for every N, every [`Level`](crate::Level) and every machine;
/// only sin, cos and tan of |x| > 2.6·10⁷ are the standard library's. NaNs are equal in kind, not in
/// pattern. `==` holds when all lanes are equal.
///
/// # Example
/// ```
/// use piola_numerics::{Lanes, Mask, Real};
/// let x = Lanes([1.0, 4.0, 9.0, 16.0]);
/// assert_eq!(x.sqrt() + Lanes::splat(1.0), Lanes([2.0, 3.0, 4.0, 5.0]));
/// assert!(x.less_than(Lanes::splat(2.0)).any());
/// ```
#[doc(alias = "SIMD")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes<T, const N: usize>(
    /// The values.
    pub [T; N],
);

/// The result of comparing [`Lanes`]: each lane's truth value as all bits one or all bits zero.
///
/// # Example
/// ```
/// use piola_numerics::{Lanes, Mask, Real};
/// let mask = Lanes([1.0, 2.0]).less_than(Lanes([2.0, 1.0]));
/// assert!(mask.lane(0) && !mask.lane(1));
/// assert_eq!(Lanes::select(mask, Lanes([5.0, 5.0]), Lanes([7.0, 7.0])), Lanes([5.0, 7.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub struct LaneMask<B, const N: usize>([B; N]);

mod sealed {
    /// Whole numbers as wide as a lane.
    pub trait Bits:
        Copy
        + Eq
        + core::fmt::Debug
        + Send
        + Sync
        + core::ops::BitAnd<Output = Self>
        + core::ops::BitOr<Output = Self>
        + core::ops::Not<Output = Self>
    {
        fn splat(value: bool) -> Self;
    }

    /// The elementary functions of one lane.
    pub trait Functions: Copy {
        type Bits: Bits;
        fn narrow(value: f64) -> Self;
        fn widen(self) -> f64;
        fn is_less(self, other: Self) -> bool;
        fn is_at_most(self, other: Self) -> bool;
        fn is_number(self) -> bool;
        fn choose(mask: Self::Bits, if_true: Self, if_false: Self) -> Self;
        fn lane_sqrt(self) -> Self;
        fn lane_abs(self) -> Self;
        fn lane_copysign(self, sign: Self) -> Self;
        fn lanes_powi<const N: usize>(lanes: [Self; N], n: i32) -> [Self; N];
        // In doubles, as accurately as a lane can show.
        fn exp(x: f64) -> f64;
        fn exp_m1(x: f64) -> f64;
        fn ln(x: f64) -> f64;
        fn ln_1p(x: f64) -> f64;
        fn tan(x: f64) -> f64;
        fn asin(x: f64) -> f64;
        fn acos(x: f64) -> f64;
        fn atan(x: f64) -> f64;
        fn sinh(x: f64) -> f64;
        fn cosh(x: f64) -> f64;
        fn tanh(x: f64) -> f64;
        fn cbrt(x: f64) -> f64;
        fn recip_cbrt(x: f64) -> f64;
        fn sin_cos(x: f64) -> (f64, f64);
        fn atan2(y: f64, x: f64) -> f64;
        fn ln_1p_given(x: f64, sum: f64) -> f64;
        fn powf(x: f64, y: f64) -> f64;
        fn far_sin_cos(self) -> (Self, Self);
        fn far_tan(self) -> Self;
        /// Numbers of lanes whose gathering is done in registers.
        const IN_REGISTERS: [usize; 2];
        fn gather<const N: usize, const K: usize, const ROWS: usize>(
            records: [&[Self; K]; N],
            components: &mut [super::Lanes<Self, N>; K],
        );
        fn scatter<const N: usize, const K: usize, const ROWS: usize>(
            components: &[super::Lanes<Self, N>; K],
            records: [&mut [Self; K]; N],
        );
    }
}
use sealed::{Bits, Functions};

/// What a lane may hold: `f32` or `f64`.
pub trait Element:
    Functions
    + nalgebra::Scalar
    + Copy
    + Send
    + Sync
    + Zero
    + One
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
}

/// Applies an expression to every lane. A macro and not a closure: closures cannot be forced inline.
///
/// A loop, which the compiler turns into vectors as a whole: for functions of many operations.
macro_rules! each_lane {
    ($i:ident in $start:expr => $value:expr) => {{
        let mut result = $start;
        let mut $i = 0;
        while $i < N {
            result[$i] = $value;
            $i += 1;
        }
        result
    }};
}

/// As [`each_lane`], the first sixteen lanes written out: for single operations. A kernel is thousands of them, and as
/// loops within a loop over points they would cost the compiler minutes. A condition that is an inline constant is decided before machine
/// code is made: statements of lanes that are not there cost nothing.
macro_rules! every_lane {
    ($i:ident in $start:expr => $value:expr) => {{
        let mut result = $start;
        every_lane!($i: result[$i] = $value);
        result
    }};
    ($i:ident: $statement:expr) => {{
        every_lane!(@written $i, $statement, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
        let mut $i = 16;
        while $i < N {
            $statement;
            $i += 1;
        }
    }};
    (@written $i:ident, $statement:expr, $($lane:literal)*) => {
        $(if const { $lane < N } {
            let $i = $lane;
            $statement;
        })*
    };
}

macro_rules! element {
    (@unary $functions:ident: $($name:ident)*) => {
        $(
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $name(x: f64) -> f64 {
                $functions::$name(x)
            }
        )*
    };
    ($float:ident, $bits:ident, $functions:ident, $powi:expr, $in_registers:expr, $gather:ident, $scatter:ident) => {
        impl Bits for $bits {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn splat(value: bool) -> Self {
                if value { $bits::MAX } else { 0 }
            }
        }
        impl Functions for $float {
            type Bits = $bits;
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[expect(
                clippy::allow_attributes,
                reason = "one macro serves f32, where the cast rounds, and f64, where it is the identity"
            )]
            #[allow(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]
            fn narrow(value: f64) -> Self {
                value as $float
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn widen(self) -> f64 {
                f64::from(self)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn is_less(self, other: Self) -> bool {
                self < other
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn is_at_most(self, other: Self) -> bool {
                self <= other
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn is_number(self) -> bool {
                // Beside 0 < x the compiler would make one test of the bits of each lane of a comparison with infinity.
                self.abs() <= $float::MAX
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn choose(mask: $bits, if_true: Self, if_false: Self) -> Self {
                $float::from_bits((mask & if_true.to_bits()) | (!mask & if_false.to_bits()))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn lane_sqrt(self) -> Self {
                $float::sqrt(self)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn lane_abs(self) -> Self {
                $float::abs(self)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn lane_copysign(self, sign: Self) -> Self {
                $float::copysign(self, sign)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn lanes_powi<const N: usize>(lanes: [Self; N], n: i32) -> [Self; N] {
                $powi(lanes, n)
            }
            element!(@unary $functions: exp exp_m1 ln ln_1p tan asin acos atan sinh cosh tanh cbrt recip_cbrt);
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sin_cos(x: f64) -> (f64, f64) {
                $functions::sin_cos(x)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn atan2(y: f64, x: f64) -> f64 {
                $functions::atan2(y, x)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn ln_1p_given(x: f64, sum: f64) -> f64 {
                $functions::ln_1p_given(x, sum)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn powf(x: f64, y: f64) -> f64 {
                $functions::powf(x, y)
            }
            fn far_sin_cos(self) -> (Self, Self) {
                $float::sin_cos(self)
            }
            fn far_tan(self) -> Self {
                $float::tan(self)
            }
            const IN_REGISTERS: [usize; 2] = $in_registers;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn gather<const N: usize, const K: usize, const ROWS: usize>(
                records: [&[Self; K]; N],
                components: &mut [Lanes<Self, N>; K],
            ) {
                records::$gather::<N, K, ROWS>(records, components);
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn scatter<const N: usize, const K: usize, const ROWS: usize>(
                components: &[Lanes<Self, N>; K],
                records: [&mut [Self; K]; N],
            ) {
                records::$scatter::<N, K, ROWS>(components, records);
            }
        }
        impl Element for $float {}
    };
}
element!(f64, u64, double, powi, records::DOUBLES_IN_REGISTERS, gather_doubles, scatter_doubles);
element!(f32, u32, single, powi_of_single, [0, 0], gather_singles, scatter_singles);

/// xⁿ of doubles. Up to the fourth power plain products are within 2 ulp: x² is within ½, and squaring it
/// at most √2 of the rest. Higher ones are products of sums of two doubles.
#[cfg_attr(not(debug_assertions), inline(always))]
fn powi<const N: usize>(x: [f64; N], n: i32) -> [f64; N] {
    let magnitude = n.unsigned_abs();
    match n {
        0 => return [1.0; N],
        1 => return x,
        2 => return each_lane!(i in x => x[i] * x[i]),
        3 => return each_lane!(i in x => x[i] * x[i] * x[i]),
        4 => return each_lane!(i in x => (x[i] * x[i]) * (x[i] * x[i])),
        -1 => return each_lane!(i in x => 1.0 / x[i]),
        _ if power::LARGEST_PRODUCT < magnitude => return each_lane!(i in x => power::powf(x[i], f64::from(n))),
        _ => {}
    }
    let mut base = each_lane!(i in [(0.0, 0.0); N] => (x[i], 0.0));
    if n < 0 {
        base = each_lane!(i in base => power::reciprocal(x[i]));
    }
    let mut result = base;
    let mut bit = magnitude.ilog2();
    while 0 < bit {
        bit -= 1;
        result = each_lane!(i in result => power::product(result[i], result[i]));
        if (magnitude >> bit) & 1 == 1 {
            result = each_lane!(i in result => power::product(result[i], base[i]));
        }
    }
    each_lane!(i in x => power::sum(result[i]))
}

/// xⁿ of singles, by products of doubles.
#[cfg_attr(not(debug_assertions), inline(always))]
fn powi_of_single<const N: usize>(x: [f32; N], n: i32) -> [f32; N] {
    each_lane!(i in x => power::powi_of_single(x[i], n))
}

impl<T: Element, const N: usize> Lanes<T, N> {
    /// The same value in every lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn splat(value: T) -> Self {
        Self([value; N])
    }

    /// The first N numbers of `values`; lanes beyond its end get `fill`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn load(values: &[T], fill: T) -> Self {
        if let Some(all) = values.first_chunk::<N>() {
            return Self(*all);
        }
        let mut lanes = [fill; N];
        for (lane, value) in lanes.iter_mut().zip(values) {
            *lane = *value;
        }
        Self(lanes)
    }

    /// Writes the lanes to the start of `values`, as many as it has room for.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn store(self, values: &mut [T]) {
        if let Some(all) = values.first_chunk_mut::<N>() {
            *all = self.0;
            return;
        }
        for (value, lane) in values.iter_mut().zip(self.0) {
            *value = lane;
        }
    }
}

impl<B: Bits, const N: usize> LaneMask<B, N> {
    /// The truth value of one lane; false beyond the last.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn lane(self, lane: usize) -> bool {
        lane < N && self.0[lane] != B::splat(false)
    }
}

impl<T, const N: usize> From<[T; N]> for Lanes<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from(values: [T; N]) -> Self {
        Self(values)
    }
}

macro_rules! lane_operator {
    ($trait:ident, $function:ident, $assign_trait:ident, $assign:ident, $operator:tt) => {
        impl<T: Element, const N: usize> $trait for Lanes<T, N> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $function(self, other: Self) -> Self {
                Self(every_lane!(i in self.0 => self.0[i] $operator other.0[i]))
            }
        }
        impl<T: Element, const N: usize> $assign_trait for Lanes<T, N> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $assign(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    };
}
lane_operator!(Add, add, AddAssign, add_assign, +);
lane_operator!(Sub, sub, SubAssign, sub_assign, -);
lane_operator!(Mul, mul, MulAssign, mul_assign, *);
lane_operator!(Div, div, DivAssign, div_assign, /);

impl<T: Element, const N: usize> Neg for Lanes<T, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self(every_lane!(i in self.0 => -self.0[i]))
    }
}
impl<T: Element, const N: usize> Zero for Lanes<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        Self([T::zero(); N])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}
impl<T: Element, const N: usize> One for Lanes<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn one() -> Self {
        Self([T::one(); N])
    }
}

impl<B: Bits, const N: usize> BitAnd for LaneMask<B, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn bitand(self, other: Self) -> Self {
        Self(every_lane!(i in self.0 => self.0[i] & other.0[i]))
    }
}
impl<B: Bits, const N: usize> BitOr for LaneMask<B, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn bitor(self, other: Self) -> Self {
        Self(every_lane!(i in self.0 => self.0[i] | other.0[i]))
    }
}
impl<B: Bits, const N: usize> Not for LaneMask<B, N> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn not(self) -> Self {
        Self(every_lane!(i in self.0 => !self.0[i]))
    }
}
impl<B: Bits, const N: usize> Mask for LaneMask<B, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn splat(value: bool) -> Self {
        Self([B::splat(value); N])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn any(self) -> bool {
        let mut union = B::splat(false);
        every_lane!(i: union = union | self.0[i]);
        union != B::splat(false)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn all(self) -> bool {
        !(!self).any()
    }
}

/// A function of one lane, computed in doubles.
macro_rules! lane_function {
    ($name:ident) => {
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn $name(self) -> Self {
            Self(each_lane!(i in self.0 => T::narrow(<T as Functions>::$name(self.0[i].widen()))))
        }
    };
}

impl<T: Element, const N: usize> Real for Lanes<T, N> {
    type Mask = LaneMask<T::Bits, N>;
    const LANES: usize = N;
    const ORDER: usize = 0;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lit(value: f64) -> Self {
        Self([T::narrow(value); N])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn primal(self, lane: usize) -> f64 {
        self.0[lane].widen()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn frozen(self) -> Self {
        self
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn less_than(self, other: Self) -> Self::Mask {
        LaneMask(every_lane!(i in [T::Bits::splat(false); N] => T::Bits::splat(self.0[i].is_less(other.0[i]))))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_most(self, other: Self) -> Self::Mask {
        LaneMask(every_lane!(i in [T::Bits::splat(false); N] => T::Bits::splat(self.0[i].is_at_most(other.0[i]))))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self {
        Self(every_lane!(i in if_false.0 => T::choose(mask.0[i], if_true.0[i], if_false.0[i])))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_finite(self) -> Self::Mask {
        LaneMask(every_lane!(i in [T::Bits::splat(false); N] => T::Bits::splat(self.0[i].is_number())))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sqrt(self) -> Self {
        Self(every_lane!(i in self.0 => self.0[i].lane_sqrt()))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn abs(self) -> Self {
        Self(every_lane!(i in self.0 => self.0[i].lane_abs()))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn copysign(self, sign: Self) -> Self {
        Self(every_lane!(i in self.0 => self.0[i].lane_copysign(sign.0[i])))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn powi(self, n: i32) -> Self {
        Self(T::lanes_powi(self.0, n))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn powf(self, exponent: Self) -> Self {
        Self(each_lane!(i in self.0 => T::narrow(<T as Functions>::powf(self.0[i].widen(), exponent.0[i].widen()))))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        Self(each_lane!(i in self.0 => T::narrow(<T as Functions>::atan2(self.0[i].widen(), x.0[i].widen()))))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ln_1p_given(self, sum: Self) -> Self {
        Self(each_lane!(i in self.0 => T::narrow(<T as Functions>::ln_1p_given(self.0[i].widen(), sum.0[i].widen()))))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lanewise<const I: usize, const O: usize>(computation: &impl Lanewise<I, O>, inputs: [Self; I]) -> [Self; O] {
        let mut from = [Apart::<T, N>::new(); I];
        let mut outputs = [Self([T::zero(); N]); O];
        let mut k = 0;
        while k < I {
            from[k].lanes = inputs[k].0;
            k += 1;
        }
        let mut lane = 0;
        while lane < N {
            let mut input = [Lanes([T::zero()]); I];
            k = 0;
            while k < I {
                input[k] = Lanes([from[k].lanes[lane]]);
                k += 1;
            }
            let output: [Lanes<T, 1>; O] = computation.run(input);
            k = 0;
            while k < O {
                outputs[k].0[lane] = output[k].0[0];
                k += 1;
            }
            lane += 1;
        }
        outputs
    }
    lane_function!(cbrt);
    lane_function!(recip_cbrt);
    lane_function!(exp);
    lane_function!(exp_m1);
    lane_function!(ln);
    lane_function!(ln_1p);
    lane_function!(asin);
    lane_function!(acos);
    lane_function!(atan);
    lane_function!(sinh);
    lane_function!(cosh);
    lane_function!(tanh);

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        if beyond_reduction(self) {
            return far_sin_cos(self);
        }
        let mut sine = self.0;
        let mut cosine = self.0;
        let mut i = 0;
        while i < N {
            let (s, c) = <T as Functions>::sin_cos(self.0[i].widen());
            sine[i] = T::narrow(s);
            cosine[i] = T::narrow(c);
            i += 1;
        }
        (Self(sine), Self(cosine))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tan(self) -> Self {
        if beyond_reduction(self) {
            return far_tan(self);
        }
        Self(each_lane!(i in self.0 => T::narrow(<T as Functions>::tan(self.0[i].widen()))))
    }
}

/// Lanes with a gap behind them: of numbers one after the other the compiler would make vectors that begin anywhere.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Apart<T, const N: usize> {
    lanes: [T; N],
    gap: core::mem::MaybeUninit<u8>,
}

impl<T: Element, const N: usize> Apart<T, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn new() -> Self {
        Self { lanes: [T::zero(); N], gap: core::mem::MaybeUninit::uninit() }
    }
}

/// True when a lane's angle is too large for the reduction in lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn beyond_reduction<T: Element, const N: usize>(x: Lanes<T, N>) -> bool {
    Lanes::lit(trigonometric::LIMIT).less_than(x.abs()).any()
}

/// Lane by lane: the same results as in lanes where that reduction holds, the standard library's elsewhere.
#[cold]
#[inline(never)]
fn far_sin_cos<T: Element, const N: usize>(x: Lanes<T, N>) -> (Lanes<T, N>, Lanes<T, N>) {
    let (mut sine, mut cosine) = (x, x);
    for i in 0..N {
        let lane = x.0[i].widen();
        (sine.0[i], cosine.0[i]) = if trigonometric::LIMIT < lane.abs() {
            x.0[i].far_sin_cos()
        } else {
            let (s, c) = <T as Functions>::sin_cos(lane);
            (T::narrow(s), T::narrow(c))
        };
    }
    (sine, cosine)
}

#[cold]
#[inline(never)]
fn far_tan<T: Element, const N: usize>(x: Lanes<T, N>) -> Lanes<T, N> {
    let mut tangent = x;
    for i in 0..N {
        let lane = x.0[i].widen();
        tangent.0[i] =
            if trigonometric::LIMIT < lane.abs() { x.0[i].far_tan() } else { T::narrow(<T as Functions>::tan(lane)) };
    }
    tangent
}
