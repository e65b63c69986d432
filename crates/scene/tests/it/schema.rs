//! The JSON Schema agrees with the declared keys, and the documentation with both.

use std::path::{Path, PathBuf};

use piola_scene::schema::{self, Absent, Kind, SCENE, Table};
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

/// A path of the repository; none where the package stands alone, outside of it.
fn in_repository(path: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    // The repository has the map of the house; a folder in which a package was unpacked has none.
    root.join("ARCHITECTURE.md").exists().then(|| root.join(path))
}

#[test]
fn documentation_holds_the_generated_tables() {
    let Some(path) = in_repository("docs/reference/scenes.md") else { return };
    let documentation = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(
        documentation.contains(&schema::markdown()),
        "docs/reference/scenes.md must end with what `piola schema --markdown` prints"
    );
}

#[test]
fn scenes_that_come_with_the_program_are_valid() {
    let Some(folder) = in_repository("scenes") else { return };
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut count = 0;
    for entry in entries {
        let path = entry.unwrap_or_else(|error| panic!("{}: {error}", folder.display())).path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            match piola_scene::SceneFile::load(&path, &[]) {
                Ok(_) => count += 1,
                // Scenes of solids, boxes and robots are not read without their feature, and nothing else is wrong with them.
                Err(piola_scene::SceneError::Invalid(report))
                    if !cfg!(all(feature = "solutions", feature = "spectral", feature = "robots")) =>
                {
                    let [mistake] = report.mistakes.as_slice() else { panic!("{}: {report}", path.display()) };
                    assert!(mistake.found.contains("needs the feature `"), "{}: {report}", path.display());
                }
                Err(error) => panic!("{}: {error}", path.display()),
            }
        }
    }
    let has = |feature: bool, scenes: usize| if feature { scenes } else { 0 };
    let least = 10
        + has(cfg!(feature = "solutions"), 5)
        + has(cfg!(feature = "spectral"), 3)
        + has(cfg!(feature = "robots"), 3);
    assert!(least <= count, "{count} scenes");
}
