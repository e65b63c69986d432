//! `Gradient<T, N>`: a value and its derivatives along N directions at once.
//!
//! Functions of more than N variables are differentiated in chunks of N directions: see
//! [`derivatives`](crate::derivatives).

use crate::{Real, differentiable::entries};

/// A value and N partial derivatives, exact to rounding.
///
/// # Example
/// ```
/// use piola_numerics::Gradient;
/// let x = Gradient::<f64, 2>::variable(3.0, 0);
/// let y = Gradient::<f64, 2>::variable(4.0, 1);
/// assert_eq!((x * y).partials, [4.0, 3.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient<T, const N: usize> {
    /// The value a.
    pub value: T,
    /// The partial derivatives ∂a/∂xᵢ.
    pub partials: [T; N],
}

impl<T: Real, const N: usize> Gradient<T, N> {
    /// The variable number `direction`: its own partial derivative is one. A `direction` of N or more
    /// gives a constant, so that chunks of directions need no special case.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn variable(value: T, direction: usize) -> Self {
        let mut partials = [T::zero(); N];
        for (i, partial) in partials.iter_mut().enumerate() {
            if i == direction {
                *partial = T::one();
            }
        }
        Self { value, partials }
    }
    /// A constant: all derivatives zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn constant(value: T) -> Self {
        Self { value, partials: [T::zero(); N] }
    }
    /// Whether there are no derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn is_fixed(&self) -> bool {
        *self == Self::constant(self.value)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn chain(self, f: T, f1: impl FnOnce() -> T, _f2: impl FnOnce() -> T) -> Self {
        let f1 = f1();
        Self { value: f, partials: entries(|i| self.partials[i] * f1) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linear(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        Self { value: f(self.value, other.value), partials: entries(|i| f(self.partials[i], other.partials[i])) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn each(self, f: impl Fn(T) -> T) -> Self {
        Self { value: f(self.value), partials: entries(|i| f(self.partials[i])) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(self, o: Self) -> Self {
        Self {
            value: self.value * o.value,
            partials: entries(|i| self.partials[i] * o.value + self.value * o.partials[i]),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn quotient(self, o: Self) -> Self {
        // The value is divided and not multiplied by r: it is that of the plain scalar, to the last bit.
        let r = T::one() / o.value;
        let value = self.value / o.value;
        Self { value, partials: entries(|i| (self.partials[i] - value * o.partials[i]) * r) }
    }
}

crate::differentiable::implement_real!(Gradient<T, N>, 1, [T: Real, const N: usize], [const N: usize]);
