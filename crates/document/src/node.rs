//! The tree of a document: tables, lists and values, each with its place.

use crate::{Place, words};

/// A value with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Where it stands; for a table with a header, the header.
    pub place: Place,
    /// The value.
    pub value: Value,
}

/// A value of a document.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A table, entries in the order of the text.
    Table(Vec<Entry>),
    /// A list.
    List(Vec<Node>),
    /// A text.
    Text(String),
    /// A number, whole or not.
    Number {
        /// The value as a double.
        value: f64,
        /// Whether it was written without a point or exponent.
        whole: bool,
    },
    /// True or false.
    Flag(bool),
    /// A date or time of day, which no declared key takes.
    Date(String),
}

/// A key with its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Where the key stands.
    pub place: Place,
    /// The value.
    pub node: Node,
}

impl Node {
    /// The entries of a table, none for anything else.
    #[must_use]
    pub fn entries(&self) -> &[Entry] {
        if let Value::Table(entries) = &self.value { entries } else { &[] }
    }

    /// The value of a key of a table.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.entries().iter().find(|entry| entry.key == key).map(|entry| &entry.node)
    }
}

impl Value {
    /// The value in words, for "found …".
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Self::Table(_) => "a table".to_string(),
            Self::List(items) if items.len() == 1 => "a list of one".to_string(),
            Self::List(items) => format!("a list of {}", items.len()),
            Self::Text(text) if text.chars().count() <= 40 => format!("the text \"{text}\""),
            Self::Text(text) => format!("a text of {} characters", text.chars().count()),
            Self::Number { value, whole: true } => format!("the number {value}"),
            Self::Number { value, .. } if value.is_finite() => format!("the number {}", words::number(*value)),
            Self::Number { value, .. } => {
                if value.is_nan() {
                    "nan".to_string()
                } else {
                    format!("{value}")
                }
            }
            Self::Flag(flag) => flag.to_string(),
            Self::Date(date) => format!("the date {date}"),
        }
    }
}
