//! A checked document in which some numbers differ from use to use.

use crate::record::{Field, FieldValue};
use crate::schema::{Kind, Range, Table};
use crate::settings::{self, Step};
use crate::units::{Dimension, Unit, quantity};
use crate::{Document, Record};

/// A document that is parsed and checked once, and in which the numbers at some paths are then replaced.
///
/// The record with replaced numbers is the one that [`Document::records`] makes after settings with the same numbers. Only its places differ: they
/// are those of the settings that the document had. A number that is not valid gives no record; [`Document::set`] on the document itself then
/// tells the mistake with its place.
///
/// # Example
/// ```
/// use piola_document::Document;
/// use piola_document::schema::{Absent, Kind, Range};
/// use piola_document::units::Dimension;
/// piola_document::table! {
///     /// A page.
///     static PAGE = "page" {
///         /// How wide it is.
///         width: Kind::Quantity(Dimension::LENGTH, Range::Positive), Absent::Default("\"20 cm\"");
///     }
/// }
/// let mut document = Document::parse("page.toml", "");
/// document.set("width=25 cm");
/// let varied = document.varied(&PAGE, &[("width", "cm")]).expect("a number");
/// let width = |number: f64| varied.record(&[number]).and_then(|record| record.number("width"));
/// assert_eq!((width(30.0), width(-1.0)), (Some(0.3), None));
/// ```
#[derive(Debug, Clone)]
pub struct Varied {
    record: Record,
    numbers: Vec<Number>,
}

/// A number of the document that is replaced.
#[derive(Debug, Clone)]
struct Number {
    /// The tables that lead to it: a key, and the place in a list of tables.
    tables: Vec<(&'static str, Option<usize>)>,
    key: &'static str,
    /// Its place in a list of numbers or of parameters.
    index: Option<usize>,
    range: Range,
    unit: Option<(Unit, String)>,
}

impl Document {
    /// The document with numbers to be replaced: paths as of [`set`](Self::set), each with the unit that its numbers will have, empty for
    /// none. The document has a valid number at each path.
    ///
    /// Nothing if the document has mistakes, or a path leads to something else than a quantity: such
    /// values are to be varied by [`set`](Self::set).
    #[must_use]
    pub fn varied(&self, root: &'static Table, paths: &[(&str, &str)]) -> Option<Varied> {
        let (record, mistakes) = self.records(root);
        if !mistakes.is_empty() {
            return None;
        }
        let numbers = paths.iter().map(|(path, unit)| number(&record, root, path, unit)).collect::<Option<_>>()?;
        Some(Varied { record, numbers })
    }
}

/// Finds a number in a record.
fn number(record: &Record, root: &'static Table, path: &str, unit: &str) -> Option<Number> {
    let unit = unit.trim();
    let unit = if unit.is_empty() { None } else { Some((unit.parse().ok()?, unit.to_owned())) };
    let mut steps = settings::steps(path, 0).ok()?.into_iter();
    let (mut record, mut table, mut tables) = (record, root, Vec::new());
    loop {
        let Some(Step::Key(name, _)) = steps.next() else { return None };
        let key = table.key(&name)?;
        let has_unit_of =
            |dimension: Dimension| unit.as_ref().is_none_or(|(unit, _): &(Unit, _)| unit.dimension == dimension);
        match (&key.kind, &record.fields.get(key.name)?.value) {
            (Kind::Table(inner), FieldValue::Record(below)) => {
                tables.push((key.name, None));
                (record, table) = (below, inner);
            }
            (Kind::Tables(inner), FieldValue::Records(below)) => {
                let index = match steps.next()? {
                    Step::Index(index, _) => index,
                    Step::Key(name, _) => below.iter().position(|record| record.text("name") == Some(name.as_str()))?,
                };
                tables.push((key.name, Some(index)));
                (record, table) = (below.get(index)?, inner);
            }
            (Kind::Quantity(dimension, range), FieldValue::Number(_)) if has_unit_of(*dimension) => {
                let whole = steps.next().is_none() && record.has(key.name);
                return whole.then_some(Number { tables, key: key.name, index: None, range: *range, unit });
            }
            (Kind::Numbers(dimension, _), FieldValue::Numbers(numbers)) if has_unit_of(*dimension) => {
                let Some(Step::Index(index, _)) = steps.next() else { return None };
                let whole = steps.next().is_none() && record.has(key.name) && index < numbers.len();
                let range = Range::Any;
                return whole.then_some(Number { tables, key: key.name, index: Some(index), range, unit });
            }
            (Kind::Parameters, FieldValue::Parameters(parameters)) => {
                let Some(Step::Key(name, _)) = steps.next() else { return None };
                let index = parameters.iter().position(|parameter| parameter.name == name)?;
                let dimension = unit.as_ref().map_or(Dimension::NONE, |(unit, _)| unit.dimension);
                let whole = steps.next().is_none() && parameters[index].dimension == dimension;
                let (index, range) = (Some(index), Range::Any);
                return whole.then_some(Number { tables, key: key.name, index, range, unit });
            }
            _ => return None,
        }
    }
}

impl Varied {
    /// The record with other numbers, in the order and the units of the paths; nothing if one of them is not valid.
    #[must_use]
    pub fn record(&self, numbers: &[f64]) -> Option<Record> {
        if numbers.len() != self.numbers.len() {
            return None;
        }
        let mut record = self.record.clone();
        for (number, &value) in self.numbers.iter().zip(numbers) {
            number.replace(&mut record, value)?;
        }
        Some(record)
    }
}

impl Number {
    /// Replaces the number in a record; nothing if the value is not valid.
    fn replace(&self, record: &mut Record, value: f64) -> Option<()> {
        if !value.is_finite() {
            return None;
        }
        let value = quantity::convert(value, self.unit.as_ref()).ok().filter(|value| self.range.contains(*value))?;
        let mut table = record;
        for (key, index) in &self.tables {
            table = match (&mut table.fields.get_mut(key)?.value, index) {
                (FieldValue::Record(below), None) => below,
                (FieldValue::Records(below), Some(index)) => below.get_mut(*index)?,
                _ => return None,
            };
        }
        let Field { value: field, .. } = table.fields.get_mut(self.key)?;
        match (field, self.index) {
            (FieldValue::Number(number), None) => *number = value,
            (FieldValue::Numbers(numbers), Some(index)) => *numbers.get_mut(index)? = value,
            (FieldValue::Parameters(parameters), Some(index)) => parameters.get_mut(index)?.value = value,
            _ => return None,
        }
        Some(())
    }
}
