//! What can be wrong with a flow or with what is asked of it: each variant names the violated condition.

use piola_constitutive::ConstitutiveError;

/// A violated condition of viscometry.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViscometryError {
    /// A number is infinite or NaN.
    #[error("{flow}: {quantity} = {value} is not finite")]
    NotFinite {
        /// The flow.
        flow: &'static str,
        /// What the number is.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number is outside its bounds.
    #[error("{flow}: {quantity} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The flow.
        flow: &'static str,
        /// What the number is.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// What would be valid, such as `0 < R`.
        bound: &'static str,
    },
    /// The fluid itself refuses: no shear rate at a stress, a parameter outside its bounds.
    #[error(transparent)]
    Fluid(#[from] ConstitutiveError),
}

/// Refuses a number that is not finite.
pub(crate) fn check_finite(flow: &'static str, quantity: &'static str, value: f64) -> Result<(), ViscometryError> {
    if value.is_finite() { Ok(()) } else { Err(ViscometryError::NotFinite { flow, quantity, value }) }
}

/// Refuses a number that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    flow: &'static str,
    quantity: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), ViscometryError> {
    check_finite(flow, quantity, value)?;
    if holds { Ok(()) } else { Err(ViscometryError::OutOfBounds { flow, quantity, value, bound }) }
}
