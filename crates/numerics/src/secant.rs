//! `Secant<T>`: a value at two points and its change between them, without cancellation.
//!
//! ```text
//! δ(ab) = ā δb + b̄ δa        δ sin a = 2 cos ā sin(δa/2)        ā = (a₀ + a₁)/2,   δa = a₁ − a₀
//! ```
//!
//! A formula over secants gives f(x₁) − f(x₀) with an error relative to the changes of its terms. The difference of
//! two computed values has an error relative to the values, which is far larger where the points are close.

use core::ops::{Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign};

use num_traits::{One, Zero};

use crate::{Mask, Real};

/// A number at a start and at an end, and its change from one to the other, computed without the difference of the two.
///
/// # Accuracy
/// A sum, product or elementary function adds a few ulp of the changes that enter it. The change is the difference of the two
/// values where the ends take different branches of a [`select`](Real::select), and for `atan2` where one end is the origin.
///
/// # Example
/// ```
/// use piola_numerics::{Secant, Real};
/// // 1 − cos x from 0 to 1e-9 grows by 5e-19; the difference of the two values is 0.
/// let height = |x: Secant<f64>| Secant::lit(1.0) - x.cos();
/// assert_eq!(height(Secant::new(0.0, 1e-9)).change, 0.5e-18);
/// assert_eq!((1.0 - 1e-9_f64.cos()) - (1.0 - 0.0_f64.cos()), 0.0);
/// ```
#[doc(alias("divided difference", "discrete derivative", "cancellation"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Secant<T> {
    /// The value a₀ at the start.
    pub start: T,
    /// The value a₁ at the end.
    pub end: T,
    /// The change a₁ − a₀.
    pub change: T,
}

impl<T: Real> Secant<T> {
    /// The variable itself, from `start` to `start + change`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn new(start: T, change: T) -> Self {
        Self { start, end: start + change, change }
    }
    /// A constant: no change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn constant(value: T) -> Self {
        Self { start: value, end: value, change: T::zero() }
    }
    /// ā.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mean(self) -> T {
        T::lit(0.5) * (self.start + self.end)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn half_change(self) -> T {
        T::lit(0.5) * self.change
    }
    /// The given change where `known` holds, elsewhere the difference of the values.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with_change_where(known: T::Mask, start: T, end: T, change: T) -> Self {
        Self { start, end, change: T::select(known, change, end - start) }
    }
}

/// The result of a comparison of secants: one for the start and one for the end.
#[derive(Clone, Copy, Debug)]
pub struct SecantMask<M> {
    start: M,
    end: M,
}

impl<M: Mask> SecantMask<M> {
    /// Where start and end agree.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn agrees(self) -> M {
        (self.start & self.end) | (!self.start & !self.end)
    }
}

impl<M: Mask> BitAnd for SecantMask<M> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn bitand(self, other: Self) -> Self {
        Self { start: self.start & other.start, end: self.end & other.end }
    }
}
impl<M: Mask> BitOr for SecantMask<M> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn bitor(self, other: Self) -> Self {
        Self { start: self.start | other.start, end: self.end | other.end }
    }
}
impl<M: Mask> Not for SecantMask<M> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn not(self) -> Self {
        Self { start: !self.start, end: !self.end }
    }
}
impl<M: Mask> Mask for SecantMask<M> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn splat(value: bool) -> Self {
        Self { start: M::splat(value), end: M::splat(value) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn any(self) -> bool {
        self.start.any() || self.end.any()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn all(self) -> bool {
        self.start.all() && self.end.all()
    }
}

impl<T: Real> Add for Secant<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(self, other: Self) -> Self {
        Self { start: self.start + other.start, end: self.end + other.end, change: self.change + other.change }
    }
}
impl<T: Real> Sub for Secant<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub(self, other: Self) -> Self {
        Self { start: self.start - other.start, end: self.end - other.end, change: self.change - other.change }
    }
}
impl<T: Real> Mul for Secant<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Self {
        let change = self.mean() * other.change + self.change * other.mean();
        Self { start: self.start * other.start, end: self.end * other.end, change }
    }
}
impl<T: Real> Div for Secant<T> {
    type Output = Self;
    /// a₁/b₁ − a₀/b₀ = (b̄ δa − ā δb)/(b₀ b₁).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn div(self, other: Self) -> Self {
        let change = (self.change * other.mean() - self.mean() * other.change) / other.start / other.end;
        Self { start: self.start / other.start, end: self.end / other.end, change }
    }
}
impl<T: Real> Neg for Secant<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg(self) -> Self {
        Self { start: -self.start, end: -self.end, change: -self.change }
    }
}

/// a ∘= b as a = a ∘ b.
macro_rules! assignments {
    ($($Assign:ident $assign:ident $operator:tt),*) => {$(
        impl<T: Real> $Assign for Secant<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $assign(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}
assignments!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

impl<T: Real> Zero for Secant<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        Self::constant(T::zero())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}
impl<T: Real> One for Secant<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn one() -> Self {
        Self::constant(T::one())
    }
}

/// Where two numbers are equal.
#[cfg_attr(not(debug_assertions), inline(always))]
fn equal<T: Real>(a: T, b: T) -> T::Mask {
    a.at_most(b) & b.at_most(a)
}

/// δ ln a of a₀ → a₁: by the logarithm of one plus the relative change where that is small.
#[cfg_attr(not(debug_assertions), inline(always))]
fn change_of_logarithm<T: Real>(start: T, end: T, change: T) -> T {
    (change / start).ln_1p_given(end / start)
}

impl<T: Real> Real for Secant<T> {
    type Mask = SecantMask<T::Mask>;
    const LANES: usize = T::LANES;
    const ORDER: usize = T::ORDER;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lit(value: f64) -> Self {
        Self::constant(T::lit(value))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn primal(self, lane: usize) -> f64 {
        self.end.primal(lane)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn frozen(self) -> Self {
        Self { start: self.start.frozen(), end: self.end.frozen(), change: self.change.frozen() }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn less_than(self, other: Self) -> Self::Mask {
        SecantMask { start: self.start.less_than(other.start), end: self.end.less_than(other.end) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at_most(self, other: Self) -> Self::Mask {
        SecantMask { start: self.start.at_most(other.start), end: self.end.at_most(other.end) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self {
        let start = T::select(mask.start, if_true.start, if_false.start);
        let end = T::select(mask.end, if_true.end, if_false.end);
        let change = T::select(mask.start, if_true.change, if_false.change);
        Self::with_change_where(mask.agrees(), start, end, change)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_finite(self) -> Self::Mask {
        SecantMask { start: self.start.is_finite(), end: self.end.is_finite() }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sqrt(self) -> Self {
        let (start, end) = (self.start.sqrt(), self.end.sqrt());
        let sum = start + end;
        Self::with_change_where(T::zero().less_than(sum), start, end, self.change / sum)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cbrt(self) -> Self {
        let (start, end) = (self.start.cbrt(), self.end.cbrt());
        let squares = start * start + start * end + end * end;
        Self::with_change_where(T::zero().less_than(squares), start, end, self.change / squares)
    }
    fn powi(self, n: i32) -> Self {
        let (mut power, mut square, mut left) = (Self::one(), self, n.unsigned_abs());
        while left != 0 {
            if left & 1 == 1 {
                power *= square;
            }
            left >>= 1;
            if left != 0 {
                square = square * square;
            }
        }
        let change = if n < 0 { power.recip().change } else { power.change };
        Self { start: self.start.powi(n), end: self.end.powi(n), change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn powf(self, exponent: Self) -> Self {
        let (start, end) = (self.start.powf(exponent.start), self.end.powf(exponent.end));
        let logarithm = exponent * self.ln();
        // A base of zero has no logarithm, and its power, zero, makes the difference exact.
        let change = (start + end) * logarithm.half_change().tanh();
        Self::with_change_where(logarithm.change.is_finite(), start, end, change)
    }
    /// e^a₁ − e^a₀ = (e^a₁ + e^a₀) tanh(δa/2).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exp(self) -> Self {
        let (start, end) = (self.start.exp(), self.end.exp());
        Self { start, end, change: (start + end) * self.half_change().tanh() }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exp_m1(self) -> Self {
        Self { start: self.start.exp_m1(), end: self.end.exp_m1(), change: self.exp().change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ln(self) -> Self {
        let change = change_of_logarithm(self.start, self.end, self.change);
        Self { start: self.start.ln(), end: self.end.ln(), change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn ln_1p(self) -> Self {
        let change = change_of_logarithm(T::one() + self.start, T::one() + self.end, self.change);
        Self { start: self.start.ln_1p(), end: self.end.ln_1p(), change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sin_cos(self) -> (Self, Self) {
        let ((s0, c0), (s1, c1)) = (self.start.sin_cos(), self.end.sin_cos());
        let (s, c) = self.mean().sin_cos();
        let chord = T::lit(2.0) * self.half_change().sin();
        (Self { start: s0, end: s1, change: c * chord }, Self { start: c0, end: c1, change: -(s * chord) })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tan(self) -> Self {
        let change = self.change.sin() / (self.start.cos() * self.end.cos());
        Self { start: self.start.tan(), end: self.end.tan(), change }
    }
    /// The sine of the change is a₁c₀ − a₀c₁ = δa (ā² + c̄²)/c̄ with c = √(1 − a²).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn asin(self) -> Self {
        let cosine = |a: T| ((T::one() - a) * (T::one() + a)).sqrt();
        let (c0, c1, mean) = (cosine(self.start), cosine(self.end), self.mean());
        let cosines = T::lit(0.5) * (c0 + c1);
        let sine = self.change * ((mean * mean + cosines * cosines) / cosines);
        let change = sine.atan2(c0 * c1 + self.start * self.end);
        Self::with_change_where(T::zero().less_than(cosines), self.start.asin(), self.end.asin(), change)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acos(self) -> Self {
        Self { start: self.start.acos(), end: self.end.acos(), change: -self.asin().change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan(self) -> Self {
        let change = self.change.atan2(T::one() + self.start * self.end);
        Self { start: self.start.atan(), end: self.end.atan(), change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        let (start, end) = (self.start.atan2(x.start), self.end.atan2(x.end));
        let sine = self.change * x.mean() - self.mean() * x.change;
        let turn = sine.atan2(x.start * x.end + self.start * self.end);
        // Whole turns where the angle jumps at ±π.
        let (pi, whole) = (T::lit(core::f64::consts::PI), T::lit(core::f64::consts::TAU));
        let jump = (end - start) - turn;
        let whole = T::select(pi.less_than(jump), whole, T::select(jump.less_than(-pi), -whole, T::zero()));
        // The origin has no direction: the angle between the ends is none.
        let lengths = (x.start.abs() + self.start.abs()) * (x.end.abs() + self.end.abs());
        let change = T::select(T::zero().less_than(lengths), turn + whole, end - start);
        Self { start, end, change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sinh(self) -> Self {
        let change = T::lit(2.0) * self.mean().cosh() * self.half_change().sinh();
        Self { start: self.start.sinh(), end: self.end.sinh(), change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cosh(self) -> Self {
        let change = T::lit(2.0) * self.mean().sinh() * self.half_change().sinh();
        Self { start: self.start.cosh(), end: self.end.cosh(), change }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tanh(self) -> Self {
        let (start, end) = (self.start.tanh(), self.end.tanh());
        Self { start, end, change: self.change.tanh() * (T::one() - start * end) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn abs(self) -> Self {
        Self::select(self.less_than(Self::zero()), -self, self)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn copysign(self, sign: Self) -> Self {
        let (start, end) = (self.start.copysign(sign.start), self.end.copysign(sign.end));
        let kept = SecantMask { start: equal(start, self.start), end: equal(end, self.end) };
        let change = T::select(kept.start, self.change, -self.change);
        Self::with_change_where(kept.agrees(), start, end, change)
    }
}
