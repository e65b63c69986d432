//! Expressions of scenes: from text with units to [`Expression`]s.
//!
//! ```text
//! sum      product { (+ | -) product }
//! product  power { (* | /) power }         no product without a sign
//! power    - power | atom [ ^ power ]
//! atom     number [ [unit] ] | name | `name` | function ( sum, … ) | ( sum )
//! ```
//! `3 [N/m]` is a number with a unit; a number without one is a pure number. Both sides of a sum must have one dimension, and
//! arguments of functions none; angles count as pure numbers. Only an expression that is one bare number takes the dimension
//! that is needed, as numbers do everywhere in scenes.
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
use piola_simulation::expression::{Expression, Variable};

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Meaning {
    Variable(Variable),
    Number(f64),
}

/// The names that may stand in an expression, with their dimensions.
#[derive(Debug, Clone, Default)]
pub(crate) struct Names {
    meanings: BTreeMap<String, (Meaning, Dimension)>,
    /// Rates by the names of coordinates: `rate(name)`.
    rates: BTreeMap<String, (Variable, Dimension)>,
    /// Whether dimensions are checked and units allowed.
    with_units: bool,
}

impl Names {
    /// No names but the time, whose dimension is checked where units are.
    pub(crate) fn new(with_units: bool) -> Self {
        let mut names = Self { with_units, ..Self::default() };
        names.meanings.insert("t".into(), (Meaning::Variable(Variable::Time), Dimension::TIME));
        names.meanings.insert("pi".into(), (Meaning::Number(core::f64::consts::PI), Dimension::NONE));
        names
    }

    /// Adds a name; false where it is taken.
    pub(crate) fn add(&mut self, name: &str, meaning: Meaning, dimension: Dimension) -> bool {
        let free = !self.meanings.contains_key(name) && !parser::is_function(name);
        if free {
            self.meanings.insert(name.to_string(), (meaning, dimension));
        }
        free
    }

    /// Adds `rate(name)`.
    pub(crate) fn add_rate(&mut self, name: &str, variable: Variable, dimension: Dimension) {
        self.rates.insert(name.to_string(), (variable, dimension));
    }

    fn known(&self) -> impl Iterator<Item = &str> {
        self.meanings.keys().map(String::as_str)
    }
}

/// What is wrong with an expression.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Wrong {
    pub(crate) found: String,
    pub(crate) valid: String,
}

impl Wrong {
    fn new(found: impl Into<String>, valid: impl Into<String>) -> Self {
        Self { found: found.into(), valid: valid.into() }
    }
}

/// The expression of a text, which must have the dimension `expected`.
pub(crate) fn parse(text: &str, names: &Names, expected: Dimension) -> Result<Expression, Wrong> {
    parser::parse(text, names, expected)
}

/// The expression of a key, or the mistake.
pub(crate) fn of_key(
    record: &Record,
    key: &'static str,
    names: &Names,
    expected: Dimension,
) -> Result<Expression, Box<Mistake>> {
    let text = record.text(key).unwrap_or_default();
    parse(text, names, expected).map_err(|wrong| {
        let shown: String = text.chars().take(60).collect();
        Mistake::new(record.place_of(key), format!("`{key}` is \"{shown}\": {}", wrong.found)).valid(wrong.valid).into()
    })
}

/// The names that are known, as advice.
fn one_of(name: &str, names: &Names) -> String {
    words::one_of(name, names.known())
}
