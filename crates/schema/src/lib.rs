//! The keys of scenes of mechanics, stated once.
#![doc = include_str!("../README.md")]
//!
//! [`SCENE`] is a tree of [`Table`]s of [`Key`]s: name, kind, unit, default, documentation. Validation, the JSON Schema
//! for editors ([`json_schema`]) and the tables of the scene reference ([`markdown`]) all read it.
#![forbid(unsafe_code)]

mod boxes;
mod forces;
mod phase;
mod robot;
mod solids;
mod studies;
mod tables;

pub use piola_document::schema::{Absent, Key, Kind, Range, Table, Word};
pub use tables::{JOINT_TYPES, METHODS, SCENE, SCENE_KINDS};

use piola_document::schema;
use piola_document::units::Dimension;
use serde_json::{Value, json};

/// A kind of scene: the table that says so, and what else belongs to it.
#[derive(Debug)]
pub struct SceneKind {
    /// Header of the table.
    pub name: &'static str,
    /// Whether it is a study, without a span of time.
    pub study: bool,
    /// Other tables and lists of tables that belong to it.
    pub lists: &'static [&'static str],
}

const fn word(name: &'static str, doc: &'static str) -> Word {
    Word { name, doc }
}

const fn quantity(dimension: Dimension, range: Range) -> Kind {
    Kind::Quantity(dimension, range)
}

/// The JSON Schema of a scene.
///
/// It constrains single values. Conditions that span several keys are left to `piola check`.
///
/// # Example
/// ```
/// let schema = piola_schema::json_schema();
/// assert_eq!(schema["properties"]["gravity"]["properties"]["post_newtonian"]["type"], "boolean");
/// ```
#[must_use]
pub fn json_schema() -> Value {
    let mut schema = schema::json_schema(&SCENE);
    schema.insert("title".into(), "Piola scene".into());
    let kinds = SCENE_KINDS.each_ref().map(|kind| {
        let time: &[&str] = if kind.study && kind.name != "robot" { &[] } else { &["time"] };
        json!({ "required": ([&[kind.name], time].concat()) })
    });
    schema.insert("oneOf".into(), kinds.to_vec().into());
    schema.into()
}

/// Every table with its keys, the methods, the types of joints and the units, as the reference prints them.
#[must_use]
pub fn markdown() -> String {
    schema::markdown(&SCENE)
}
