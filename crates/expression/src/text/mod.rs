//! Expressions from text with units.
//!
//! ```text
//! sum      product { (+ | -) product }
//! product  power { (* | /) power }         no product without a sign
//! power    - power | atom [ ^ power ]
//! atom     number [ [unit] ] | name | `name` | function ( sum, … ) | ( sum )
//! ```
//! `3 [N/m]` is a number with a unit; a number without one is a pure number. Both sides of a sum must have one dimension, and
//! arguments of functions none; angles count as pure numbers. Only an expression that is one bare number (`3`, `-3`, `(3)`) takes the dimension
//! that is needed.
//!
//! The parser is our own: of the crates that parse formulas (`exmex`, `evalexpr`, `fasteval`, `meval`) none knows units, and
//! only `exmex` differentiates, with floats as its scalars. Here a text is checked with its dimensions and becomes nodes that
//! are evaluated over any scalar, so that second derivatives of an energy or variations of a motion need no other form.

mod dimensions;
mod parser;
mod tokens;

use std::collections::BTreeMap;

use piola_document::units::Dimension;
use piola_document::{Mistake, Record, words};

use crate::{Expression, Variable};

/// What a name stands for.
///
/// # Example
/// See [`ExpressionNames`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NameMeaning {
    /// A variable of the expression.
    Variable(Variable),
    /// A number, in SI units.
    Number(f64),
}

/// The names that may stand in an expression, with their dimensions.
///
/// # Example
/// ```
/// use piola_document::units::Dimension;
/// use piola_expression::Variable;
/// use piola_expression::text::{ExpressionNames, NameMeaning, parse};
/// let mut names = ExpressionNames::new(true);
/// assert!(names.add("x", NameMeaning::Variable(Variable::Coordinate(0)), Dimension::LENGTH));
/// // The energy of a spring of 50 N/m; at x = 0.2 m it is 1 J.
/// let energy = parse("25 [N/m] * x^2", &names, Dimension::FORCE.times(Dimension::LENGTH)).expect("an energy");
/// assert!((energy.evaluate(&|_| 0.2_f64) - 1.0).abs() < 1e-15);
/// // A length is no energy, and the answer says so.
/// let mistake = parse("25 * x", &names, Dimension::FORCE).expect_err("a length");
/// assert!(mistake.found.contains("instead of"), "{}", mistake.found);
/// ```
#[derive(Debug, Clone, Default)]
pub struct ExpressionNames {
    meanings: BTreeMap<String, (NameMeaning, Dimension)>,
    /// Rates by the names of coordinates: `rate(name)`.
    rates: BTreeMap<String, (Variable, Dimension)>,
    /// Whether dimensions are checked and units allowed.
    with_units: bool,
}

impl ExpressionNames {
    /// No names but the time `t` and `pi`. With units, dimensions are checked.
    #[must_use]
    pub fn new(with_units: bool) -> Self {
        let mut names = Self { with_units, ..Self::default() };
        names.meanings.insert("t".into(), (NameMeaning::Variable(Variable::Time), Dimension::TIME));
        names.meanings.insert("pi".into(), (NameMeaning::Number(core::f64::consts::PI), Dimension::NONE));
        names
    }

    /// Adds a name; false where it is taken.
    pub fn add(&mut self, name: &str, meaning: NameMeaning, dimension: Dimension) -> bool {
        let free = !self.meanings.contains_key(name) && !parser::is_function(name);
        if free {
            self.meanings.insert(name.to_string(), (meaning, dimension));
        }
        free
    }

    /// Adds `rate(name)`.
    pub fn add_rate(&mut self, name: &str, variable: Variable, dimension: Dimension) {
        self.rates.insert(name.to_string(), (variable, dimension));
    }

    fn known(&self) -> impl Iterator<Item = &str> {
        self.meanings.keys().map(String::as_str)
    }
}

/// A mistake in the text of an expression.
///
/// # Example
/// See [`ExpressionNames`].
#[derive(Debug, Clone, PartialEq)]
pub struct ExpressionMistake {
    /// What was found.
    pub found: String,
    /// What would be valid.
    pub valid: String,
}

impl ExpressionMistake {
    fn new(found: impl Into<String>, valid: impl Into<String>) -> Self {
        Self { found: found.into(), valid: valid.into() }
    }
}

/// The expression of a text, which must have the dimension `expected`.
///
/// # Errors
/// What cannot be read, with what would be valid.
pub fn parse(text: &str, names: &ExpressionNames, expected: Dimension) -> Result<Expression, ExpressionMistake> {
    parser::parse(text, names, expected)
}

/// The expression of a key of a record.
///
/// # Errors
/// The mistake with its place.
pub fn of_key(
    record: &Record,
    key: &'static str,
    names: &ExpressionNames,
    expected: Dimension,
) -> Result<Expression, Box<Mistake>> {
    let text = record.text(key).unwrap_or_default();
    parse(text, names, expected).map_err(|wrong| {
        let shown: String = text.chars().take(60).collect();
        Mistake::new(record.place_of(key), format!("`{key}` is \"{shown}\": {}", wrong.found)).valid(wrong.valid).into()
    })
}

/// The names that are known, as advice.
fn one_of(name: &str, names: &ExpressionNames) -> String {
    words::one_of(name, names.known())
}
