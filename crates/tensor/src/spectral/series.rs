//! Truncated power series of one variable: all derivatives of a user's function from one evaluation of it.
//!
//! ```text
//! x = x₀ + x₁ ε + … + x₂₇ ε²⁷
//! (x y)ₖ = Σ xⱼ yₖ₋ⱼ        y = exp x:  k yₖ = Σ j xⱼ yₖ₋ⱼ        y = xᵖ:  k x₀ yₖ = Σ (p j − (k − j)) xⱼ yₖ₋ⱼ
//! ```
//! The other functions follow by integration of their derivative. Nothing here is forced inline: series are long, rare
//! and would swell every kernel that might want one.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};
use piola_numerics::Real;

/// How many coefficients are kept.
pub(super) const TERMS: usize = 28;

/// x₀ + x₁ ε + … with [`TERMS`] coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Series<T>(pub(super) [T; TERMS]);

impl<T: Real> Series<T> {
    /// x₀ + x₁ ε.
    #[inline]
    pub(super) fn variable(value: T, unit: T) -> Self {
        let mut series = Self::constant(value);
        series.0[1] = unit;
        series
    }
    #[inline]
    fn constant(value: T) -> Self {
        let mut coefficients = [T::zero(); TERMS];
        coefficients[0] = value;
        Self(coefficients)
    }
    #[inline]
    fn each(mut self, f: impl Fn(T) -> T) -> Self {
        for x in &mut self.0 {
            *x = f(*x);
        }
        self
    }
    #[inline]
    fn with(mut self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        for (x, y) in self.0.iter_mut().zip(other.0) {
            *x = f(*x, y);
        }
        self
    }
    /// x′.
    #[inline]
    fn derivative(self) -> Self {
        let mut result = [T::zero(); TERMS];
        for k in 1..TERMS {
            result[k - 1] = self.0[k] * T::lit(k as f64);
        }
        Self(result)
    }
    /// The series with value `value` and derivative `self`.
    #[inline]
    fn integral(self, value: T) -> Self {
        let mut result = Self::constant(value);
        for k in 1..TERMS {
            result.0[k] = self.0[k - 1] / T::lit(k as f64);
        }
        result
    }
    /// xᵖ, whose value is `value`.
    #[inline]
    fn power(self, p: T, value: T) -> Self {
        let x = self.0;
        let reciprocal = x[0].recip();
        let mut y = Self::constant(value).0;
        for k in 1..TERMS {
            let mut sum = T::zero();
            for j in 1..=k {
                sum += (p * T::lit(j as f64) - T::lit((k - j) as f64)) * x[j] * y[k - j];
            }
            y[k] = sum * reciprocal / T::lit(k as f64);
        }
        Self(y)
    }
    /// (y, z) with y′ = z x′ and z′ = ±y x′: hyperbolic for `+`, circular for `−`.
    #[inline]
    fn pair(self, y0: T, z0: T, sign: f64) -> (Self, Self) {
        let (mut y, mut z) = (Self::constant(y0).0, Self::constant(z0).0);
        for k in 1..TERMS {
            let (mut a, mut b) = (T::zero(), T::zero());
            for j in 1..=k {
                let slope = self.0[j] * T::lit(j as f64);
                a += slope * z[k - j];
                b += slope * y[k - j];
            }
            y[k] = a / T::lit(k as f64);
            z[k] = b * T::lit(sign) / T::lit(k as f64);
        }
        (Self(y), Self(z))
    }
}

macro_rules! operator {
    ($Trait:ident $function:ident $Assign:ident $assign:ident, $self:ident $other:ident, $body:expr) => {
        impl<T: Real> $Trait for Series<T> {
            type Output = Self;
            #[inline]
            fn $function($self, $other: Self) -> Self {
                $body
            }
        }
        impl<T: Real> $Assign for Series<T> {
            #[inline]
            fn $assign(&mut self, other: Self) {
                *self = (*self).$function(other);
            }
        }
    };
}
operator!(Add add AddAssign add_assign, self other, self.with(other, |a, b| a + b));
operator!(Sub sub SubAssign sub_assign, self other, self.with(other, |a, b| a - b));
operator!(Mul mul MulAssign mul_assign, self other, {
    let mut result = [T::zero(); TERMS];
    for (k, entry) in result.iter_mut().enumerate() {
        for j in 0..=k {
            *entry += self.0[j] * other.0[k - j];
        }
    }
    Self(result)
});
operator!(Div div DivAssign div_assign, self other, {
    let reciprocal = other.0[0].recip();
    let mut result = [T::zero(); TERMS];
    result[0] = self.0[0] / other.0[0];
    for k in 1..TERMS {
        let mut sum = self.0[k];
        for j in 1..=k {
            sum -= other.0[j] * result[k - j];
        }
        result[k] = sum * reciprocal;
    }
    Self(result)
});

impl<T: Real> Neg for Series<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.each(|x| -x)
    }
}

impl<T: Real> Zero for Series<T> {
    #[inline]
    fn zero() -> Self {
        Self::constant(T::zero())
    }
    #[inline]
    fn is_zero(&self) -> bool {
        self.0.iter().all(Zero::is_zero)
    }
}

impl<T: Real> One for Series<T> {
    #[inline]
    fn one() -> Self {
        Self::constant(T::one())
    }
}

impl<T: Real> Real for Series<T> {
    type Mask = T::Mask;
    const LANES: usize = T::LANES;
    const ORDER: usize = T::ORDER + TERMS - 1;

    #[inline]
    fn lit(value: f64) -> Self {
        Self::constant(T::lit(value))
    }
    #[inline]
    fn primal(self, lane: usize) -> f64 {
        self.0[0].primal(lane)
    }
    #[inline]
    fn frozen(self) -> Self {
        Self::constant(self.0[0].frozen())
    }
    #[inline]
    fn less_than(self, other: Self) -> Self::Mask {
        self.0[0].less_than(other.0[0])
    }
    #[inline]
    fn at_most(self, other: Self) -> Self::Mask {
        self.0[0].at_most(other.0[0])
    }
    #[inline]
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self {
        if_true.with(if_false, |a, b| T::select(mask, a, b))
    }
    #[inline]
    fn is_finite(self) -> Self::Mask {
        self.0[0].is_finite()
    }
    #[inline]
    fn sqrt(self) -> Self {
        self.power(T::lit(0.5), self.0[0].sqrt())
    }
    #[inline]
    fn cbrt(self) -> Self {
        self.power(T::one() / T::lit(3.0), self.0[0].cbrt())
    }
    #[inline]
    fn powi(self, n: i32) -> Self {
        let mut result = Self::one();
        let (mut power, mut left) = (self, n.unsigned_abs());
        while left != 0 {
            if left & 1 == 1 {
                result *= power;
            }
            left >>= 1;
            if left != 0 {
                power *= power;
            }
        }
        if n < 0 { Self::one() / result } else { result }
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        if exponent.0[1..].iter().all(Zero::is_zero) {
            self.power(exponent.0[0], self.0[0].powf(exponent.0[0]))
        } else {
            (self.ln() * exponent).exp()
        }
    }
    #[inline]
    fn exp(self) -> Self {
        let mut y = Self::constant(self.0[0].exp()).0;
        for k in 1..TERMS {
            let mut sum = T::zero();
            for j in 1..=k {
                sum += self.0[j] * T::lit(j as f64) * y[k - j];
            }
            y[k] = sum / T::lit(k as f64);
        }
        Self(y)
    }
    #[inline]
    fn exp_m1(self) -> Self {
        let mut result = self.exp();
        result.0[0] = self.0[0].exp_m1();
        result
    }
    #[inline]
    fn ln(self) -> Self {
        (self.derivative() / self).integral(self.0[0].ln())
    }
    #[inline]
    fn ln_1p(self) -> Self {
        (self.derivative() / (self + Self::one())).integral(self.0[0].ln_1p())
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.0[0].sin_cos();
        self.pair(s, c, -1.0)
    }
    #[inline]
    fn asin(self) -> Self {
        (self.derivative() / (Self::one() - self * self).sqrt()).integral(self.0[0].asin())
    }
    #[inline]
    fn acos(self) -> Self {
        (-self.derivative() / (Self::one() - self * self).sqrt()).integral(self.0[0].acos())
    }
    #[inline]
    fn atan(self) -> Self {
        (self.derivative() / (Self::one() + self * self)).integral(self.0[0].atan())
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let slope = (x * self.derivative() - self * x.derivative()) / (x * x + self * self);
        slope.integral(self.0[0].atan2(x.0[0]))
    }
    #[inline]
    fn sinh(self) -> Self {
        self.pair(self.0[0].sinh(), self.0[0].cosh(), 1.0).0
    }
    #[inline]
    fn cosh(self) -> Self {
        self.pair(self.0[0].sinh(), self.0[0].cosh(), 1.0).1
    }
    #[inline]
    fn tanh(self) -> Self {
        // y′ = (1 − y²) x′, order by order.
        let mut y = Self::constant(self.0[0].tanh()).0;
        let mut slope = Self::zero().0;
        for k in 1..TERMS {
            let mut square = T::zero();
            for j in 0..k {
                square += y[j] * y[k - 1 - j];
            }
            slope[k - 1] = if k == 1 { T::one() - square } else { -square };
            let mut sum = T::zero();
            for j in 1..=k {
                sum += self.0[j] * T::lit(j as f64) * slope[k - j];
            }
            y[k] = sum / T::lit(k as f64);
        }
        Self(y)
    }
    #[inline]
    fn abs(self) -> Self {
        self.copysign(Self::one())
    }
    #[inline]
    fn copysign(self, sign: Self) -> Self {
        let change = T::one().copysign(self.0[0].frozen()) * T::one().copysign(sign.0[0].frozen());
        self.each(|x| x * change)
    }
}
