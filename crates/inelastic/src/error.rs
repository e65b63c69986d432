//! Violated conditions of laws with internal variables: each variant names one.

use piola_continuum::ContinuumError;
use piola_solids::SolidsError;

/// A violated condition of a law with internal variables or of an update of its state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InelasticError {
    /// A number is infinite or NaN.
    #[error("{quantity}[{index}] = {value} is not finite")]
    NotFinite {
        /// What the number is of.
        quantity: &'static str,
        /// Its place, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An array has the wrong length.
    #[error("{quantity} has {found} entries, and {expected} are needed")]
    WrongLength {
        /// What the array holds.
        quantity: &'static str,
        /// The length needed.
        expected: usize,
        /// Its length.
        found: usize,
    },
    /// A parameter is outside its bounds.
    #[error("{law}: {parameter} = {value:e} violates {bound}")]
    OutOfBounds {
        /// The law, or what else has the parameter.
        law: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The bound, such as `0 < η`.
        bound: &'static str,
    },
    /// A part of a law is an elastic law that cannot be that part.
    #[error("{law}: the law of `{part}` is {found}; {needed} is needed")]
    WrongSpring {
        /// The law.
        law: &'static str,
        /// The part.
        part: &'static str,
        /// What its law is.
        found: &'static str,
        /// What it should be.
        needed: &'static str,
    },
    /// No state was found at the end of an increment.
    #[error(
        "the update did not converge beyond the share {share} of the increment, at F = {gradient:?}: after {iterations} \
         iterations its residual is {residual:e}"
    )]
    NotConverged {
        /// The share of the increment at the end of which the last admissible state lies.
        share: f64,
        /// F of the last admissible state, by rows.
        gradient: [[f64; 3]; 3],
        /// The residual of the update that failed.
        residual: f64,
        /// Iterations of the update that failed.
        iterations: usize,
    },
    /// The error of the update stays above the tolerance.
    #[error(
        "the estimated error {error:e} of the update is above the tolerance {tolerance:e} beyond the share {share} of the \
         increment, at F = {gradient:?}"
    )]
    NotAccurate {
        /// The share of the increment at the end of which the last admissible state lies.
        share: f64,
        /// F of the last admissible state, by rows.
        gradient: [[f64; 3]; 3],
        /// The estimated error.
        error: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// A point of several failed; the states of all others are advanced.
    #[error("at point {index}, {error}")]
    AtPoint {
        /// The first such point, from 0.
        index: usize,
        /// Its error.
        error: Box<InelasticError>,
    },
    /// The deformation is refused.
    #[error(transparent)]
    Continuum(#[from] ContinuumError),
    /// An elastic law of the solid refuses.
    #[error(transparent)]
    Solids(#[from] SolidsError),
}

/// Refuses numbers that are not finite.
pub(crate) fn check_finite(quantity: &'static str, values: &[f64]) -> Result<(), InelasticError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(InelasticError::NotFinite { quantity, index, value: values[index] }),
        None => Ok(()),
    }
}

/// Refuses a parameter that is not finite or for which `holds` is false.
pub(crate) fn check_bound(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), InelasticError> {
    check_finite(parameter, &[value])?;
    if holds { Ok(()) } else { Err(InelasticError::OutOfBounds { law, parameter, value, bound }) }
}
