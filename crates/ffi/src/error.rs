//! What the interface refuses: each variant names one condition.

use piola::fit::FitError;
use piola::fluids::FluidsError;
#[cfg(feature = "history")]
use piola::inelastic::InelasticError;
use piola::solids::SolidsError;
use piola::viscometry::ViscometryError;

/// A violated condition of the interface, or an error of a crate below.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FfiError {
    /// A pointer that must lead somewhere is null.
    #[error("`{argument}` is a null pointer")]
    NullPointer {
        /// The argument.
        argument: &'static str,
    },
    /// A pointer does not lead to the boundary of a number.
    #[error("`{argument}` does not lead to the boundary of a number")]
    Misaligned {
        /// The argument.
        argument: &'static str,
    },
    /// An output lies in memory of another array.
    #[error("`{output}` overlaps `{other}`; they must be different memory")]
    Overlap {
        /// The output.
        output: &'static str,
        /// The other array.
        other: &'static str,
    },
    /// A text has bytes that are no UTF-8.
    #[error("`{argument}` is not UTF-8: byte {index} is wrong")]
    NotText {
        /// The argument.
        argument: &'static str,
        /// The first wrong byte, from 0.
        index: usize,
    },
    /// A choice has a number or a name that it does not have.
    #[error("`{given}` is no {choice}; there are {valid}")]
    UnknownChoice {
        /// The choice, such as `stress`.
        choice: &'static str,
        /// The name or number that was given.
        given: String,
        /// What can be chosen.
        valid: String,
    },
    /// A law has another number of parameters.
    #[error("law `{law}` takes {expected}; {found} numbers were given")]
    WrongCount {
        /// The law as it was named.
        law: String,
        /// The parameters, in their order.
        expected: String,
        /// How many numbers were given.
        found: usize,
    },
    /// A law has no such parameter, or it was given twice, or not at all.
    #[error("law `{law}`: parameter `{parameter}` {what}; the parameters are {valid}")]
    WrongParameter {
        /// The law as it was named.
        law: String,
        /// The parameter.
        parameter: String,
        /// Whether it is unknown, missing or given twice.
        what: &'static str,
        /// The parameters, in their order.
        valid: String,
    },
    /// A number is infinite or NaN.
    #[error("`{quantity}`, entry {index}: {value} is not finite")]
    NotFinite {
        /// The argument.
        quantity: &'static str,
        /// Which number, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An array has another length than the arrays beside it.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The argument.
        quantity: &'static str,
        /// The length it must have.
        expected: usize,
        /// The length it has.
        found: usize,
    },
    /// A text describes no law.
    #[error("the {what} cannot be read: {message}")]
    Unreadable {
        /// What the text should describe.
        what: &'static str,
        /// The message of the parser, with line and column.
        message: String,
    },
    /// The file of a material cannot be read.
    #[error(
        "material `{name}` is neither a law nor a file: `{path}`: {message}. Files of materials are searched for in the \
         folder that the environment variable PIOLA_MATERIALS names, or else in the working folder. \
         Laws with history need a library built with its feature `history`"
    )]
    NoMaterial {
        /// The name of the material.
        name: String,
        /// The file that was tried.
        path: String,
        /// What the operating system says.
        message: String,
    },
    /// The components of stress are not those of a solid element.
    #[error(
        "{direct} direct and {shear} shear components: 3 and 3 (solid elements) and 3 and 1 (plane strain, \
         axisymmetric) can be computed"
    )]
    Components {
        /// The number of direct components.
        direct: usize,
        /// The number of shear components.
        shear: usize,
    },
    /// Points of a batch are bad; the outputs of all others are computed.
    #[error("{bad} of {count} points failed: at point {index}, {error}")]
    BadPoints {
        /// How many points failed.
        bad: usize,
        /// The number of points.
        count: usize,
        /// The first bad point, from 0.
        index: usize,
        /// The message of the law for that point.
        error: SolidsError,
    },
    /// Increments of points of a batch failed; all other points are advanced.
    #[cfg(feature = "history")]
    #[error("{bad} of {count} points failed: at point {index}, {error}")]
    BadIncrements {
        /// How many points failed.
        bad: usize,
        /// The number of points.
        count: usize,
        /// The first point that failed, from 0.
        index: usize,
        /// The message of the law for that point, with the last admissible deformation.
        error: Box<InelasticError>,
    },
    /// A law with history refuses.
    #[cfg(feature = "history")]
    #[error(transparent)]
    Inelastic(#[from] InelasticError),
    /// A law of a solid refuses.
    #[error(transparent)]
    Solids(#[from] SolidsError),
    /// A law of a fluid refuses.
    #[error(transparent)]
    Fluids(#[from] FluidsError),
    /// A flow refuses.
    #[error(transparent)]
    Viscometry(#[from] ViscometryError),
    /// A fit refuses.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A fault of this library, caught at its border.
    #[error("a fault of Piola, please report it: {message}")]
    Fault {
        /// The message of the panic.
        message: String,
    },
}

/// Refuses numbers that are infinite or NaN.
pub(crate) fn check_finite(quantity: &'static str, numbers: &[f64]) -> Result<(), FfiError> {
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(index) => Err(FfiError::NotFinite { quantity, index, value: numbers[index] }),
        None => Ok(()),
    }
}

/// Refuses an array of another length.
pub(crate) fn check_length(quantity: &'static str, expected: usize, found: usize) -> Result<(), FfiError> {
    if found == expected { Ok(()) } else { Err(FfiError::WrongLength { quantity, expected, found }) }
}

/// Points that failed: how many, and the first of them with its error.
pub(crate) struct Bad<E> {
    pub(crate) count: usize,
    pub(crate) first: Option<(usize, E)>,
}

impl<E> Default for Bad<E> {
    fn default() -> Self {
        Self { count: 0, first: None }
    }
}

impl<E> Bad<E> {
    /// Notes a point; points are noted in order.
    pub(crate) fn note(&mut self, index: usize, error: E) {
        self.count += 1;
        self.first.get_or_insert((index, error));
    }

    /// With those of later points.
    #[cfg(feature = "rayon")]
    pub(crate) fn and(self, later: Self) -> Self {
        Self { count: self.count + later.count, first: self.first.or(later.first) }
    }

    /// If points have failed, the error says how many of them, which was the first, and why it failed.
    pub(crate) fn finish(self, error: impl FnOnce(usize, usize, E) -> FfiError) -> Result<(), FfiError> {
        let Self { count, first } = self;
        first.map_or(Ok(()), |(index, reason)| Err(error(count, index, reason)))
    }
}

/// Points that failed in the blocks of a batch: how many, and the error of the first block that has one.
#[derive(Default)]
pub(crate) struct Failures {
    bad: usize,
    first: Option<FfiError>,
}

impl Failures {
    /// Notes the result of a block that begins with point `start`.
    ///
    /// # Errors
    /// Those of the block, unless some points failed.
    pub(crate) fn note(&mut self, start: usize, result: Result<(), FfiError>) -> Result<(), FfiError> {
        let Err(mut error) = result else { return Ok(()) };
        match &mut error {
            FfiError::BadPoints { bad, index, .. } => {
                self.bad += *bad;
                *index += start;
            }
            #[cfg(feature = "history")]
            FfiError::BadIncrements { bad, index, .. } => {
                self.bad += *bad;
                *index += start;
            }
            _ => return Err(error),
        }
        self.first.get_or_insert(error);
        Ok(())
    }

    /// The error of the first block, with the numbers of all.
    pub(crate) fn finish(self, points: usize) -> Result<(), FfiError> {
        let Some(mut error) = self.first else { return Ok(()) };
        match &mut error {
            FfiError::BadPoints { bad, count, .. } => (*bad, *count) = (self.bad, points),
            #[cfg(feature = "history")]
            FfiError::BadIncrements { bad, count, .. } => (*bad, *count) = (self.bad, points),
            _ => {}
        }
        Err(error)
    }
}
