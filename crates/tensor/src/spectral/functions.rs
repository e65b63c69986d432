//! Ready-made isotropic functions, their divided differences closed and without cancellation.

use piola_numerics::Real;

use super::IsotropicFunction;
use super::decomposition::ordered;
use crate::TensorError;
use crate::error::check_finite;

/// √x.
///
/// # Example
/// ```
/// use piola_tensor::{Symmetric, spectral};
/// let root = spectral::tensor_function(&spectral::SquareRoot, &Symmetric::diagonal([4.0, 9.0, 1.0]));
/// let error = root - Symmetric::diagonal([2.0, 3.0, 1.0]);
/// assert!(error.norm() < 4e-15_f64);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SquareRoot;

impl IsotropicFunction for SquareRoot {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, x: T) -> T {
        x.sqrt()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        (a.sqrt() + b.sqrt()).recip()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_divided_difference<T: Real>(&self, a: T, b: T, c: T) -> T {
        let (a, b, c) = (a.sqrt(), b.sqrt(), c.sqrt());
        -((a + b) * (b + c) * (c + a)).recip()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rough_divided_difference<T: Real>(&self, _a: T, _b: T, root_of_a: T, root_of_b: T) -> T {
        (root_of_a + root_of_b).recip()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope_at_one<T: Real>(&self) -> T {
        T::lit(0.5)
    }
}

/// ln x.
///
/// # Example
/// ```
/// use piola_tensor::spectral::{IsotropicFunction, Logarithm};
/// assert_eq!(Logarithm.divided_difference(2.0, 2.0), 0.5); // ln′ 2
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Logarithm;

impl IsotropicFunction for Logarithm {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, x: T) -> T {
        x.ln()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value_beside_one<T: Real>(&self, x: T) -> T {
        x.ln_1p()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value_of_root<T: Real>(&self, _root: T, square: T) -> T {
        T::lit(0.5) * square.ln()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value_of_root_beside_one<T: Real>(&self, _excess: T, square_less_one: T) -> T {
        T::lit(0.5) * square_less_one.ln_1p()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        // ln(1 + w)/(w b) with w = (a − b)/b ≥ 0, where the argument's rounding is not magnified.
        let (a, b) = ordered(a, b);
        logarithmic_quotient((a - b) / b) / b
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rough_divided_difference<T: Real>(&self, a: T, b: T, log_of_a: T, log_of_b: T) -> T {
        // 2/(a + b) is within z²/3 for z = (a − b)/(a + b).
        let (sum, gap) = (a + b, a - b);
        let near = gap.abs().less_than(sum * T::lit(1e-4));
        // The quotient need not wait for the logarithms.
        T::select(near, T::lit(2.0), log_of_a - log_of_b) * T::select(near, sum, gap).recip()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope_at_one<T: Real>(&self) -> T {
        T::one()
    }
}

/// eˣ.
///
/// # Example
/// ```
/// use piola_tensor::{Symmetric, spectral};
/// let exponential = spectral::tensor_function(&spectral::Exponential, &Symmetric::diagonal([1.0, 0.0, 0.0]));
/// assert!((exponential.components[0] - 1.0_f64.exp()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Exponential;

impl IsotropicFunction for Exponential {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, x: T) -> T {
        x.exp()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        // eᵇ (e^w − 1)/w with w = a − b ≥ 0.
        let (a, b) = ordered(a, b);
        b.exp() * exponential_quotient(a - b)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn smooth_within<T: Real>(&self, _x: T) -> T {
        T::lit(3.0)
    }
}

/// xᵖ for a fixed real power p.
///
/// # Example
/// ```
/// use piola_tensor::{Symmetric, spectral};
/// let inverse = spectral::tensor_function(&spectral::Power(-1.0), &Symmetric::diagonal([4.0, 2.0, 1.0]));
/// assert_eq!(inverse.components[..3], [0.25, 0.5, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "f64"))]
pub struct Power(
    /// p.
    pub f64,
);

impl TryFrom<f64> for Power {
    type Error = TensorError;
    fn try_from(exponent: f64) -> Result<Self, TensorError> {
        check_finite("exponent", &[exponent])?;
        Ok(Self(exponent))
    }
}

impl IsotropicFunction for Power {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, x: T) -> T {
        x.powf(T::lit(self.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        // bᵖ (e^(p l) − 1)/(b w) with w = (a − b)/b and l = ln(1 + w) ≥ 0.
        let (a, b) = ordered(a, b);
        let p = T::lit(self.0);
        let w = (a - b) / b;
        let quotient = logarithmic_quotient(w);
        b.powf(p) * (p / b) * quotient * exponential_quotient(p * (w * quotient))
    }
}

/// ln(1 + w)/w, 1 at w = 0, with its derivatives there.
#[cfg_attr(not(debug_assertions), inline(always))]
fn logarithmic_quotient<T: Real>(w: T) -> T {
    let apart = if T::ORDER == 0 { T::zero().less_than(w.abs()) } else { T::lit(0.0625).less_than(w.abs()) };
    let quotient = w.ln_1p() / T::select(apart, w, T::one());
    if T::ORDER == 0 {
        return T::select(apart, quotient, T::one());
    }
    let mut sum = T::zero();
    for k in (1..=20).rev() {
        sum = T::lit(1.0 / f64::from(k)) - w * sum;
    }
    T::select(apart, quotient, sum)
}

/// (e^w − 1)/w, 1 at w = 0, with its derivatives there.
#[cfg_attr(not(debug_assertions), inline(always))]
fn exponential_quotient<T: Real>(w: T) -> T {
    let apart = if T::ORDER == 0 { T::zero().less_than(w.abs()) } else { T::lit(0.0625).less_than(w.abs()) };
    let quotient = w.exp_m1() / T::select(apart, w, T::one());
    if T::ORDER == 0 {
        return T::select(apart, quotient, T::one());
    }
    let mut sum = T::one();
    for k in (2..=16).rev() {
        sum = T::one() + w * sum * T::lit(1.0 / f64::from(k));
    }
    T::select(apart, quotient, sum)
}
