//! The chain rule, written once for [`Dual`](crate::Dual), [`Gradient`](crate::Gradient) and
//! [`Jet`](crate::Jet).
//!
//! Each of the three types supplies five inlined building blocks (`chain`, `linear`, `each`, `product`,
//! `quotient`); the macro turns them into the operators and all of [`Real`](crate::Real). The
//! derivatives of the elementary functions are therefore stated in one place, and second derivatives are
//! closures that types of first order never call.

/// [f(0), …, f(N − 1)]. The first sixteen are written out: numbers with derivatives are compiled for many scalars and sizes, and a
/// function of thousands of short loops takes the compiler twice as long. Conditions that are inline constants are decided before machine
/// code is made.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn entries<T: crate::Real, const N: usize>(f: impl Fn(usize) -> T) -> [T; N] {
    let mut entries = [T::zero(); N];
    macro_rules! written {
        ($($i:literal)*) => { $(if const { $i < N } { entries[$i] = f($i); })* };
    }
    written!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
    if const { 16 < N } {
        let mut i = 16;
        while i < N {
            entries[i] = f(i);
            i += 1;
        }
    }
    entries
}

/// 1 − x², without cancellation in its value near |x| = 1 or in its derivative −2x near x = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn one_minus_square<T: crate::Real>(x: T) -> T {
    let one = T::one();
    T::select(x.abs().less_than(T::lit(0.5)), one - x * x, (one - x) * (one + x))
}

/// Implements the operators and `Real` for a differentiable number over `T: Real`.
macro_rules! implement_real {
    ($type:ty, $order:literal, [$($parameters:tt)*], [$($constants:tt)*]) => {
        impl<$($parameters)*> core::ops::Add for $type {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn add(self, other: Self) -> Self {
                self.linear(other, |a, b| a + b)
            }
        }
        impl<$($parameters)*> core::ops::Sub for $type {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sub(self, other: Self) -> Self {
                self.linear(other, |a, b| a - b)
            }
        }
        impl<$($parameters)*> core::ops::Mul for $type {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul(self, other: Self) -> Self {
                self.product(other)
            }
        }
        impl<$($parameters)*> core::ops::Div for $type {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn div(self, other: Self) -> Self {
                self.quotient(other)
            }
        }
        impl<$($parameters)*> core::ops::Neg for $type {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn neg(self) -> Self {
                self.each(|a| -a)
            }
        }
        impl<$($parameters)*> core::ops::AddAssign for $type {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl<$($parameters)*> core::ops::SubAssign for $type {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl<$($parameters)*> core::ops::MulAssign for $type {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }
        impl<$($parameters)*> core::ops::DivAssign for $type {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn div_assign(&mut self, other: Self) {
                *self = *self / other;
            }
        }
        impl<$($parameters)*> num_traits::Zero for $type {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn zero() -> Self {
                Self::constant(T::zero())
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }
        impl<$($parameters)*> num_traits::One for $type {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn one() -> Self {
                Self::constant(T::one())
            }
        }

        impl<$($parameters)*> crate::Real for $type {
            type Mask = T::Mask;
            const LANES: usize = T::LANES;
            const ORDER: usize = T::ORDER + $order;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn lit(value: f64) -> Self {
                Self::constant(T::lit(value))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn primal(self, lane: usize) -> f64 {
                self.value.primal(lane)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn frozen(self) -> Self {
                Self::constant(self.value.frozen())
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn less_than(self, other: Self) -> Self::Mask {
                self.value.less_than(other.value)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn at_most(self, other: Self) -> Self::Mask {
                self.value.at_most(other.value)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self {
                if_true.linear(if_false, |a, b| T::select(mask, a, b))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn is_finite(self) -> Self::Mask {
                self.value.is_finite()
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn recip(self) -> Self {
                let r = self.value.recip();
                let r2 = r * r;
                self.chain(r, || -r2, || (r2 + r2) * r)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sqrt(self) -> Self {
                let r = self.value.sqrt();
                let half = T::lit(0.5) / r;
                self.chain(r, || half, || -(T::lit(0.5) * half / self.value))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn cbrt(self) -> Self {
                let r = self.value.cbrt();
                let f1 = T::lit(1.0) / (T::lit(3.0) * r * r);
                self.chain(r, || f1, || -(T::lit(2.0) * f1 / (T::lit(3.0) * self.value)))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn recip_cbrt(self) -> Self {
                let r = self.value.recip_cbrt();
                let square = r * r;
                let fourth = square * square;
                self.chain(r, || fourth * T::lit(-1.0 / 3.0), || T::lit(4.0 / 9.0) * (fourth * square * r))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn powi(self, n: i32) -> Self {
                // x⁰ and x¹ have no term in x⁻¹, so their derivatives stay finite at x = 0.
                let degree = f64::from(n);
                self.chain(
                    self.value.powi(n),
                    || if n == 0 { T::zero() } else { T::lit(degree) * self.value.powi(n.saturating_sub(1)) },
                    || {
                        if n == 0 || n == 1 {
                            T::zero()
                        } else {
                            T::lit(degree * (degree - 1.0)) * self.value.powi(n.saturating_sub(2))
                        }
                    },
                )
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn powf(self, exponent: Self) -> Self {
                let (x, y) = (self.value, exponent.value);
                let z = x.powf(y);
                let base_is_zero = x.at_most(T::zero()) & T::zero().at_most(x);
                // As a function of x at fixed y. The coefficients of x⁰ and x¹ vanish before 0⁻¹ and 0⁻²
                // are infinite: there the base is replaced by one, so that 0 · ∞ does not arise.
                let regular = |coefficient: T| {
                    let vanishes = coefficient.at_most(T::zero()) & T::zero().at_most(coefficient);
                    T::select(base_is_zero & vanishes, T::one(), x)
                };
                let in_base = self.chain(
                    z,
                    || y * regular(y).powf(y - T::one()),
                    || {
                        let coefficient = y * (y - T::one());
                        coefficient * regular(coefficient).powf(y - T::lit(2.0))
                    },
                );
                if exponent.is_fixed() {
                    return in_base;
                }
                // As a function of both, xʸ = e^w with w = y ln x; the value is that of the power itself,
                // which is more accurate than the exponential of a large w.
                let in_both = (exponent * self.ln()).chain(z, || z, || z);
                // At x = 0 < y the logarithm does not exist but xʸ ln x → 0: the exponent has no influence.
                let at_zero = if self.is_fixed() { Self::constant(z) } else { in_base };
                Self::select(base_is_zero & T::zero().less_than(y), at_zero, in_both)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn exp(self) -> Self {
                let e = self.value.exp();
                self.chain(e, || e, || e)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn exp_m1(self) -> Self {
                let e = self.value.exp();
                self.chain(self.value.exp_m1(), || e, || e)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn ln(self) -> Self {
                let r = self.value.recip();
                self.chain(self.value.ln(), || r, || -(r * r))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn ln_1p(self) -> Self {
                let r = (T::one() + self.value).recip();
                self.chain(self.value.ln_1p(), || r, || -(r * r))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn ln_1p_given(self, sum: Self) -> Self {
                let r = sum.value.recip();
                let near = self.value.abs().at_most(T::lit(0.5));
                Self::select(near, self, sum).chain(self.value.ln_1p_given(sum.value), || r, || -(r * r))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sin_cos(self) -> (Self, Self) {
                let (s, c) = self.value.sin_cos();
                (self.chain(s, || c, || -s), self.chain(c, || -s, || -c))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn tan(self) -> Self {
                let t = self.value.tan();
                let f1 = T::one() + t * t;
                self.chain(t, || f1, || T::lit(2.0) * t * f1)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn asin(self) -> Self {
                let x = self.value;
                let f1 = crate::differentiable::one_minus_square(x).sqrt().recip();
                self.chain(x.asin(), || f1, || x * f1 * f1 * f1)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn acos(self) -> Self {
                let x = self.value;
                let f1 = crate::differentiable::one_minus_square(x).sqrt().recip();
                self.chain(x.acos(), || -f1, || -(x * f1 * f1 * f1))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn atan(self) -> Self {
                let x = self.value;
                let f1 = (T::one() + x * x).recip();
                self.chain(x.atan(), || f1, || -(T::lit(2.0) * x * f1 * f1))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn atan2(self, x: Self) -> Self {
                // The angle is θ₀ + arctan(η/ξ), where (ξ, η) is the point turned back by the constant θ₀,
                // so that the quotient vanishes at the value and all its derivatives are regular. Only the
                // direction of the constant (c, s) matters; its length is near one so that no product
                // overflows.
                let (x0, y0) = (x.value, self.value);
                let length = x0.abs().max(y0.abs());
                let (c, s) = (Self::constant(x0 / length), Self::constant(y0 / length));
                let turned = (self * c - x * s) / (x * c + self * s);
                turned.chain(y0.atan2(x0), T::one, T::zero)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sinh(self) -> Self {
                let (s, c) = (self.value.sinh(), self.value.cosh());
                self.chain(s, || c, || s)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn cosh(self) -> Self {
                let (s, c) = (self.value.sinh(), self.value.cosh());
                self.chain(c, || s, || c)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn tanh(self) -> Self {
                let t = self.value.tanh();
                let c = self.value.cosh();
                let f1 = (c * c).recip();
                self.chain(t, || f1, || -(T::lit(2.0) * t * f1))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn abs(self) -> Self {
                let negative = self.value.less_than(T::zero());
                let sign = T::select(negative, -T::one(), T::one());
                self.chain(self.value.abs(), || sign, T::zero)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn copysign(self, sign: Self) -> Self {
                let flip = T::one().copysign(self.value) * T::one().copysign(sign.value);
                self.each(|a| a * flip)
            }
        }
    };
}

pub(crate) use implement_real;
