//! Limits of extensibility.

use piola_numerics::Real;
use piola_solids::SolidsError;

/// `value` where `x` is below its limit, NaN beyond, with every derivative that the scalar carries.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn within<T: Real>(x: T, limit: T, value: T) -> T {
    value * T::select(x.less_than(limit), T::one(), T::lit(f64::NAN))
}

/// Refuses a value that reaches its limit.
pub(super) fn check_below(
    law: &'static str,
    quantity: &'static str,
    value: f64,
    limit: f64,
) -> Result<(), SolidsError> {
    if value < limit { Ok(()) } else { Err(SolidsError::BeyondLimit { law, quantity, value, limit }) }
}
