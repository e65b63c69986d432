//! A scalar of twice the precision of a double: the yardstick of rounding.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use nalgebra::{one, zero};
use piola_numerics::Real;
use twofloat::TwoFloat;

/// An unevaluated sum of two doubles, of about 31 digits.
///
/// The formula that is tested runs over it as it runs over doubles, and the difference of the two results is
/// the rounding of the latter. It says nothing about whether the formula is right.
///
/// Sums and products are within 1e-31 relative, elementary functions within 1e-28 of the larger of the result
/// and the argument's rounding; infinities and subnormals are not carried beyond the leading double.
///
/// # Example
/// ```
/// use piola_numerics::Real;
/// use piola_testkit::DoubleDouble;
/// let third = DoubleDouble::lit(1.0) / DoubleDouble::lit(3.0);
/// assert!((third.rounding_of(1.0 / 3.0) - 1.850371707708594e-17).abs() < 1e-32);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble(TwoFloat);

impl DoubleDouble {
    /// The sum of two doubles, exactly.
    #[must_use]
    pub fn of_sum(a: f64, b: f64) -> Self {
        Self(TwoFloat::new_add(a, b))
    }

    /// What `rounded` lacks of this number.
    #[must_use]
    pub fn rounding_of(self, rounded: f64) -> f64 {
        (self.0 - rounded).hi()
    }
}

macro_rules! operators {
    ($($Trait:ident $function:ident $Assign:ident $assign:ident),*) => { $(
        impl $Trait for DoubleDouble {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
        impl $Assign for DoubleDouble {
            fn $assign(&mut self, other: Self) {
                *self = self.$function(other);
            }
        }
    )* };
}
operators!(Add add AddAssign add_assign, Sub sub SubAssign sub_assign, Mul mul MulAssign mul_assign);

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        // One step of refinement: the library's quotient is a few units short of full precision.
        let quotient = self.0 / other.0;
        let remainder = self.0 - quotient * other.0;
        let refined = quotient + remainder / other.0;
        Self(if refined.is_valid() { refined } else { quotient })
    }
}

impl DivAssign for DoubleDouble {
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl num_traits::Zero for DoubleDouble {
    fn zero() -> Self {
        Self(TwoFloat::from_f64(0.0))
    }
    fn is_zero(&self) -> bool {
        self.0 == TwoFloat::from_f64(0.0)
    }
}

impl num_traits::One for DoubleDouble {
    fn one() -> Self {
        Self(TwoFloat::from_f64(1.0))
    }
}

/// The solution y of f(y) = x near the library's y₀, by one step of Newton's iteration.
fn newton(start: TwoFloat, excess: DoubleDouble, slope: DoubleDouble) -> DoubleDouble {
    DoubleDouble(start) - excess / slope
}

impl Real for DoubleDouble {
    type Mask = bool;
    const LANES: usize = 1;
    const ORDER: usize = 0;

    fn lit(value: f64) -> Self {
        Self(TwoFloat::from_f64(value))
    }
    fn primal(self, _lane: usize) -> f64 {
        self.0.hi()
    }
    fn frozen(self) -> Self {
        self
    }
    fn less_than(self, other: Self) -> bool {
        self.0 < other.0
    }
    fn at_most(self, other: Self) -> bool {
        self.0 <= other.0
    }
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
    fn is_finite(self) -> bool {
        self.0.hi().is_finite()
    }
    fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        if self.is_zero_or_beyond() {
            return Self(TwoFloat::from_f64(self.0.hi().sqrt()));
        }
        newton(root, Self(root) * Self(root) - self, Self::lit(2.0) * Self(root))
    }
    fn cbrt(self) -> Self {
        if self.0.hi().abs() <= 0.0 {
            return self;
        }
        let root = Self(self.0.cbrt());
        newton(root.0, root * root * root - self, Self::lit(3.0) * root * root)
    }
    fn powi(self, n: i32) -> Self {
        let (mut result, mut power, mut left) = (one::<Self>(), self, n.unsigned_abs());
        while left != 0 {
            if left & 1 == 1 {
                result *= power;
            }
            left >>= 1;
            if left != 0 {
                power = power * power;
            }
        }
        if n < 0 { one::<Self>() / result } else { result }
    }
    fn powf(self, exponent: Self) -> Self {
        (exponent * self.ln()).exp()
    }
    fn exp(self) -> Self {
        // eˣ = (1 + (e^(x/2^k) − 1))^(2^k), the series being short for |x|/2^k < 2⁻⁸.
        let x = self.0.hi();
        if 700.0 <= x.abs() || x.is_nan() {
            return Self::lit(x.exp());
        }
        if x < 0.0 {
            return one::<Self>() / (-self).exp();
        }
        let mut reduced = self;
        let mut halvings = 0;
        while 2f64.powi(-8) < reduced.0.hi().abs() {
            reduced *= Self::lit(0.5);
            halvings += 1;
        }
        let mut less_one = exp_m1_series(reduced);
        for _ in 0..halvings {
            less_one = less_one * (less_one + Self::lit(2.0));
        }
        less_one + one()
    }
    fn exp_m1(self) -> Self {
        if self.0.hi().abs() < 0.004 { exp_m1_series(self) } else { self.exp() - one() }
    }
    fn ln(self) -> Self {
        let start = self.0.hi().ln();
        if !start.is_finite() {
            return Self::lit(start);
        }
        if 0.5 < self.0.hi() && self.0.hi() < 2.0 {
            return (self - one()).ln_1p(); // the difference is exact
        }
        // Two steps of Newton's iteration for eʸ = x, each of which doubles the digits.
        let mut y = Self::lit(start);
        for _ in 0..2 {
            y += self * (-y).exp() - one();
        }
        y
    }
    fn ln_1p(self) -> Self {
        let start = self.0.hi().ln_1p();
        if !start.is_finite() || self.0.hi().abs() <= 0.0 {
            return if start.is_finite() { self } else { Self::lit(start) };
        }
        let mut y = Self::lit(start);
        for _ in 0..2 {
            let less_one = y.exp_m1();
            y += (self - less_one) / (less_one + one());
        }
        y
    }
    fn sin_cos(self) -> (Self, Self) {
        // x = k π/2 + r, then r by the series of r/8 and three doublings.
        let x = self.0.hi();
        if 1e9 <= x.abs() || x.is_nan() {
            return (Self(self.0.sin()), Self(self.0.cos()));
        }
        let quarter = (x * core::f64::consts::FRAC_2_PI).round();
        // π/2 to 160 bits, as three doubles of which the products with small whole numbers are exact enough.
        let half_pi = [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_183_3e-33];
        let mut r = self;
        for part in half_pi {
            r -= Self::lit(quarter) * Self::lit(part);
        }
        let (s, c) = sin_cos_by_series(r);
        let turned = [(s, c), (c, -s), (-s, -c), (-c, s)];
        turned[(0..3_u8).find(|&k| quarter.rem_euclid(4.0) < f64::from(k) + 0.5).map_or(3, usize::from)]
    }
    fn asin(self) -> Self {
        self.atan2((one::<Self>() - self * self).sqrt())
    }
    fn acos(self) -> Self {
        ((one::<Self>() - self) * (one::<Self>() + self)).sqrt().atan2(self)
    }
    fn atan(self) -> Self {
        self.atan2(one())
    }
    fn atan2(self, x: Self) -> Self {
        let start = self.0.hi().atan2(x.0.hi());
        let length = (self * self + x * x).sqrt();
        if !start.is_finite() || length.is_zero_or_beyond() {
            return Self::lit(start);
        }
        // sin(φ − φ₀) by the addition theorem, and the arcsine of what is as small as a rounding.
        let mut angle = Self::lit(start);
        for _ in 0..2 {
            let (s, c) = angle.sin_cos();
            angle += (self * c - x * s) / length;
        }
        angle
    }
    fn sinh(self) -> Self {
        let less_one = self.abs().exp_m1();
        (Self::lit(0.5) * (less_one + less_one / (less_one + one()))).copysign(self)
    }
    fn cosh(self) -> Self {
        let e = self.exp();
        Self::lit(0.5) * (e + one::<Self>() / e)
    }
    fn tanh(self) -> Self {
        if 40.0 < self.0.hi().abs() {
            return Self::lit(self.0.hi().signum());
        }
        let less_one = (Self::lit(2.0) * self).exp_m1();
        less_one / (less_one + Self::lit(2.0))
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(&sign.0))
    }
}

impl DoubleDouble {
    /// Zero, infinite or not a number: where iterations have nothing to correct.
    fn is_zero_or_beyond(self) -> bool {
        self.0.hi() == 0.0 || !self.0.hi().is_finite()
    }
}

/// eˣ − 1 for |x| ≤ 2⁻⁷.
fn exp_m1_series(x: DoubleDouble) -> DoubleDouble {
    let (mut term, mut sum) = (x, x);
    for n in 2..=16 {
        term = term * x / DoubleDouble::lit(f64::from(n));
        sum += term;
    }
    sum
}

/// sin r and cos r for |r| ≤ π/4.
fn sin_cos_by_series(r: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let square = r * r;
    let (mut sine, mut cosine): (DoubleDouble, DoubleDouble) = (r, one());
    let (mut odd, mut even) = (r, one::<DoubleDouble>());
    for n in 1..=14 {
        let n = f64::from(2 * n);
        even = -even * square / DoubleDouble::lit((n - 1.0) * n);
        odd = -odd * square / DoubleDouble::lit(n * (n + 1.0));
        cosine += even;
        sine += odd;
    }
    if r.0.hi().abs() <= 0.0 { (zero(), one()) } else { (sine, cosine) }
}
