//! `Dual<T>`: a value and its derivative along one direction.
//!
//! ```text
//! a + a′ε,  ε² = 0        f(a + a′ε) = f(a) + f′(a) a′ ε
//! ```
//!
//! `Dual<Dual<T>>` carries second derivatives, `Dual<Lanes<f64, 4>>` four points at once.

use crate::Real;

/// A value and its derivative along one direction, exact to rounding.
///
/// # Example
/// ```
/// use piola_numerics::{Dual, Real};
/// let x = Dual::variable(0.0_f64);
/// assert_eq!((x * x.exp()).tangent, 1.0); // (x eˣ)′ = 1 at 0
/// ```
#[doc(alias("automatic differentiation", "forward mode"))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Dual<T> {
    /// The value a.
    pub value: T,
    /// The derivative a′ along the direction.
    pub tangent: T,
}

impl<T: Real> Dual<T> {
    /// A value with a given derivative.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn new(value: T, tangent: T) -> Self {
        Self { value, tangent }
    }
    /// The variable itself: derivative one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn variable(value: T) -> Self {
        Self { value, tangent: T::one() }
    }
    /// A constant: derivative zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn constant(value: T) -> Self {
        Self { value, tangent: T::zero() }
    }
    /// Whether there are no derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_fixed(&self) -> bool {
        *self == Self::constant(self.value)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn chain(self, f: T, f1: impl FnOnce() -> T, _f2: impl FnOnce() -> T) -> Self {
        Self { value: f, tangent: self.tangent * f1() }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linear(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        Self { value: f(self.value, other.value), tangent: f(self.tangent, other.tangent) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn each(self, f: impl Fn(T) -> T) -> Self {
        Self { value: f(self.value), tangent: f(self.tangent) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(self, o: Self) -> Self {
        Self { value: self.value * o.value, tangent: self.tangent * o.value + self.value * o.tangent }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn quotient(self, o: Self) -> Self {
        // The value is divided and not multiplied by r: it is that of the plain scalar, to the last bit.
        let r = T::one() / o.value;
        let value = self.value / o.value;
        Self { value, tangent: (self.tangent - value * o.tangent) * r }
    }
}

crate::differentiable::implement_real!(Dual<T>, 1, [T: Real], []);
