//! Golden reference data: `testdata/golden/<name>.json`, each `{"meta": {…}, "cases": […]}`.
//!
//! The inputs are exact doubles, the outputs were computed from them with tools that share no code with
//! Piola; `meta` says which.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// One file of reference data.
#[derive(Clone, Debug)]
pub struct Golden {
    /// What the data are, where they come from and how they were verified.
    pub meta: Value,
    /// The cases.
    pub cases: Vec<Value>,
}

/// Reads `testdata/golden/<name>.json`.
///
/// # Panics
/// When the file is missing or malformed, has no cases, or does not say what it is (`meta.what`) and where
/// it comes from (`meta.source` or `meta.source_equations`).
///
/// # Example
/// ```
/// use piola_testkit::golden;
/// let golden = golden::load("euler_angles");
/// assert_eq!(golden::vector(&golden.cases[0]["theta"]), [0.5, 0.75, -1.25]);
/// ```
#[must_use]
#[track_caller]
pub fn load(name: &str) -> Golden {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../testdata/golden/")).join(format!("{name}.json"));
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) => panic!("{}: {error}", path.display()),
    };
    let mut file: Value = match serde_json::from_str(&text) {
        Ok(file) => file,
        Err(error) => panic!("{}: {error}", path.display()),
    };
    let meta = file["meta"].take();
    assert!(meta["what"].is_string(), "{name}.json does not say what it is: meta.what");
    assert!(
        meta["source"].is_string()
            || meta["source_equations"].is_string()
            || meta["source_equations"].as_object().is_some_and(|equations| !equations.is_empty()),
        "{name}.json does not say where it comes from: meta.source or meta.source_equations"
    );
    let Value::Array(cases) = file["cases"].take() else { panic!("{name}.json has no list `cases`") };
    assert!(!cases.is_empty(), "{name}.json has no cases");
    Golden { meta, cases }
}

/// A number, also when it is written as text (for more digits than a double holds).
///
/// # Panics
/// When the value is anything else.
#[must_use]
#[track_caller]
pub fn number(value: &Value) -> f64 {
    match value {
        Value::Number(number) => number.as_f64(),
        Value::String(text) => text.parse().ok(),
        _ => None,
    }
    .unwrap_or_else(|| panic!("expected a number, found {value}"))
}

/// A list of numbers.
///
/// # Panics
/// When the value is anything else.
#[must_use]
#[track_caller]
pub fn vector(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

/// A list of rows.
///
/// # Panics
/// When the value is anything else.
#[must_use]
#[track_caller]
pub fn matrix(value: &Value) -> Vec<Vec<f64>> {
    list(value).iter().map(vector).collect()
}

/// A text.
///
/// # Panics
/// When the value is anything else.
#[must_use]
#[track_caller]
pub fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_else(|| panic!("expected a text, found {value}"))
}

#[track_caller]
fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("expected a list, found {value}"))
}
