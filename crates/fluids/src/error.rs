//! Violated conditions of laws of fluids: each variant names one.

/// A violated condition of a law of a fluid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FluidsError {
    /// A parameter is infinite or NaN.
    #[error("{law}: {parameter} = {value} is not finite")]
    NotFinite {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter is outside its bounds.
    #[error("{law}: {parameter} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The law.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The condition, such as `0 < μ`.
        bound: &'static str,
    },
    /// The motion is beyond what the law can answer.
    #[error("{law}: {quantity} = {value:e} is not below its limit {limit:e}")]
    BeyondLimit {
        /// The law.
        law: &'static str,
        /// The limited quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its limit.
        limit: f64,
    },
    /// No shear rate has this shear stress.
    #[error("{fluid}: no shear rate was found at the shear stress {stress:e} Pa (residual {residual:e} Pa)")]
    NoShearRate {
        /// The fluid.
        fluid: &'static str,
        /// The shear stress, Pa.
        stress: f64,
        /// The difference of the stress at the best rate, Pa.
        residual: f64,
    },
    /// Entries of a batch of shear rates or stresses have no answer; theirs are NaN, all others are computed.
    #[error("{fluid}: no answer at {count} of the entries; the first is entry {index}, {value}")]
    BadEntries {
        /// The fluid.
        fluid: &'static str,
        /// The first such entry, from 0.
        index: usize,
        /// Its value, 1/s or Pa.
        value: f64,
        /// The number of such entries.
        count: usize,
    },
    /// A batch has not one answer for each entry.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The name of the argument.
        quantity: &'static str,
        /// The number of entries it must have.
        expected: usize,
        /// The number of entries it has.
        found: usize,
    },
    /// A motion could not be followed.
    #[cfg(feature = "motions")]
    #[error("the motion could not be followed: {0}")]
    Integration(#[from] piola_integrators::IntegratorsError),
    /// The deformation or its rate is refused.
    #[cfg(feature = "motions")]
    #[error(transparent)]
    Continuum(#[from] piola_continuum::ContinuumError),
    /// A field is refused.
    #[cfg(feature = "fields")]
    #[error(transparent)]
    Fields(#[from] piola_fields::FieldsError),
}

/// Refuses a parameter that is not finite.
pub(crate) fn check_finite(law: &'static str, parameter: &'static str, value: f64) -> Result<(), FluidsError> {
    if value.is_finite() { Ok(()) } else { Err(FluidsError::NotFinite { law, parameter, value }) }
}

/// Refuses a parameter that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), FluidsError> {
    check_finite(law, parameter, value)?;
    if holds { Ok(()) } else { Err(FluidsError::OutOfBounds { law, parameter, value, bound }) }
}
