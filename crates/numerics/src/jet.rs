//! `Jet<T, N>`: a value, N partial derivatives, and the first and second derivative along a motion.
//!
//! One pass of a placement map x(q, t) over jets gives all that Lagrange's equations need:
//!
//! ```text
//! seed   q^Δ ↦ { q^Δ;  ∂q^Δ/∂q^Γ = δ;  q̇^Δ;  0 }        t ↦ { t;  0;  1;  0 }
//! yields x   ↦ { x;    ∂x/∂q^Γ;        ẋ;    ẍ at q̈ = 0 }
//! ```
//!
//! so that a = (∂x/∂q) q̈ + `second_rate`. With N = 0 it is the Taylor polynomial of order two along a curve.

use crate::{Real, differentiable::entries};

/// A value with N partial derivatives and two derivatives along a motion, exact to rounding.
///
/// # Example
/// ```
/// use piola_numerics::{Jet, Real};
/// // Uniform circular motion x = cos θ, θ̇ = 2: ẋ = −2 sin θ, ẍ = −4 cos θ; at θ = 0.
/// let angle = Jet::<f64, 1>::coordinate(0.0, 2.0, 0);
/// let x = angle.cos();
/// assert_eq!((x.value, x.rate, x.second_rate), (1.0, 0.0, -4.0));
/// ```
#[doc(alias = "Taylor")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<T, const N: usize> {
    /// The value a.
    pub value: T,
    /// The partial derivatives ∂a/∂q^Γ.
    pub partials: [T; N],
    /// The derivative along the motion, ȧ.
    pub rate: T,
    /// The second derivative along the motion, ä.
    pub second_rate: T,
}

impl<T: Real, const N: usize> Jet<T, N> {
    /// The coordinate number `direction`, moving at `rate` without acceleration. A `direction` of N or
    /// more has no partial derivatives, so that chunks of directions need no special case.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn coordinate(value: T, rate: T, direction: usize) -> Self {
        let mut jet = Self { value, partials: [T::zero(); N], rate, second_rate: T::zero() };
        for (i, partial) in jet.partials.iter_mut().enumerate() {
            if i == direction {
                *partial = T::one();
            }
        }
        jet
    }
    /// A constant: all derivatives zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn constant(value: T) -> Self {
        Self { value, partials: [T::zero(); N], rate: T::zero(), second_rate: T::zero() }
    }
    /// The time itself: rate one, no partial derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn time(value: T) -> Self {
        Self { value, partials: [T::zero(); N], rate: T::one(), second_rate: T::zero() }
    }
    /// Whether there are no derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_fixed(&self) -> bool {
        *self == Self::constant(self.value)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn chain(self, f: T, f1: impl FnOnce() -> T, f2: impl FnOnce() -> T) -> Self {
        let (f1, f2) = (f1(), f2());
        Self {
            value: f,
            partials: entries(|i| self.partials[i] * f1),
            rate: self.rate * f1,
            second_rate: self.second_rate * f1 + self.rate * self.rate * f2,
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linear(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        Self {
            value: f(self.value, other.value),
            partials: entries(|i| f(self.partials[i], other.partials[i])),
            rate: f(self.rate, other.rate),
            second_rate: f(self.second_rate, other.second_rate),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn each(self, f: impl Fn(T) -> T) -> Self {
        Self {
            value: f(self.value),
            partials: entries(|i| f(self.partials[i])),
            rate: f(self.rate),
            second_rate: f(self.second_rate),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(self, o: Self) -> Self {
        let cross = self.rate * o.rate;
        Self {
            value: self.value * o.value,
            partials: entries(|i| self.partials[i] * o.value + self.value * o.partials[i]),
            rate: self.rate * o.value + self.value * o.rate,
            second_rate: self.second_rate * o.value + self.value * o.second_rate + (cross + cross),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn quotient(self, o: Self) -> Self {
        // The value is divided and not multiplied by r: it is that of the plain scalar, to the last bit.
        let r = T::one() / o.value;
        let value = self.value / o.value;
        let rate = (self.rate - value * o.rate) * r;
        let cross = rate * o.rate;
        Self {
            value,
            partials: entries(|i| (self.partials[i] - value * o.partials[i]) * r),
            rate,
            second_rate: (self.second_rate - value * o.second_rate - (cross + cross)) * r,
        }
    }
}

crate::differentiable::implement_real!(Jet<T, N>, 2, [T: Real, const N: usize], [const N: usize]);
