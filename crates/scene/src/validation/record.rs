//! Checked values with their places.

use std::collections::BTreeMap;

use crate::document::Place;

/// A table whose values have the declared kinds.
#[derive(Debug, Clone, Default)]
pub(crate) struct Record {
    /// Where the table stands: its header, or nothing for one that is absent.
    pub(crate) place: Place,
    /// Values by key. A key that is absent without a default, or wrong, is not here.
    pub(crate) fields: BTreeMap<&'static str, Field>,
    /// Keys that were written, whether right or wrong.
    pub(crate) written: BTreeMap<&'static str, Place>,
}

/// A checked value.
#[derive(Debug, Clone)]
pub(crate) struct Field {
    /// Where the value stands.
    pub(crate) place: Place,
    /// The value.
    pub(crate) value: FieldValue,
}

#[derive(Debug, Clone)]
pub(crate) enum FieldValue {
    Text(String),
    Flag(bool),
    Count(u32),
    Number(f64),
    Numbers(Vec<f64>),
    Record(Record),
    Records(Vec<Record>),
}

impl Record {
    /// Whether the key was written, be its value right or wrong.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.written.contains_key(key)
    }
    /// Where the value of a key stands, the key if the value is wrong, the table if neither is written.
    pub(crate) fn place_of(&self, key: &str) -> Place {
        let value = self.fields.get(key).filter(|_| self.has(key)).map(|field| &field.place);
        value.or_else(|| self.written.get(key)).unwrap_or(&self.place).clone()
    }
    pub(crate) fn text(&self, key: &str) -> Option<&str> {
        match &self.fields.get(key)?.value {
            FieldValue::Text(text) => Some(text),
            _ => None,
        }
    }
    pub(crate) fn flag(&self, key: &str) -> Option<bool> {
        match self.fields.get(key)?.value {
            FieldValue::Flag(flag) => Some(flag),
            _ => None,
        }
    }
    pub(crate) fn count(&self, key: &str) -> Option<u32> {
        match self.fields.get(key)?.value {
            FieldValue::Count(count) => Some(count),
            _ => None,
        }
    }
    pub(crate) fn number(&self, key: &str) -> Option<f64> {
        match self.fields.get(key)?.value {
            FieldValue::Number(number) => Some(number),
            _ => None,
        }
    }
    pub(crate) fn numbers(&self, key: &str) -> Option<&[f64]> {
        match &self.fields.get(key)?.value {
            FieldValue::Numbers(numbers) => Some(numbers),
            _ => None,
        }
    }
    pub(crate) fn vector(&self, key: &str) -> Option<[f64; 3]> {
        self.numbers(key)?.try_into().ok()
    }
    pub(crate) fn pair(&self, key: &str) -> Option<[f64; 2]> {
        self.numbers(key)?.try_into().ok()
    }
    pub(crate) fn record(&self, key: &str) -> Option<&Record> {
        match &self.fields.get(key)?.value {
            FieldValue::Record(record) => Some(record),
            _ => None,
        }
    }
    pub(crate) fn records(&self, key: &str) -> &[Record] {
        match self.fields.get(key).map(|field| &field.value) {
            Some(FieldValue::Records(records)) => records,
            _ => &[],
        }
    }
}
