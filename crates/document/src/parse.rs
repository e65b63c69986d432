//! The parser of TOML, which goes on after syntax errors.

use toml::de::{DeTable, DeValue};

use crate::{Entry, Mistake, Node, Place, Source, Value};

/// A text with more syntax errors than this is not searched for further mistakes.
const HOPELESS: usize = 200;

/// The tree of a whole text and its syntax errors.
pub(crate) fn parse(source: &Source, id: usize) -> (Node, Vec<Mistake>) {
    let text = source.text.as_str();
    // A byte-order mark is no mistake; one keeps its three bytes so that places stay right.
    let (table, errors) = DeTable::parse_recoverable(text);
    let mistakes = errors.iter().map(|error| mistake(error, id, text)).collect::<Vec<_>>();
    let root = if mistakes.len() <= HOPELESS { self::table(table.into_inner(), id) } else { Value::Table(Vec::new()) };
    (Node { place: Place { source: id, span: 0..0 }, value: root }, mistakes)
}

/// A single value of TOML, placed as if it stood at byte `offset` of the source.
pub(crate) fn value(text: &str, id: usize, offset: usize) -> Option<Node> {
    let (value, errors) = DeValue::parse_recoverable(text);
    if !errors.is_empty() {
        return None;
    }
    let mut node = node(value.span(), value.into_inner(), id);
    shift(&mut node, offset);
    Some(node)
}

fn shift(node: &mut Node, offset: usize) {
    node.place.span = node.place.span.start + offset..node.place.span.end + offset;
    match &mut node.value {
        Value::Table(entries) => {
            for entry in entries {
                entry.place.span = entry.place.span.start + offset..entry.place.span.end + offset;
                shift(&mut entry.node, offset);
            }
        }
        Value::List(items) => items.iter_mut().for_each(|item| shift(item, offset)),
        _ => {}
    }
}

fn table(table: DeTable<'_>, id: usize) -> Value {
    let mut entries: Vec<Entry> = table
        .into_iter()
        .map(|(key, value)| Entry {
            place: Place { source: id, span: key.span() },
            key: key.into_inner().into_owned(),
            node: node(value.span(), value.into_inner(), id),
        })
        .collect();
    entries.sort_by_key(|entry| entry.place.span.start);
    Value::Table(entries)
}

fn node(span: core::ops::Range<usize>, value: DeValue<'_>, id: usize) -> Node {
    let value = match value {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(integer) => Value::Number { value: whole(integer.as_str(), integer.radix()), whole: true },
        // The syntax is checked, so what cannot be read is a number with signs and underscores only.
        DeValue::Float(float) => {
            Value::Number { value: float.as_str().replace('_', "").parse().unwrap_or(f64::NAN), whole: false }
        }
        DeValue::Boolean(flag) => Value::Flag(flag),
        DeValue::Datetime(date) => Value::Date(date.to_string()),
        DeValue::Array(items) => {
            Value::List(items.into_iter().map(|item| node(item.span(), item.into_inner(), id)).collect())
        }
        DeValue::Table(inner) => table(inner, id),
    };
    Node { place: Place { source: id, span }, value }
}

/// A whole number as a double: correctly rounded in base ten, however long it is.
fn whole(digits: &str, radix: u32) -> f64 {
    let digits = digits.replace('_', "");
    if radix == 10 {
        digits.parse().unwrap_or(f64::NAN)
    } else {
        i128::from_str_radix(&digits, radix).map_or(f64::NAN, |value| value as f64)
    }
}

fn mistake(error: &toml::de::Error, id: usize, text: &str) -> Mistake {
    let span = error.span().unwrap_or(text.len()..text.len());
    let (found, expected) = error.message().split_once(", expected ").unwrap_or((error.message(), ""));
    let mut mistake = Mistake::new(Place { source: id, span }, format!("the text is not TOML: {found}"));
    if !expected.is_empty() {
        mistake = mistake.valid(format!("expected {expected}"));
    }
    mistake.syntax = true;
    mistake
}
