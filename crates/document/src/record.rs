//! Checked values in SI units, each with its place.

use std::collections::BTreeMap;

use crate::Place;
use crate::units::Dimension;

/// A table whose values have the declared kinds.
///
/// # Example
/// ```
/// use piola_document::schema::{Absent, Kind};
/// piola_document::table! {
///     /// A page.
///     static PAGE = "page" {
///         /// The words above it.
///         title: Kind::Text, Absent::Required;
///         /// Whether it has a number.
///         numbered: Kind::Flag, Absent::Default("true");
///     }
/// }
/// let document = piola_document::Document::parse("page.toml", "title = 'Ode'");
/// let (record, _) = document.records(&PAGE);
/// assert_eq!((record.text("title"), record.flag("numbered")), (Some("Ode"), Some(true)));
/// assert!(!record.has("numbered"));
/// ```
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Where the table stands: its header, or nothing for one that is absent.
    pub place: Place,
    /// Values by key. A key that is absent without a default, or wrong, is not here.
    pub fields: BTreeMap<&'static str, Field>,
    /// Keys that were written, whether right or wrong.
    pub written: BTreeMap<&'static str, Place>,
}

/// A checked value.
#[derive(Debug, Clone)]
pub struct Field {
    /// Where the value stands.
    pub place: Place,
    /// The value.
    pub value: FieldValue,
}

/// The value of a field.
#[derive(Debug, Clone)]
pub enum FieldValue {
    /// Of a name, a text, a path or a choice.
    Text(String),
    /// Of a list of texts.
    Texts(Vec<String>),
    /// Of a flag.
    Flag(bool),
    /// Of a count.
    Count(u32),
    /// Of a quantity, in SI units.
    Number(f64),
    /// Of numbers that share a dimension, in SI units.
    Numbers(Vec<f64>),
    /// Of an inner table.
    Record(Record),
    /// Of a list of tables.
    Records(Vec<Record>),
    /// Of a table of parameters.
    Parameters(Vec<Parameter>),
}

/// A number with a name of the writer's own.
///
/// # Example
/// ```
/// use piola_document::schema::{Absent, Kind};
/// use piola_document::units::Dimension;
/// piola_document::table! {
///     /// A page.
///     static PAGE = "page" {
///         /// Numbers with names.
///         parameters: Kind::Parameters, Absent::Optional;
///     }
/// }
/// let document = piola_document::Document::parse("page.toml", "[parameters]\nheight = '2 km'\nshare = 0.5");
/// let (record, _) = document.records(&PAGE);
/// let [height, share] = record.parameters("parameters") else { panic!() };
/// assert_eq!((height.value, height.dimension), (2000.0, Dimension::LENGTH));
/// assert_eq!((share.name.as_str(), share.dimension), ("share", Dimension::NONE));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name: letters, digits and `_`, not a digit first.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The number in SI units.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
}

impl Record {
    /// Whether the key was written, be its value right or wrong.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.written.contains_key(key)
    }
    /// Where the value of a key stands, the key if the value is wrong, the table if neither is written.
    #[must_use]
    pub fn place_of(&self, key: &str) -> Place {
        let value = self.fields.get(key).filter(|_| self.has(key)).map(|field| &field.place);
        value.or_else(|| self.written.get(key)).unwrap_or(&self.place).clone()
    }
    /// The text, name, path or choice of a key.
    #[must_use]
    pub fn text(&self, key: &str) -> Option<&str> {
        match &self.fields.get(key)?.value {
            FieldValue::Text(text) => Some(text),
            _ => None,
        }
    }
    /// The texts of a key; none where it is absent.
    #[must_use]
    pub fn texts(&self, key: &str) -> &[String] {
        match self.fields.get(key).map(|field| &field.value) {
            Some(FieldValue::Texts(texts)) => texts,
            _ => &[],
        }
    }
    /// The flag of a key.
    #[must_use]
    pub fn flag(&self, key: &str) -> Option<bool> {
        match self.fields.get(key)?.value {
            FieldValue::Flag(flag) => Some(flag),
            _ => None,
        }
    }
    /// The count of a key.
    #[must_use]
    pub fn count(&self, key: &str) -> Option<u32> {
        match self.fields.get(key)?.value {
            FieldValue::Count(count) => Some(count),
            _ => None,
        }
    }
    /// The number of a key, in SI units.
    #[must_use]
    pub fn number(&self, key: &str) -> Option<f64> {
        match self.fields.get(key)?.value {
            FieldValue::Number(number) => Some(number),
            _ => None,
        }
    }
    /// The numbers of a key, in SI units.
    #[must_use]
    pub fn numbers(&self, key: &str) -> Option<&[f64]> {
        match &self.fields.get(key)?.value {
            FieldValue::Numbers(numbers) => Some(numbers),
            _ => None,
        }
    }
    /// The numbers of a key that has three.
    #[must_use]
    pub fn vector(&self, key: &str) -> Option<[f64; 3]> {
        self.numbers(key)?.try_into().ok()
    }
    /// The numbers of a key that has two.
    #[must_use]
    pub fn pair(&self, key: &str) -> Option<[f64; 2]> {
        self.numbers(key)?.try_into().ok()
    }
    /// The inner table of a key.
    #[must_use]
    pub fn record(&self, key: &str) -> Option<&Record> {
        match &self.fields.get(key)?.value {
            FieldValue::Record(record) => Some(record),
            _ => None,
        }
    }
    /// The tables of a key; none where it is absent.
    #[must_use]
    pub fn records(&self, key: &str) -> &[Record] {
        match self.fields.get(key).map(|field| &field.value) {
            Some(FieldValue::Records(records)) => records,
            _ => &[],
        }
    }
    /// The parameters of a key; none where it is absent.
    #[must_use]
    pub fn parameters(&self, key: &str) -> &[Parameter] {
        match self.fields.get(key).map(|field| &field.value) {
            Some(FieldValue::Parameters(parameters)) => parameters,
            _ => &[],
        }
    }
}
