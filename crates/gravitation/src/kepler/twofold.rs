//! Numbers of twice the precision, as unevaluated sums of two doubles.

use core::ops::{Add, Div, Mul, Neg, Sub};

use piola_numerics::sums::{two_product, two_sum};

/// `high + low` with |low| ≤ ½ ulp(high): about 32 digits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Twofold {
    pub(super) high: f64,
    pub(super) low: f64,
}

/// 2π, to 32 digits.
pub(super) const TURN: Twofold = Twofold { high: core::f64::consts::TAU, low: 2.449_293_598_294_706_4e-16 };

impl Twofold {
    pub(super) fn of(x: f64) -> Self {
        Self { high: x, low: 0.0 }
    }
    pub(super) fn value(self) -> f64 {
        self.high + self.low
    }
    fn normal(high: f64, low: f64) -> Self {
        let (high, low) = two_sum(high, low);
        Self { high, low }
    }
    /// √x for 0 < x: one Newton step from the rounded root.
    pub(super) fn sqrt(self) -> Self {
        let root = Self::of(self.high.sqrt());
        root + (self - root * root) / Self::of(2.0 * root.high)
    }
    pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> Self {
        a.into_iter().zip(b).fold(Self::of(0.0), |sum, (x, y)| sum + Self::of(x) * Self::of(y))
    }
}

impl Neg for Twofold {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Twofold {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        let (low, lower) = two_sum(self.low, other.low);
        let sum = Self::normal(high, error + low);
        Self::normal(sum.high, sum.low + lower)
    }
}

impl Sub for Twofold {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (high, error) = two_product(self.high, other.high);
        Self::normal(high, error + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Twofold {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::of(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::of(second);
        Self::normal(first, second) + Self::of(rest.high / other.high)
    }
}
