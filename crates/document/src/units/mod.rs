//! Quantities as people write them: `"9.81 m/s^2"`, `"3650 d"`, `"[1, 0, 0] au"`.
//!
//! A [`Unit`] is a factor to SI and a [`Dimension`]; a [`Quantity`] is a number with a unit. Angle is kept as a
//! dimension of its own, so that an angular rate given in `1/s` is seen as the mistake that it often is.
//!
//! ```text
//! quantity  =  number [ unit ]          vector  =  "[" number "," number "," number "]" [ unit ]
//! unit      =  factor { ( " " | "*" | "·" | "/" ) factor }
//! factor    =  ( name | "1" | "(" unit ")" ) [ "^" integer | "²" | "³" … ]
//! ```
//! A division takes the next factor only, and a product without a sign after it is refused as ambiguous:
//! `J/kg K` is `J/(kg K)` to one reader and `J K/kg` to another.
//!
//! # Accuracy
//! The factor is kept as a quotient of two doubles, so a value is converted with two roundings and without any when
//! both are exact: `36 km/h` is exactly 10 m/s.

mod dimension;
mod names;
pub(crate) mod quantity;
mod spelling;
mod unit;

pub use dimension::Dimension;
pub use names::{NamedUnit, UNITS};
pub use quantity::{Quantity, VectorQuantity};
pub use spelling::spelled;
pub use unit::Unit;

/// Why a text is not a quantity.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UnitError {
    /// The text does not begin with a number.
    #[error("`{found}` does not begin with a number")]
    NoNumber {
        /// The whole text.
        found: String,
    },
    /// The number is infinite or not a number.
    #[error("{number} is not finite")]
    NotFinite {
        /// The offending value.
        number: f64,
    },
    /// No unit has this name.
    #[error("`{name}` is not a unit{}", nearest.map(|n| format!(", did you mean `{n}`?")).unwrap_or_default())]
    UnknownUnit {
        /// The name as written.
        name: String,
        /// The known name that is closest to it, when one is close.
        nearest: Option<&'static str>,
    },
    /// A product follows a division without a sign between.
    #[error("`{found}` can be read in two ways: put the divisor in brackets, as in `J/(kg m)`")]
    AmbiguousDivision {
        /// The unit as written.
        found: String,
    },
    /// An exponent that is not a whole number between −99 and 99.
    #[error("the exponent `{found}` is not a whole number between -99 and 99")]
    BadExponent {
        /// The exponent as written.
        found: String,
    },
    /// Powers of powers that lead beyond an exponent of 99.
    #[error("`{found}` has a dimension with an exponent beyond 99")]
    DimensionTooLarge {
        /// The unit as written.
        found: String,
    },
    /// A bracket that is not closed, or closed twice.
    #[error("brackets do not match in `{found}`")]
    UnmatchedBracket {
        /// The text as written.
        found: String,
    },
    /// Something that no unit contains.
    #[error("`{found}` cannot stand in a unit")]
    UnexpectedText {
        /// The rest of the text from the offending character.
        found: String,
    },
    /// A vector with another number of components than expected.
    #[error("the number of components is {found}; it must be {expected}")]
    WrongLength {
        /// How many were given.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// Conversion of the value leaves the range of doubles.
    #[error("{number} {unit} is outside the range of double precision in SI units")]
    OutOfRange {
        /// The number as written.
        number: f64,
        /// The unit as written.
        unit: String,
    },
}
