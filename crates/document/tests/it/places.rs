//! Places of mistakes: line and column, and the words that a report marks.

use std::path::PathBuf;

use piola_document::{Document, DocumentError, LARGEST_SCENE, Report, Source};

use crate::records::SHELF;

/// Line and column of each mistake of a report, and the text above its arrows.
fn marked(report: &Report) -> Vec<(usize, usize, String)> {
    let shown = report.to_string();
    let lines: Vec<Vec<char>> = shown.lines().map(|line| line.chars().collect()).collect();
    let arrows = lines.windows(2).filter_map(|pair| {
        let [line, below] = pair else { return None };
        let first = below.iter().position(|c| *c == '^')?;
        let end = below.iter().rposition(|c| *c == '^')? + 1;
        Some(line.iter().skip(first).take(end - first).collect())
    });
    let found: Vec<String> = arrows.collect();
    assert_eq!(found.len(), report.mistakes.len(), "{report}");
    report.mistakes.iter().zip(found).map(|(mistake, words)| (mistake.line, mistake.column, words)).collect()
}

fn report(document: &Document) -> Report {
    document.report(document.records(&SHELF).1)
}

fn in_text(text: &str) -> Vec<(usize, usize, String)> {
    marked(&report(&Document::parse("shelf.toml", text)))
}

/// What a single setting of a good shelf does wrong.
fn in_setting(setting: &str) -> (usize, String) {
    let text = "position = [1, 2, 3]\n[[body]]\nname = 'first'\ntype = 'rod'\n";
    let mut document = Document::parse("shelf.toml", text);
    document.set(setting);
    let report = report(&document);
    assert!(report.mistakes.iter().all(|mistake| mistake.source == "--set" && mistake.line == 1), "{report}");
    let [(_, column, words)] = marked(&report).try_into().unwrap_or_else(|_| panic!("{setting}: {report}"));
    (column, words)
}

#[test]
fn lines_and_columns_count_characters_from_one() {
    let source = Source::new("odes.txt", "Ode\nö = é\n\nend");
    assert_eq!([1, 2, 3, 4].map(|line| source.line(line)), ["Ode", "ö = é", "", "end"]);
    // `ö` has the bytes 4 and 5, `é` 9 and 10; a byte within a character is at the character.
    let places = [(0, (1, 1)), (3, (1, 4)), (4, (2, 1)), (5, (2, 1)), (6, (2, 2)), (9, (2, 5)), (10, (2, 5))];
    for (byte, place) in places {
        assert_eq!(source.position(byte), place, "byte {byte}");
    }
    assert_eq!((source.position(12), source.position(15)), ((3, 1), (4, 3)));
    // Beyond the end is the end.
    assert_eq!(source.position(99), (4, 4));
}

#[test]
fn a_mistake_is_shown_with_its_line_and_what_is_valid() {
    let text = "position = [1, 2]\n\n\n\n\n\n\n\n\ncopies = 'many'\n";
    let shown = report(&Document::parse("shelf.toml", text)).to_string();
    let first = "error: `position` is a list of 2
  --> shelf.toml:1:12
   |
 1 | position = [1, 2]
   |            ^^^^^^
   = valid: length, a list of 3 numbers in m or a text such as \"[1, …] m\"";
    let second = "error: `copies` is the text \"many\"
   --> shelf.toml:10:10
    |
 10 | copies = 'many'
    |          ^^^^^^
    = valid: a whole number from 1 to 9";
    assert_eq!(shown, format!("{first}\n\n{second}\n\n2 mistakes"));
}

#[test]
fn the_arrows_stand_below_the_wrong_value() {
    assert_eq!(in_text("position = [1, 2, 3]\ncopies = 12"), [(2, 10, "12".to_owned())]);
    assert_eq!(in_text("position = [1, 'zwölf', 3]"), [(1, 16, "'zwölf'".to_owned())]);
    // A value of several lines is marked to the end of its first line.
    assert_eq!(in_text("position = [1, 2,\n 3, 4]"), [(1, 12, "[1, 2,".to_owned())]);
    // In a line of more than a hundred characters, only what is around the value is shown.
    let rods = "{ name = 'a', type = 'rod' }, ".repeat(5);
    let text = format!("position = [1, 2, 3]\nbody = [{rods}{{ name = 'b', type = 'road' }}, {rods}]");
    assert_eq!(in_text(&text), [(2, 180, "'road'".to_owned())]);
    let shown = report(&Document::parse("shelf.toml", &text)).to_string();
    assert!(shown.lines().all(|line| line.chars().count() <= 110), "{shown}");
}

#[test]
fn mistakes_in_values_of_settings_are_marked_in_the_setting() {
    let cases = [
        ("copies=12", 8, "12"),
        ("copies =   12 ", 12, "12"),
        ("position=[1, 2]", 10, "[1, 2]"),
        ("position = [1, 'x', 3]", 16, "'x'"),
        ("body = [{ name = 'a', type = 'rood' }]", 30, "'rood'"),
        ("body = [{ name = 'a', type = 'rod', heft = 2 }]", 37, "heft"),
        ("body.first.mass=-2", 17, "-2"),
    ];
    for (setting, column, words) in cases {
        assert_eq!(in_setting(setting), (column, words.to_owned()), "{setting}");
    }
}

#[test]
fn mistakes_in_paths_of_settings_are_marked_at_their_step() {
    let cases = [
        ("copies", 1, "copies"),
        ("body.second.mass=1", 6, "second"),
        ("body.  second .mass=1", 8, "second"),
        (" shelves = 2", 2, "shelves"),
        ("body[7].mass=1", 5, "[7]"),
        ("body[0].name[12].x=1", 13, "[12]"),
        ("body[one].mass=1", 5, "[one]"),
        ("body.first.mass[=1", 16, "["),
        ("body.first[ 0=1", 11, "[ 0"),
        ("body[0]th.mass=1", 8, "th"),
        ("body.first[0]th.mass=1", 14, "th"),
        ("body..mass=1", 6, "."),
        ("body.   .mass=1", 6, "   "),
        ("body.first.name.number=2", 17, "number"),
    ];
    for (setting, column, words) in cases {
        assert_eq!(in_setting(setting), (column, words.to_owned()), "{setting}");
    }
}

/// Writes a file, reads it as a document, and removes it.
fn read_back(name: &str, bytes: &[u8]) -> Result<Document, DocumentError> {
    let path: PathBuf = std::env::temp_dir().join(format!("piola-document-{name}-{}.toml", std::process::id()));
    std::fs::write(&path, bytes).unwrap_or_else(|error| panic!("{error}"));
    let document = Document::read(&path);
    let _ = std::fs::remove_file(&path);
    document
}

#[test]
fn a_byte_that_is_no_text_is_named_by_line_and_column() {
    let cases: [(&[u8], usize, usize, u8); 4] = [
        (b"\xff", 1, 1, 0xff),
        (b"name = \xff", 1, 8, 0xff),
        (b"a = 1\nbc = \xfe\n", 2, 6, 0xfe),
        (b"a = 1\n\n\0", 3, 1, 0),
    ];
    for (bytes, line, column, byte) in cases {
        match read_back("bytes", bytes) {
            Err(error) => {
                assert!(
                    matches!(error, DocumentError::NotText { line: l, column: c, byte: b, .. } if (l, c, b) == (line, column, byte)),
                    "{bytes:?}: {error:?}"
                );
                let (words, place) = (error.to_string(), format!(".toml:{line}:{column}: the file is not a text file"));
                assert!(words.contains(&place), "{words}");
            }
            Ok(_) => panic!("{bytes:?} is no text"),
        }
    }
}

#[test]
fn a_file_of_the_largest_size_is_read_to_its_last_byte_and_a_larger_one_is_refused() {
    let size = usize::try_from(LARGEST_SCENE).expect("four mebibytes");
    let end = "\ncopies = 7";
    let text = format!("#{}{end}", " ".repeat(size - 1 - end.len()));
    let document = read_back("largest", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(document.sources()[0].text, text);
    assert_eq!(document.records(&SHELF).0.count("copies"), Some(7));
    let refused = read_back("larger", format!("{text}7").as_bytes());
    assert!(
        matches!(refused, Err(DocumentError::TooLarge { bytes, most: LARGEST_SCENE, .. }) if bytes == LARGEST_SCENE + 1)
    );
}
