//! JSON Schema (draft 2020-12) of declared tables, for completion and checking in editors.

use serde_json::{Map, Value, json};

use super::{Absent, Key, Kind, Range, Table};
use crate::units::Dimension;

/// The JSON Schema of a document with these keys at its root.
///
/// It constrains single values. Conditions that span several keys are left to the reader of the document.
///
/// # Example
/// ```
/// use piola_document::schema::{Absent, Kind, json_schema};
/// piola_document::table! {
///     /// A title.
///     static PAGE = "page" {
///         /// The words above it.
///         title: Kind::Text, Absent::Required;
///     }
/// }
/// assert_eq!(json_schema(&PAGE)["properties"]["title"]["type"], "string");
/// ```
#[must_use]
pub fn json_schema(root: &Table) -> Map<String, Value> {
    let mut schema = table(root);
    schema.insert("$schema".into(), "https://json-schema.org/draft/2020-12/schema".into());
    schema
}

fn table(table: &Table) -> Map<String, Value> {
    let mut schema = Map::new();
    schema.insert("type".into(), "object".into());
    schema.insert("description".into(), table.doc.into());
    let properties: Map<String, Value> = table.keys.iter().map(|k| (k.name.into(), key(k))).collect();
    schema.insert("properties".into(), properties.into());
    let required = |only_for: bool| {
        table.keys.iter().filter(move |key| key.absent == Absent::Required && key.only_for.is_empty() != only_for)
    };
    let always: Vec<Value> = required(false).map(|key| key.name.into()).collect();
    if !always.is_empty() {
        schema.insert("required".into(), always.into());
    }
    // Keys of some types only: required there, and false elsewhere.
    let conditions: Vec<Value> = table
        .keys
        .iter()
        .filter(|key| !key.only_for.is_empty())
        .map(|key| {
            let mut condition = json!({
                "if": { "properties": { "type": { "enum": key.only_for } } },
                "else": { "properties": { key.name: false } },
            });
            if key.absent == Absent::Required {
                condition["then"] = json!({ "required": [key.name] });
            }
            condition
        })
        .collect();
    if !conditions.is_empty() {
        schema.insert("allOf".into(), conditions.into());
    }
    schema.insert("additionalProperties".into(), false.into());
    schema
}

fn key(key: &Key) -> Value {
    let mut schema = kind(&key.kind);
    let mut doc = key.doc.to_string();
    if let Kind::Quantity(dimension, _) | Kind::Numbers(dimension, _) = key.kind
        && dimension != Dimension::NONE
    {
        doc = format!("{doc} A plain number is in {}.", dimension.si_unit());
    }
    schema.insert("description".into(), doc.into());
    if let Absent::Default(text) = key.absent {
        // Defaults are literals that JSON and TOML share.
        if let Ok(value) = serde_json::from_str::<Value>(text) {
            schema.insert("default".into(), value);
        }
    }
    schema.into()
}

fn kind(kind: &Kind) -> Map<String, Value> {
    let schema = match kind {
        Kind::Name => json!({ "type": "string", "pattern": "^[\\p{L}\\p{N}_][\\p{L}\\p{N}_ -]*$" }),
        Kind::Text | Kind::Path => json!({ "type": "string" }),
        Kind::Texts => json!({ "type": "array", "items": { "type": "string" } }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Count { least, most } => json!({ "type": "integer", "minimum": least, "maximum": most }),
        Kind::Quantity(dimension, range) => {
            let mut number = json!({ "type": "number" });
            match range {
                Range::Any => {}
                Range::NotNegative => number["minimum"] = 0.into(),
                Range::Positive => number["exclusiveMinimum"] = 0.into(),
                Range::Fraction => {
                    number["exclusiveMinimum"] = 0.into();
                    number["exclusiveMaximum"] = 1.into();
                }
            }
            if *dimension == Dimension::NONE { number } else { json!({ "anyOf": [number, with_unit(*dimension)] }) }
        }
        Kind::Numbers(dimension, counts) => {
            let lists = counts.iter().map(
                |count| json!({ "type": "array", "items": { "type": "number" }, "minItems": count, "maxItems": count }),
            );
            json!({ "anyOf": lists.chain(core::iter::once(with_unit(*dimension))).collect::<Vec<_>>() })
        }
        Kind::Choice(words) => json!({
            "oneOf": words.iter().map(|word| json!({ "const": word.name, "description": word.doc })).collect::<Vec<_>>()
        }),
        Kind::Table(inner) => return table(inner),
        Kind::Tables(inner) => json!({ "type": "array", "items": table(inner) }),
        Kind::Parameters => json!({ "type": "object", "additionalProperties": { "type": ["number", "string"] } }),
    };
    if let Value::Object(map) = schema { map } else { Map::new() }
}

fn with_unit(dimension: Dimension) -> Value {
    json!({ "type": "string", "description": format!("{dimension}, with its unit") })
}
