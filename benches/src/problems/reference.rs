//! Reading the files of `testdata`.

use std::path::Path;

use serde_json::Value;

/// Why reference data could not be read.
pub type ReferenceError = Box<dyn std::error::Error>;

pub(super) fn read(name: &str) -> Result<Value, ReferenceError> {
    read_from("reference", name)
}

pub(super) fn read_golden(name: &str) -> Result<Value, ReferenceError> {
    read_from("golden", name)
}

fn read_from(kind: &str, name: &str) -> Result<Value, ReferenceError> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../testdata").join(kind);
    let path = folder.join(name).with_extension("json");
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(serde_json::from_str(&text)?)
}

/// A number, written as one, as a string of more digits, or as a fraction `1/x`.
fn number(value: &Value) -> Result<f64, ReferenceError> {
    if let Some(number) = value.as_f64() {
        return Ok(number);
    }
    let text = value.as_str().ok_or("a number is missing")?;
    Ok(match text.split_once('/') {
        Some((over, under)) => over.parse::<f64>()? / under.parse::<f64>()?,
        None => text.parse()?,
    })
}

/// All numbers of a list, of lists or not.
pub(super) fn numbers(value: &Value) -> Result<Vec<f64>, ReferenceError> {
    match value {
        Value::Array(list) => {
            let lists: Result<Vec<_>, _> = list.iter().map(numbers).collect();
            Ok(lists?.concat())
        }
        value => Ok(vec![number(value)?]),
    }
}

pub(super) fn array<const D: usize>(values: &[f64]) -> Result<[f64; D], ReferenceError> {
    Ok(values.try_into().map_err(|_| format!("{} numbers instead of {D}", values.len()))?)
}
