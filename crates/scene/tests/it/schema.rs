//! The JSON Schema agrees with the declared keys, and the documentation with both.

use piola_scene::schema::{self, Absent, Kind, SCENE, Table};
use serde_json::Value;

#[test]
fn schema_has_every_key_with_its_documentation() {
    fn compare(table: &Table, schema: &Value) {
        let properties = schema["properties"].as_object().unwrap_or_else(|| panic!("{} has no properties", table.name));
        assert_eq!(properties.len(), table.keys.len());
        assert_eq!(schema["additionalProperties"], false);
        for key in table.keys {
            let property = &properties[key.name];
            assert!(property["description"].is_string(), "{}.{}", table.name, key.name);
            match key.kind {
                Kind::Table(inner) => compare(inner, property),
                Kind::Tables(inner) => compare(inner, &property["items"]),
                _ => {}
            }
        }
    }
    compare(&SCENE, &schema::json_schema());
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
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/reference/scenes.md");
    // A package that stands alone has no documentation beside it.
    let Ok(documentation) = std::fs::read_to_string(path) else { return };
    assert!(
        documentation.contains(&schema::markdown()),
        "docs/reference/scenes.md must end with what `piola schema --markdown` prints"
    );
}

#[test]
fn scenes_that_come_with_the_program_are_valid() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.filter_map(Result::ok) {
        let path = entry.path();
        if path.extension().is_some_and(|extension| extension == "toml")
            && let Err(error) = piola_scene::SceneFile::load(&path, &[])
        {
            panic!("{}: {error}", path.display());
        }
    }
}
