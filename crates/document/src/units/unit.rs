//! Compound units: a parser from text to factor and dimension.

use core::str::FromStr;

use super::{Dimension, UnitError, names};

/// A unit: its factor to SI, as a quotient, and its dimension.
///
/// ```text
/// value in SI = value · numerator / denominator
/// ```
/// # Example
/// ```
/// use piola_document::units::{Dimension, Unit};
/// let unit: Unit = "km/h".parse()?;
/// assert_eq!(unit.dimension, Dimension::SPEED);
/// assert_eq!(unit.to_si(36.0), 10.0);
/// # Ok::<(), piola_document::units::UnitError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Factor above the line.
    pub numerator: f64,
    /// Factor below the line.
    pub denominator: f64,
    /// Dimension.
    pub dimension: Dimension,
}

impl Unit {
    /// The unit of pure numbers.
    pub const ONE: Self = Self { numerator: 1.0, denominator: 1.0, dimension: Dimension::NONE };

    /// A value in this unit, in SI units.
    #[must_use]
    pub fn to_si(self, value: f64) -> f64 {
        value * self.numerator / self.denominator
    }

    /// The product of two units.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self {
            numerator: self.numerator * other.numerator,
            denominator: self.denominator * other.denominator,
            dimension: self.dimension.times(other.dimension),
        }
    }

    /// A whole power of a unit.
    #[must_use]
    pub fn power(self, n: i16) -> Self {
        let (above, below) =
            if n < 0 { (self.denominator, self.numerator) } else { (self.numerator, self.denominator) };
        let exponent = i32::from(n.unsigned_abs());
        Self { numerator: above.powi(exponent), denominator: below.powi(exponent), dimension: self.dimension.power(n) }
    }
}

impl FromStr for Unit {
    type Err = UnitError;

    /// Reads a unit such as `m^3/s^2`, `kg m²` or `N/(m s)`; the empty text is the unit of pure numbers.
    fn from_str(text: &str) -> Result<Self, UnitError> {
        let text = text.trim();
        let mut reader = Reader { whole: text, rest: text, depth: 0 };
        if text.is_empty() {
            return Ok(Self::ONE);
        }
        let unit = reader.product()?;
        if reader.rest.is_empty() { Ok(unit) } else { Err(reader.unmatched()) }
    }
}

/// Brackets deeper than this are refused: no unit has them, and the reader recurses.
const DEEPEST: usize = 8;

/// Of a dimension, without its sign.
const LARGEST_EXPONENT: u16 = 99;

struct Reader<'t> {
    whole: &'t str,
    rest: &'t str,
    depth: usize,
}

impl<'t> Reader<'t> {
    /// Factors until the end or a closing bracket.
    fn product(&mut self) -> Result<Unit, UnitError> {
        let mut unit = self.factor()?;
        let mut divided = false;
        loop {
            let before = self.rest;
            self.rest = before.trim_start();
            let Some(sign) = self.rest.chars().next() else { return Ok(unit) };
            match sign {
                ')' => return Ok(unit),
                '/' => {
                    self.skip(sign);
                    let divisor = self.factor()?.power(-1);
                    unit = self.checked(unit.times(divisor))?;
                    divided = true;
                }
                '*' | '·' | '⋅' => {
                    self.skip(sign);
                    let factor = self.factor()?;
                    unit = self.checked(unit.times(factor))?;
                }
                _ if before.len() == self.rest.len() => return Err(self.unexpected()),
                _ if divided => return Err(UnitError::AmbiguousDivision { found: self.whole.to_string() }),
                _ => {
                    let factor = self.factor()?;
                    unit = self.checked(unit.times(factor))?;
                }
            }
        }
    }

    fn factor(&mut self) -> Result<Unit, UnitError> {
        self.rest = self.rest.trim_start();
        let base = match self.rest.chars().next() {
            Some('(') if self.depth < DEEPEST => {
                self.skip('(');
                self.depth += 1;
                let inner = self.product()?;
                self.depth -= 1;
                if !self.rest.starts_with(')') {
                    return Err(self.unmatched());
                }
                self.skip(')');
                inner
            }
            Some('1') => {
                self.skip('1');
                Unit::ONE
            }
            Some(c) if is_name(c) => {
                let name = self.take(is_name);
                names::find(name)
                    .ok_or_else(|| UnitError::UnknownUnit { name: name.to_string(), nearest: names::nearest(name) })?
            }
            None => return Err(UnitError::UnexpectedText { found: self.whole.to_string() }),
            Some(_) => return Err(self.unexpected()),
        };
        let exponent = self.exponent()?;
        self.checked(base.power(exponent))
    }

    /// Refuses what no table of units has, and what powers of powers would make too large to count.
    fn checked(&self, unit: Unit) -> Result<Unit, UnitError> {
        if unit.dimension.largest_exponent() <= LARGEST_EXPONENT {
            Ok(unit)
        } else {
            Err(UnitError::DimensionTooLarge { found: self.whole.to_string() })
        }
    }

    /// An exponent, 1 when there is none.
    fn exponent(&mut self) -> Result<i16, UnitError> {
        let written = if self.rest.starts_with('^') {
            self.skip('^');
            self.take(|c| c.is_ascii_digit() || c == '-' || c == '+').to_string()
        } else {
            self.take(|c| superscript(c).is_some()).chars().filter_map(superscript).collect()
        };
        if written.is_empty() && !self.whole[..self.whole.len() - self.rest.len()].ends_with('^') {
            return Ok(1);
        }
        match written.parse() {
            Ok(n) if (-99..=99).contains(&n) => Ok(n),
            _ => Err(UnitError::BadExponent { found: written }),
        }
    }

    fn skip(&mut self, c: char) {
        self.rest = &self.rest[c.len_utf8()..];
    }

    fn take(&mut self, wanted: impl Fn(char) -> bool) -> &'t str {
        let end = self.rest.find(|c| !wanted(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest;
        taken
    }

    fn unexpected(&self) -> UnitError {
        UnitError::UnexpectedText { found: self.rest.chars().take(20).collect() }
    }

    fn unmatched(&self) -> UnitError {
        UnitError::UnmatchedBracket { found: self.whole.to_string() }
    }
}

fn is_name(c: char) -> bool {
    (c.is_alphabetic() && superscript(c).is_none()) || matches!(c, '°' | 'µ' | '%' | '_')
}

fn superscript(c: char) -> Option<char> {
    Some(match c {
        '⁻' => '-',
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        _ => return None,
    })
}
