//! The keys of a document, stated once.
//!
//! A tree of [`Table`]s of [`Key`]s: name, kind, unit, default, documentation, declared by [`table!`](crate::table).
//! Validation ([`Document::records`](crate::Document::records)), the JSON Schema for editors ([`json_schema`]) and the tables
//! of a reference ([`markdown`]) all read it.

mod json;
mod markdown;

pub use json::json_schema;
pub use markdown::markdown;

use crate::units::Dimension;

/// Declares a static [`Table`](crate::schema::Table): each key with its documentation, `key: kind, absent;` or
/// `key: kind, absent, only_for types;`.
///
/// # Example
/// ```
/// use piola_document::schema::{Absent, Kind};
/// piola_document::table! {
///     /// A title.
///     static PAGE = "page" {
///         /// The words above it.
///         title: Kind::Text, Absent::Required;
///     }
/// }
/// assert_eq!(PAGE.key("title").map(|key| key.doc), Some("The words above it."));
/// ```
#[macro_export]
macro_rules! table {
    (
        $(#[doc = $about:literal])+
        $visibility:vis static $table:ident = $header:literal {
            $($(#[doc = $doc:literal])+ $key:ident: $kind:expr, $absent:expr $(, only_for $types:expr)?;)+
        }
    ) => {
        $(#[doc = $about])+
        $visibility static $table: $crate::schema::Table = $crate::schema::Table {
            name: $header,
            doc: concat!($($about),+).trim_ascii(),
            keys: &[$($crate::schema::Key {
                name: stringify!($key),
                kind: $kind,
                absent: $absent,
                only_for: $crate::table!(@types $($types)?),
                doc: concat!($($doc),+).trim_ascii(),
            }),+],
        };
    };
    (@types) => { &[] };
    (@types $types:expr) => { $types };
}
/// A table of a document.
#[derive(Debug)]
pub struct Table {
    /// Header as written: `gravity`, `body`.
    pub name: &'static str,
    /// Purpose of the table.
    pub doc: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
}

/// A key of a table.
#[derive(Debug)]
pub struct Key {
    /// The key as written.
    pub name: &'static str,
    /// Kind of its value.
    pub kind: Kind,
    /// The rule when it is absent.
    pub absent: Absent,
    /// Values of the table's `type` for which the key exists; empty for all.
    pub only_for: &'static [&'static str],
    /// Meaning.
    pub doc: &'static str,
}

/// The kind of a key's value.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A name of letters, digits, `_`, `-` and spaces.
    Name,
    /// Any text.
    Text,
    /// A list of texts.
    Texts,
    /// The path of a file, relative to the file that names it.
    Path,
    /// `true` or `false`.
    Flag,
    /// A whole number from `least` to `most`.
    Count {
        /// Smallest value.
        least: u32,
        /// Largest value.
        most: u32,
    },
    /// A number with a dimension (or none).
    Quantity(Dimension, Range),
    /// Numbers that share a dimension, as many as one of the counts.
    Numbers(Dimension, &'static [usize]),
    /// One of several words.
    Choice(&'static [Word]),
    /// An inner table.
    Table(&'static Table),
    /// A list of tables.
    Tables(&'static Table),
    /// A table of names of the writer's own, each with a number of any dimension.
    Parameters,
}

/// Which numbers are valid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// 0 ≤ x.
    NotNegative,
    /// 0 < x.
    Positive,
    /// 0 < x < 1.
    Fraction,
}

/// A word with its meaning.
#[derive(Debug)]
pub struct Word {
    /// The word.
    pub name: &'static str,
    /// Its meaning.
    pub doc: &'static str,
}

/// The rule for an absent key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Absent {
    /// It may not be absent.
    Required,
    /// Nothing is assumed; whether that is allowed depends on other keys.
    Optional,
    /// The value that is taken, as it would be written in TOML.
    Default(&'static str),
}

impl Range {
    /// Whether a finite number is valid.
    #[must_use]
    pub fn contains(self, x: f64) -> bool {
        match self {
            Self::Any => true,
            Self::NotNegative => 0.0 <= x,
            Self::Positive => 0.0 < x,
            Self::Fraction => 0.0 < x && x < 1.0,
        }
    }

    /// The condition in words that follow "a number".
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Any => "",
            Self::NotNegative => " that is zero or more",
            Self::Positive => " greater than zero",
            Self::Fraction => " between zero and one",
        }
    }
}

impl Kind {
    /// The valid values in words: "a length such as "2 m"".
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Self::Name => "a name of letters, digits, `_` and `-`".to_string(),
            Self::Text => "a text".to_string(),
            Self::Texts => "a list of texts".to_string(),
            Self::Path => "the path of a file, relative to the file that names it".to_string(),
            Self::Flag => "true or false".to_string(),
            Self::Count { least, most } => format!("a whole number from {least} to {most}"),
            Self::Quantity(dimension, range) if *dimension == Dimension::NONE => format!("a number{}", range.words()),
            Self::Quantity(dimension, range) => {
                let unit = dimension.si_unit();
                format!("{dimension}, a number{} in {unit} or a text with a unit such as \"1.5 {unit}\"", range.words())
            }
            Self::Numbers(dimension, counts) => {
                let counts: Vec<String> = counts.iter().map(ToString::to_string).collect();
                let counts = counts.join(" or ");
                let unit = dimension.si_unit();
                if *dimension == Dimension::NONE {
                    format!("a list of {counts} numbers")
                } else {
                    format!("{dimension}, a list of {counts} numbers in {unit} or a text such as \"[1, …] {unit}\"")
                }
            }
            Self::Choice(words) => {
                let names: Vec<String> = words.iter().map(|word| format!("\"{}\"", word.name)).collect();
                format!("one of {}", names.join(", "))
            }
            Self::Table(table) => format!("a table, [{}]", table.name),
            Self::Tables(table) => format!("a list of tables, [[{}]]", table.name),
            Self::Parameters => "a table of names with numbers, as k = \"2 N/m\"".to_string(),
        }
    }
}

impl Table {
    /// The key of a name.
    #[must_use]
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }
}
