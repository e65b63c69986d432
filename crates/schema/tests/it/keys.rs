//! The JSON Schema agrees with the declared keys, and the documentation with both.

use piola_schema::{self as schema, Absent, Kind, SCENE, Table};
use piola_testkit::repository;
use serde_json::Value;

#[test]
fn schema_has_every_key_with_its_documentation() {
    /// The number of keys that were compared.
    fn compare(table: &Table, schema: &Value) -> usize {
        let properties = schema["properties"].as_object().unwrap_or_else(|| panic!("{} has no properties", table.name));
        assert_eq!(properties.len(), table.keys.len());
        assert_eq!(schema["additionalProperties"], false);
        let mut count = 0;
        for key in table.keys {
            let property = &properties[key.name];
            assert!(property["description"].is_string(), "{}.{}", table.name, key.name);
            match key.kind {
                Kind::Table(inner) => count += compare(inner, property),
                Kind::Tables(inner) => count += compare(inner, &property["items"]),
                // Of any other kind a key has no keys of its own.
                _ => assert!(property["properties"].is_null() && property["items"]["properties"].is_null()),
            }
            count += 1;
        }
        count
    }
    let count = compare(&SCENE, &schema::json_schema());
    assert!(SCENE.keys.len() < count, "{count} keys");
}

#[test]
fn names_of_keys_differ_and_everything_is_documented() {
    fn check(table: &Table) {
        assert!(!table.doc.is_empty());
        for (index, key) in table.keys.iter().enumerate() {
            assert!(key.doc.ends_with('.'), "{}.{}", table.name, key.name);
            assert!(table.keys[index + 1..].iter().all(|other| other.name != key.name), "{}.{}", table.name, key.name);
            assert!(!matches!((key.kind, key.absent), (Kind::Table(_) | Kind::Tables(_), Absent::Default(_))));
            if let Kind::Table(inner) | Kind::Tables(inner) = key.kind {
                check(inner);
            }
        }
    }
    check(&SCENE);
}

#[test]
fn documentation_holds_the_generated_tables() {
    let Some(path) = repository::path("docs/reference/scenes.md") else { return };
    let documentation = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(
        documentation.contains(&schema::markdown()),
        "docs/reference/scenes.md must end with what `piola schema --markdown` prints"
    );
}
