//! Exponentials that stay within the range of numbers of the scalar.

use piola_numerics::{Mask, Real};

use crate::ConstitutiveError;

/// Shares of the range that exponent and factor may have without a closer look.
const SHARE: f64 = 0.42;

/// ln of the largest number of the scalar: 709 in double precision, 88 in single.
#[inline(always)]
pub(super) fn largest_logarithm<T: Real>() -> f64 {
    if T::lit(f64::MAX).is_finite().all() { 709.0 } else { 88.0 }
}

/// The exponent that is admitted without a closer look.
#[inline(always)]
pub(super) fn small_exponent<T: Real>() -> f64 {
    SHARE * largest_logarithm::<T>()
}

/// Refuses `factor` · e^`exponent` beyond the range of the scalar.
///
/// The factor is a bound of all that multiplies the exponential in the tangent.
#[inline(always)]
pub(super) fn check_exponent<T: Real>(
    law: &'static str,
    quantity: &'static str,
    exponent: T,
    factor: T,
) -> Result<(), ConstitutiveError> {
    let (most, great) = if largest_logarithm::<T>() < 100.0 { (36.0, 1e16) } else { (297.0, 1e129) };
    if (exponent.less_than(T::lit(most)) & factor.less_than(T::lit(great))).all() {
        return Ok(());
    }
    closely(law, quantity, exponent, factor)
}

#[cold]
#[inline(never)]
fn closely<T: Real>(
    law: &'static str,
    quantity: &'static str,
    exponent: T,
    factor: T,
) -> Result<(), ConstitutiveError> {
    for lane in 0..T::LANES {
        let (value, factor) = (exponent.primal(lane), factor.primal(lane));
        let limit = largest_logarithm::<T>() - factor.max(1.0).ln();
        let holds = value < limit;
        if !holds {
            return Err(ConstitutiveError::BeyondLimit { law, quantity, value, limit });
        }
    }
    Ok(())
}
