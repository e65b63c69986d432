//! Sums and multiples, the same for every tensor type.

/// Implements the operators of a linear space for a type with `zero()` and the private
/// `each(&self, &other, |a, b| …)` that combines components.
#[doc(hidden)]
#[macro_export]
macro_rules! linear_space {
    ($name:ident) => {
        impl<T: piola_numerics::Real> Default for $name<T> {
            /// 0.
            fn default() -> Self {
                Self::zero()
            }
        }
        impl<T: piola_numerics::Real> core::ops::Add for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn add(self, other: Self) -> Self {
                Self::each(&self, &other, |a, b| a + b)
            }
        }
        impl<T: piola_numerics::Real> core::ops::Sub for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sub(self, other: Self) -> Self {
                Self::each(&self, &other, |a, b| a - b)
            }
        }
        impl<T: piola_numerics::Real> core::ops::AddAssign for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn add_assign(&mut self, other: Self) {
                *self = Self::each(self, &other, |a, b| a + b);
            }
        }
        impl<T: piola_numerics::Real> core::ops::SubAssign for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sub_assign(&mut self, other: Self) {
                *self = Self::each(self, &other, |a, b| a - b);
            }
        }
        impl<T: piola_numerics::Real> core::ops::Neg for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn neg(self) -> Self {
                Self::each(&self, &self, |a, _| -a)
            }
        }
        impl<T: piola_numerics::Real> core::ops::Mul<T> for $name<T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul(self, factor: T) -> Self {
                Self::each(&self, &self, |a, _| a * factor)
            }
        }
        impl<T: piola_numerics::Real> core::ops::MulAssign<T> for $name<T> {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul_assign(&mut self, factor: T) {
                *self = Self::each(self, self, |a, _| a * factor);
            }
        }
        impl<T: piola_numerics::Real> core::ops::Div<T> for $name<T> {
            type Output = Self;
            /// Each component divided: rounded once.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn div(self, divisor: T) -> Self {
                Self::each(&self, &self, |a, _| a / divisor)
            }
        }
        impl<T: piola_numerics::Real> core::iter::Sum for $name<T> {
            fn sum<I: Iterator<Item = Self>>(tensors: I) -> Self {
                tensors.fold(Self::zero(), |sum, tensor| sum + tensor)
            }
        }
    };
}
