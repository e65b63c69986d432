//! Checks of parameters, by the errors of `piola-solids`: a law of one's own refuses as a built-in one does.

use crate::SolidsError;

/// Refuses a parameter that is not finite.
pub(crate) fn check_finite(law: &'static str, parameter: &'static str, value: f64) -> Result<(), SolidsError> {
    if value.is_finite() { Ok(()) } else { Err(SolidsError::NotFinite { law, parameter, value }) }
}

/// Refuses a parameter that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), SolidsError> {
    check_finite(law, parameter, value)?;
    if holds { Ok(()) } else { Err(SolidsError::OutOfBounds { law, parameter, value, bound }) }
}
