//! Exponentials that stay within the range of numbers of the scalar.

use piola_numerics::{Mask, Real};

use crate::SolidsError;

/// Shares of the range that exponent and factor may have without a closer look.
const SHARE: f64 = 0.42;

/// ln of the largest number of the scalar: 709 in double precision, 88 in single.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn largest_logarithm<T: Real>() -> f64 {
    if T::lit(f64::MAX).is_finite().all() { 709.0 } else { 88.0 }
}

/// The exponent that is admitted without a closer look.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn small_exponent<T: Real>() -> f64 {
    SHARE * largest_logarithm::<T>()
}

/// Refuses `factor` · e^`exponent` beyond the range of the scalar.
///
/// The factor is a bound of all that multiplies the exponential in the tangent.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn check_exponent<T: Real>(
    law: &'static str,
    quantity: &'static str,
    exponent: T,
    factor: T,
) -> Result<(), SolidsError> {
    if are_small(exponent, factor) {
        return Ok(());
    }
    closely(law, quantity, exponent, |lane| largest_logarithm::<T>() - factor.primal(lane).max(1.0).ln())
}

/// As [`check_exponent`], where `factor` · e^`exponent` itself tells: for laws that compute it.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn check_range<T: Real>(
    law: &'static str,
    quantity: &'static str,
    exponent: T,
    factor: T,
) -> Result<(), SolidsError> {
    if are_small(exponent, factor) || (factor * exponent.exp()).is_finite().all() {
        return Ok(());
    }
    beyond(law, quantity, exponent, factor)
}

/// Names the lane beyond the range.
#[cold]
#[inline(never)]
fn beyond<T: Real>(law: &'static str, quantity: &'static str, exponent: T, factor: T) -> Result<(), SolidsError> {
    let reach = factor * exponent.exp();
    for lane in 0..T::LANES {
        if !reach.primal(lane).is_finite() {
            let limit = largest_logarithm::<T>() - factor.primal(lane).max(1.0).ln();
            return Err(SolidsError::BeyondLimit { law, quantity, value: exponent.primal(lane), limit });
        }
    }
    Ok(())
}

/// True if both are clearly within the range.
#[cfg_attr(not(debug_assertions), inline(always))]
fn are_small<T: Real>(exponent: T, factor: T) -> bool {
    let (most, great) = if largest_logarithm::<T>() < 100.0 { (36.0, 1e16) } else { (297.0, 1e129) };
    (exponent.less_than(T::lit(most)) & factor.less_than(T::lit(great))).all()
}

/// The exponent below which 0 < `factor` · e^exponent is within the range of the scalar: the binary exponent of the factor
/// and one more bound its logarithm.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn largest_exponent<T: Real>(factor: f64) -> f64 {
    let binary = (factor.to_bits() >> 52).saturating_sub(1022);
    largest_logarithm::<T>() - core::f64::consts::LN_2 * f64::from(u32::try_from(binary).unwrap_or(u32::MAX))
}

/// Refuses an exponent that reaches the limit.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn check_below<T: Real>(
    law: &'static str,
    quantity: &'static str,
    exponent: T,
    limit: f64,
) -> Result<(), SolidsError> {
    // As the scalar rounds it.
    let limit = T::lit(limit);
    if exponent.less_than(limit).all() { Ok(()) } else { closely(law, quantity, exponent, |lane| limit.primal(lane)) }
}

/// `value` where `x` is below its limit, NaN beyond.
///
/// A product, so that every derivative that the scalar carries is NaN too: those of a constant NaN would be zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn within<T: Real>(x: T, limit: T, value: T) -> T {
    value * T::select(x.less_than(limit), T::one(), T::lit(f64::NAN))
}

#[cold]
#[inline(never)]
fn closely<T: Real>(
    law: &'static str,
    quantity: &'static str,
    exponent: T,
    limit: impl Fn(usize) -> f64,
) -> Result<(), SolidsError> {
    for lane in 0..T::LANES {
        let (value, limit) = (exponent.primal(lane), limit(lane));
        let holds = value < limit;
        if !holds {
            return Err(SolidsError::BeyondLimit { law, quantity, value, limit });
        }
    }
    Ok(())
}
