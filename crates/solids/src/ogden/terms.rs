//! The series of powers of the principal stretches that all of Ogden's solids share.

use piola_continuum::Deformation;
use piola_continuum::polar::StretchAnalysis;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::double_contraction;
use piola_tensor::spectral::{Exponential, IsotropicFunction};

use crate::SolidsError;
use crate::error::{check_bound, check_finite};
use crate::exponent_range::{check_exponent, largest_logarithm, small_exponent};
use piola_numerics::internal::excess_of_exponential;

/// The largest number of terms.
const CAPACITY: usize = 8;

/// One term μ/α (λ₁^α + λ₂^α + λ₃^α − 3) of an Ogden solid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct OgdenTerm {
    /// μ, Pa.
    #[doc(alias = "mu")]
    #[cfg_attr(feature = "serde", serde(alias = "mu"))]
    pub modulus: f64,
    /// α, not zero.
    #[doc(alias = "alpha")]
    #[cfg_attr(feature = "serde", serde(alias = "alpha"))]
    pub exponent: f64,
}

/// The sum of an expression over the terms. A macro and not a function of a closure, which cannot be forced inline.
macro_rules! sum_of {
    ($series:expr, |$mu:ident, $alpha:ident| $term:expr) => {{
        let mut sum = T::zero();
        for &OgdenTerm { modulus: $mu, exponent: $alpha } in $series.terms() {
            sum += $term;
        }
        sum
    }};
}

/// Σ μ/α (e^(α x) − 1 − α x), of terms in place so that laws are `Copy`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Series {
    terms: [OgdenTerm; CAPACITY],
    count: usize,
}

impl Series {
    pub(super) fn new(law: &'static str, given: &[OgdenTerm]) -> Result<Self, SolidsError> {
        let count = given.len();
        check_bound(law, "terms", count as f64, "1 ≤ number of terms ≤ 8", (1..=CAPACITY).contains(&count))?;
        for term in given {
            check_finite(law, "modulus", term.modulus)?;
            check_bound(law, "exponent", term.exponent, "α ≠ 0", 0.0 < term.exponent.abs())?;
        }
        let mut terms = [OgdenTerm::default(); CAPACITY];
        terms[..count].copy_from_slice(given);
        let series = Self { terms, count };
        let modulus = series.shear_modulus();
        check_bound(law, "½ Σ μ α", modulus, "0 < ½ Σ μ α", 0.0 < modulus)?;
        Ok(series)
    }

    pub(super) fn terms(&self) -> &[OgdenTerm] {
        &self.terms[..self.count]
    }

    pub(super) fn shear_modulus(&self) -> f64 {
        0.5 * self.terms().iter().map(|term| term.modulus * term.exponent).sum::<f64>()
    }

    /// Σ μₚ, Pa.
    pub(super) fn moduli(&self) -> f64 {
        self.terms().iter().map(|term| term.modulus).sum()
    }

    /// Refuses stretches whose powers leave the range of the scalar.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn check<T: Real>(
        &self,
        law: &'static str,
        deformation: &impl Deformation<T>,
        isochoric: bool,
    ) -> Result<(), SolidsError> {
        let (mut steepest, mut stiffest) = (0.0_f64, 0.0_f64);
        for OgdenTerm { modulus: mu, exponent: alpha } in self.terms() {
            steepest = steepest.max(alpha.abs());
            stiffest = stiffest.max((mu * alpha).abs());
        }
        // λ₁ ≤ |F| and 1/λ₃ ≤ |F⁻¹|; the isochoric stretches are between λ₃/λ₁ and λ₁/λ₃.
        let (f, inverse) = (deformation.gradient_rows(), deformation.inverse_rows());
        let (longest, shortest) = (double_contraction(f, f), double_contraction(inverse, inverse));
        let range = if isochoric { longest * shortest } else { longest.max(shortest) };
        // Tangents are put together with squares of the parts: half the exponent is left.
        // A power of two below e^(that/steepest): a call of a function within a loop over lanes is dear.
        let reach = power_of_two_below_exp((small_exponent::<T>() / steepest).min(80.0));
        let modest = if largest_logarithm::<T>() < 100.0 { 1e10 } else { 1e100 };
        if range.less_than(T::lit(reach)).all() && stiffest < modest {
            return Ok(());
        }
        self.check_closely(law, deformation, isochoric, T::lit(8.0 * stiffest) * (T::one() + shortest))
    }

    #[cold]
    #[inline(never)]
    fn check_closely<T: Real>(
        &self,
        law: &'static str,
        deformation: &impl Deformation<T>,
        isochoric: bool,
        factor: T,
    ) -> Result<(), SolidsError> {
        let logarithms = StretchAnalysis::of(deformation).log_principal_stretches();
        let mean = if isochoric { deformation.ln_jacobian() * T::lit(1.0 / 3.0) } else { T::zero() };
        let mut exponent = T::zero();
        for OgdenTerm { exponent: alpha, .. } in self.terms() {
            for logarithm in logarithms {
                exponent = exponent.max(T::lit(*alpha) * (logarithm - mean));
            }
        }
        let two = T::lit(2.0);
        check_exponent(law, "2 α ln λ", two * exponent, factor * factor)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn part<T: Real>(&self, x: T) -> T {
        sum_of!(self, |mu, alpha| ogden_term(T::lit(mu), T::lit(alpha), x))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn slope<T: Real>(&self, x: T) -> T {
        sum_of!(self, |mu, alpha| T::lit(mu) * (T::lit(alpha) * x).exp_m1())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn curvature<T: Real>(&self, x: T) -> T {
        sum_of!(self, |mu, alpha| T::lit(mu * alpha) * (T::lit(alpha) * x).exp())
    }

    /// Σ μ α.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn curvature_at_rest<T: Real>(&self) -> T {
        sum_of!(self, |mu, alpha| T::lit(mu * alpha))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn secant<T: Real>(&self, x: T, y: T) -> T {
        sum_of!(self, |mu, alpha| {
            let order = T::lit(alpha);
            T::lit(mu * alpha) * Exponential.divided_difference(order * x, order * y)
        })
    }
}

/// 2^⌊x/ln 2⌋ ≤ eˣ, for 0 ≤ x ≤ 80.
#[cfg_attr(not(debug_assertions), inline(always))]
fn power_of_two_below_exp(x: f64) -> f64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ x/ln 2 < 116")]
    let exponent = (x * core::f64::consts::LOG2_E) as u64;
    f64::from_bits((1023 + exponent) << 52)
}

/// μ/α (e^(α x) − 1 − α x), over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn ogden_term<T: Real>(mu: T, alpha: T, x: T) -> T {
    mu / alpha * excess_of_exponential(alpha * x)
}

/// w and its derivatives are those of the series.
macro_rules! parts_of_series {
    () => {
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn part<T: Real>(&self, x: T) -> T {
            self.series.part(x)
        }
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn slope<T: Real>(&self, x: T) -> T {
            self.series.slope(x)
        }
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn curvature<T: Real>(&self, x: T) -> T {
            self.series.curvature(x)
        }
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn curvature_at_rest<T: Real>(&self) -> T {
            self.series.curvature_at_rest()
        }
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn secant<T: Real>(&self, x: T, y: T) -> T {
            self.series.secant(x, y)
        }
    };
}
pub(super) use parts_of_series;
