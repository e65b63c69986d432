//! Numbers and vectors with a unit.

use core::str::FromStr;

use super::{Unit, UnitError};

/// A number with a unit.
///
/// # Example
/// ```
/// use piola_document::units::{Dimension, Quantity};
/// let day: Quantity = "1.5 d".parse()?;
/// assert_eq!(day.dimension(), Some(Dimension::TIME));
/// assert_eq!(day.to_si()?, 129_600.0);
/// // Without a unit, the dimension is left to the reader's context.
/// assert_eq!("2".parse::<Quantity>()?.dimension(), None);
/// # Ok::<(), piola_document::units::UnitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// The number as written.
    pub number: f64,
    /// The unit, when one is written, with its text.
    pub unit: Option<(Unit, String)>,
}

impl Quantity {
    /// The dimension of the unit; `None` without a unit.
    #[must_use]
    pub fn dimension(&self) -> Option<super::Dimension> {
        self.unit.as_ref().map(|(unit, _)| unit.dimension)
    }

    /// The value in SI units.
    ///
    /// # Errors
    /// [`UnitError::OutOfRange`] when the conversion overflows.
    pub fn to_si(&self) -> Result<f64, UnitError> {
        convert(self.number, self.unit.as_ref())
    }
}

impl FromStr for Quantity {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        let text = text.trim();
        let (number, rest) = leading_number(text)?;
        Ok(Self { number, unit: unit(rest)? })
    }
}

/// Numbers that share a unit: `"[1, 0, 0] au"`.
///
/// # Example
/// ```
/// use piola_document::units::VectorQuantity;
/// let position: VectorQuantity = "[1, -0.5, 2e3] km".parse()?;
/// assert_eq!(position.to_si()?, [1e3, -500.0, 2e6]);
/// # Ok::<(), piola_document::units::UnitError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct VectorQuantity {
    /// The numbers as written.
    pub numbers: Vec<f64>,
    /// The unit, when one is written, with its text.
    pub unit: Option<(Unit, String)>,
}

impl VectorQuantity {
    /// The values in SI units.
    ///
    /// # Errors
    /// [`UnitError::OutOfRange`] when a conversion overflows.
    pub fn to_si(&self) -> Result<Vec<f64>, UnitError> {
        self.numbers.iter().map(|&number| convert(number, self.unit.as_ref())).collect()
    }
}

impl FromStr for VectorQuantity {
    type Err = UnitError;

    fn from_str(text: &str) -> Result<Self, UnitError> {
        let text = text.trim();
        let inner = text.strip_prefix('[').ok_or_else(|| UnitError::NoNumber { found: shortened(text) })?;
        let (inside, rest) =
            inner.split_once(']').ok_or_else(|| UnitError::UnmatchedBracket { found: shortened(text) })?;
        let numbers = inside.trim().trim_end_matches(',').split(',').map(|component| {
            let (number, rest) = leading_number(component.trim())?;
            if rest.is_empty() { Ok(number) } else { Err(UnitError::UnexpectedText { found: shortened(rest) }) }
        });
        Ok(Self { numbers: numbers.collect::<Result<_, _>>()?, unit: unit(rest)? })
    }
}

fn unit(text: &str) -> Result<Option<(Unit, String)>, UnitError> {
    let text = text.trim();
    if text.is_empty() { Ok(None) } else { Ok(Some((text.parse()?, text.to_string()))) }
}

pub(crate) fn convert(number: f64, unit: Option<&(Unit, String)>) -> Result<f64, UnitError> {
    let Some((unit, text)) = unit else { return Ok(number) };
    let value = unit.to_si(number);
    // A product that vanishes or overflows although the number does not has left the range of doubles.
    let lost = !value.is_finite() || (value == 0.0) != (number == 0.0);
    if lost { Err(UnitError::OutOfRange { number, unit: text.clone() }) } else { Ok(value) }
}

/// The longest prefix that is a number, and what follows it.
fn leading_number(text: &str) -> Result<(f64, &str), UnitError> {
    let no_number = || UnitError::NoNumber { found: shortened(text) };
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(|b| b.is_ascii_digit() || *b == b'_') {
            at += 1;
        }
        at
    };
    let mut end = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    for special in ["inf", "nan", "NaN"] {
        if text[end..].starts_with(special) {
            let number = if special == "inf" { f64::INFINITY } else { f64::NAN };
            return Err(UnitError::NotFinite { number: if text.starts_with('-') { -number } else { number } });
        }
    }
    end = digits(end);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        // `3 eV` would not have digits here: then the letter belongs to a unit.
        if end + 1 + sign < exponent {
            end = exponent;
        }
    }
    let number: f64 = text[..end].replace('_', "").parse().map_err(|_| no_number())?;
    if number.is_finite() { Ok((number, &text[end..])) } else { Err(UnitError::NotFinite { number }) }
}

fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 {
        text.to_string()
    } else {
        let mut short: String = text.chars().take(40).collect();
        short.push('…');
        short
    }
}
