//! Violated conditions of spectra and of data for them.

/// A violated condition of a spectrum, or of the data that one is fitted to.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpectraError {
    /// A number is infinite or NaN.
    #[error("`{quantity}`, entry {index}: {value} is not finite")]
    NotFinite {
        /// The quantity.
        quantity: &'static str,
        /// The entry, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A list does not have the length of another one.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The quantity.
        quantity: &'static str,
        /// The number of entries it must have.
        expected: usize,
        /// The number of entries it has.
        found: usize,
    },
    /// A number is outside its bounds.
    #[error("`{quantity}`, entry {index}: {value:e} violates {bound}")]
    OutOfBounds {
        /// The quantity.
        quantity: &'static str,
        /// The entry, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// The condition, such as `0 < τ`.
        bound: &'static str,
    },
    /// There are fewer numbers than a spectrum of so many modes needs.
    #[error("a spectrum with number of modes = {modes} needs at least {needed} measured numbers; found {found}")]
    TooFewNumbers {
        /// The number of modes.
        modes: usize,
        /// The least count of numbers.
        needed: usize,
        /// The count of numbers given.
        found: usize,
    },
    /// No search ended at finite residuals.
    #[error("no spectrum of {modes} modes was found: the residuals are not finite")]
    NoFit {
        /// The number of modes.
        modes: usize,
    },
    /// Two neighbouring curves share too few moduli to be laid over each other.
    #[error("curves {first} and {second} have too few moduli in common to be shifted over each other")]
    NoOverlap {
        /// The first curve, from 0.
        first: usize,
        /// The second curve.
        second: usize,
    },
    /// Two neighbouring curves are straight lines of one slope where they overlap.
    #[error(
        "curves {first} and {second} are straight lines in logarithms: they slide along themselves, and no vertical shift is known"
    )]
    StraightCurves {
        /// The first curve, from 0.
        first: usize,
        /// The second curve.
        second: usize,
    },
    /// No law of temperature was found.
    #[error("{law}: no positive constants were found for the shifts")]
    NoShift {
        /// The law.
        law: &'static str,
    },
    /// A law of a fluid refuses the modes.
    #[error(transparent)]
    Fluids(#[from] piola_fluids::FluidsError),
}

/// Refuses a number that is not finite or for which `holds` is false.
pub(crate) fn check(
    quantity: &'static str,
    index: usize,
    value: f64,
    bound: &'static str,
    holds: bool,
) -> Result<(), SpectraError> {
    if !value.is_finite() {
        return Err(SpectraError::NotFinite { quantity, index, value });
    }
    if holds { Ok(()) } else { Err(SpectraError::OutOfBounds { quantity, index, value, bound }) }
}
