//! Documents against declared tables: values, defaults, mistakes.

use piola_document::schema::{Absent, Kind, Range, Table, Word, json_schema, markdown};
use piola_document::units::Dimension;
use piola_document::{Document, DocumentError, Mistake, Record, table};
use piola_testkit::{Tol, assert_close};

static SHAPES: [Word; 2] = [Word { name: "rod", doc: "a thin rod" }, Word { name: "disc", doc: "a flat disc" }];

table! {
    /// An inner table.
    static BODY = "body" {
        /// Its name.
        name: Kind::Name, Absent::Required;
        /// Its shape.
        type: Kind::Choice(&SHAPES), Absent::Required;
        /// Its mass.
        mass: Kind::Quantity(Dimension::MASS, Range::Positive), Absent::Default("1.0");
        /// Its thickness.
        thickness: Kind::Quantity(Dimension::LENGTH, Range::Positive), Absent::Optional, only_for &["disc"];
    }
}

table! {
    /// A shelf.
    pub(crate) static SHELF = "shelf" {
        /// Its place.
        position: Kind::Numbers(Dimension::LENGTH, &[3]), Absent::Required;
        /// How many there are.
        copies: Kind::Count { least: 1, most: 9 }, Absent::Default("1");
        /// What stands on it.
        body: Kind::Tables(&BODY), Absent::Optional;
    }
}

fn read(text: &str) -> (Record, Vec<Mistake>) {
    Document::parse("shelf.toml", text).records(&SHELF)
}

#[test]
fn values_are_in_si_units_and_defaults_are_filled_in() {
    let (record, mistakes) =
        read("position = '[1, 2, 3] km'\n[[body]]\nname = 'a b'\ntype = 'disc'\nthickness = 0.5\n");
    assert!(mistakes.is_empty(), "{mistakes:?}");
    assert_close("position", &record.vector("position").unwrap_or_default(), &[1e3, 2e3, 3e3], Tol::ulps(0.0));
    assert_eq!(record.count("copies"), Some(1));
    assert!(!record.has("copies") && record.has("body"));
    let [body] = record.records("body") else { panic!("{record:?}") };
    assert_eq!((body.text("name"), body.text("type")), (Some("a b"), Some("disc")));
    assert_close("mass", &[body.number("mass").unwrap_or(f64::NAN)], &[1.0], Tol::ulps(0.0));
}

#[test]
fn every_mistake_names_the_value_and_what_is_valid() {
    let cases = [
        ("", "the shelf lacks `position`", "position = length, a list of 3 numbers"),
        ("position = [1, 2]", "a list of 2", "a list of 3 numbers in m"),
        ("position = [1, 2, 3]\ncopies = 10", "`copies` is the number 10", "a whole number from 1 to 9"),
        ("position = [1, 2, 3]\nmass = 2", "unknown key `mass`", "it belongs in [[body]]"),
        ("position = [1, 2, 3]\n[[body]]\nname = 'a'\ntype = 'disk'", "`type` is", "did you mean `disc`?"),
        (
            "position = [1, 2, 3]\n[[body]]\nname = 'a'\ntype = 'rod'\nthickness = 1",
            "`thickness` is no key of a rod body",
            "`thickness` is of type disc",
        ),
        ("position = [1, 2, 3]\n[[body]]\nname = 'a'\ntype = 'rod'\nmass = '0 g'", "`mass` is", "greater than zero"),
    ];
    for (text, found, valid) in cases {
        let (_, mistakes) = read(text);
        let [mistake] = mistakes.as_slice() else { panic!("{text}: {mistakes:?}") };
        assert!(mistake.found.contains(found), "{text}: {mistake:?}");
        assert!(mistake.valid.as_ref().is_some_and(|words| words.contains(valid)), "{text}: {mistake:?}");
    }
}

#[test]
fn settings_change_values_before_they_are_checked() {
    let mut document = Document::parse("shelf.toml", "[[body]]\nname = 'a'\ntype = 'rod'\n");
    document.set("position=[1, 2, 3] mm");
    document.set("body.a.mass = 2 t");
    let (record, mistakes) = document.records(&SHELF);
    assert!(mistakes.is_empty(), "{mistakes:?}");
    assert_close("mass", &[record.records("body")[0].number("mass").unwrap_or(f64::NAN)], &[2e3], Tol::ulps(0.0));
    document.set("body.b.mass = 1");
    let report = document.report(document.records(&SHELF).1);
    let [mistake] = report.mistakes.as_slice() else { panic!("{report}") };
    assert_eq!((mistake.source.as_str(), mistake.line, mistake.column), ("--set", 1, 6), "{report}");
}

#[test]
fn schema_and_reference_have_every_key() {
    fn keys(table: &Table) -> Vec<&'static str> {
        table.keys.iter().map(|key| key.name).collect()
    }
    let schema = json_schema(&SHELF);
    let text = markdown(&SHELF);
    for (names, properties) in
        [(keys(&SHELF), &schema["properties"]), (keys(&BODY), &schema["properties"]["body"]["items"]["properties"])]
    {
        assert_eq!(properties.as_object().map(serde_json::Map::len), Some(names.len()));
        for name in names {
            assert!(properties[name]["description"].is_string(), "{name}");
            assert!(text.contains(&format!("| `{name}` |")), "{name}");
        }
    }
}

#[test]
fn a_missing_file_is_no_document() {
    let missing = Document::read(std::path::Path::new("no such file.toml"));
    assert!(matches!(missing, Err(DocumentError::Unreadable { .. })));
    let folder = Document::read(std::path::Path::new("."));
    assert!(matches!(folder, Err(DocumentError::Folder { .. })));
}
