//! Files that include files: order, places of mistakes, limits; versions of the format.

use std::path::PathBuf;

use piola_document::schema::{Absent, Kind, Range, json_schema, markdown};
use piola_document::units::Dimension;
use piola_document::{Document, Mistake, Report, Value, table};

table! {
    /// A book.
    static BOOK = "book" {
        /// Its name.
        name: Kind::Name, Absent::Required;
        /// Its number of pages.
        pages: Kind::Count { least: 1, most: 9 }, Absent::Default("1");
    }
}

table! {
    /// The cover of a library.
    static COVER = "cover" {
        /// Its height.
        height: Kind::Quantity(Dimension::LENGTH, Range::Positive), Absent::Optional;
        /// Its width.
        width: Kind::Quantity(Dimension::LENGTH, Range::Positive), Absent::Optional;
        /// Its picture.
        picture: Kind::Path, Absent::Optional;
    }
}

table! {
    /// A library.
    static LIBRARY = "library" {
        /// Version of the format.
        format: Kind::Count { least: 1, most: 1 }, Absent::Default("1");
        /// Files with parts of it.
        include: Kind::Texts, Absent::Optional;
        /// Other names of it.
        aliases: Kind::Texts, Absent::Optional;
        /// Its place.
        place: Kind::Numbers(Dimension::LENGTH, &[2]), Absent::Required;
        /// Its cover.
        cover: Kind::Table(&COVER), Absent::Optional;
        /// Its books.
        book: Kind::Tables(&BOOK), Absent::Optional;
    }
}

/// A folder of files, removed at the end.
struct Files(PathBuf);

impl Files {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let folder = std::env::temp_dir().join(format!("piola-includes-{}-{name}", std::process::id()));
        for (file, text) in files {
            let path = folder.join(file);
            let parent = path.parent().unwrap_or(&folder);
            std::fs::create_dir_all(parent)
                .and_then(|()| std::fs::write(&path, text))
                .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        }
        Self(folder)
    }

    fn read(&self) -> Document {
        self.read_with(&[])
    }

    fn read_with(&self, settings: &[&str]) -> Document {
        let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
        Document::read_with(&self.0.join("main.toml"), &settings).unwrap_or_else(|error| panic!("{error}"))
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn report(document: &Document) -> Report {
    document.report(document.records(&LIBRARY).1)
}

/// The name of the file, line, column and words of each mistake.
fn found(document: &Document) -> Vec<(String, usize, usize, String)> {
    let name =
        |path: &str| PathBuf::from(path).file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    report(document).mistakes.into_iter().map(|m| (name(&m.source), m.line, m.column, m.found)).collect()
}

fn one(document: &Document) -> (String, usize, usize, String) {
    let [one] = found(document).try_into().unwrap_or_else(|all| panic!("{all:?}"));
    one
}

const PLACE: &str = "place = [1, 2]\n";

#[test]
fn tables_are_merged_by_keys_lists_of_tables_concatenated_and_own_values_hold() {
    let files = Files::new(
        "merge",
        &[
            (
                "main.toml",
                "include = ['a.toml', 'b.toml']\nplace = [1, 2]\n[cover]\nwidth = 3\n[[book]]\nname = 'own'\n",
            ),
            ("a.toml", "place = [3, 4]\naliases = ['x', 'y']\n[cover]\nwidth = 1\nheight = 1\n[[book]]\nname = 'a'\n"),
            ("b.toml", "aliases = ['z']\n[cover]\nwidth = 2\nheight = 2\n[[book]]\nname = 'b'\n[[book]]\nname = 'c'\n"),
        ],
    );
    let document = files.read();
    let (record, mistakes) = document.records(&LIBRARY);
    assert_eq!(mistakes, Vec::<Mistake>::new());
    let names: Vec<_> = record.records("book").iter().map(|book| book.text("name")).collect();
    assert_eq!(names, [Some("a"), Some("b"), Some("c"), Some("own")]);
    let cover = record.record("cover").unwrap_or_else(|| panic!("{record:?}"));
    // The file's own before included ones, the later of two included ones before the earlier.
    assert_eq!(
        [cover.number("width"), cover.number("height")].map(|x| x.map(f64::to_bits)),
        [3.0, 2.0].map(|x: f64| Some(x.to_bits()))
    );
    assert_eq!(record.pair("place").map(|pair| pair.map(f64::to_bits)), Some([1.0_f64, 2.0].map(f64::to_bits)));
    assert_eq!(record.texts("aliases"), ["z"]);
    assert!(!record.has("include") && document.root().get("include").is_none());
    assert_eq!(document.sources().len(), 3);
}

#[test]
fn an_empty_list_clears_included_tables() {
    let main = "include = ['a.toml']\nplace = [1, 2]\nbook = []\n";
    let files = Files::new("clear", &[("main.toml", main), ("a.toml", "[[book]]\nname = 'a'\n")]);
    let (record, mistakes) = files.read().records(&LIBRARY);
    assert_eq!((record.records("book").len(), mistakes), (0, Vec::new()));
}

#[test]
fn paths_are_relative_to_the_file_that_names_them_and_a_file_is_merged_once() {
    let files = Files::new(
        "paths",
        &[
            ("main.toml", "include = ['parts/a.toml', 'parts/deep/b.toml']\nplace = [1, 2]\n"),
            ("parts/a.toml", "include = ['deep/b.toml']\n[cover]\npicture = 'a.svg'\n"),
            ("parts/deep/b.toml", "include = ['../../c.toml']\n[cover]\npicture = 'b.svg'\n[[book]]\nname = 'b'\n"),
            ("c.toml", "[[book]]\nname = 'c'\n"),
        ],
    );
    let document = files.read();
    let (record, mistakes) = document.records(&LIBRARY);
    assert_eq!(mistakes, Vec::<Mistake>::new());
    let names: Vec<_> = record.records("book").iter().map(|book| book.text("name")).collect();
    assert_eq!(names, [Some("c"), Some("b")]);
    let picture = |record: &piola_document::Record| {
        record.record("cover").and_then(|cover| cover.text("picture")).map(PathBuf::from)
    };
    assert_eq!(picture(&record), Some(PathBuf::from("parts").join("a.svg")));
    // Of a setting it is relative to the first file.
    let (record, _) = files.read_with(&["cover.picture=c.svg"]).records(&LIBRARY);
    assert_eq!(picture(&record), Some(PathBuf::from("c.svg")));
}

#[test]
fn mistakes_are_shown_in_the_file_that_makes_them() {
    let files = Files::new(
        "places",
        &[
            ("main.toml", "include = ['a.toml']\nplace = [1, 2]\ncolour = 1\n"),
            ("a.toml", "# books\n[[book]]\nname = 'a'\npages = 10\n[[book]]\npages = 2\n"),
        ],
    );
    let document = files.read();
    let places: Vec<_> = found(&document).into_iter().map(|(file, line, column, _)| (file, line, column)).collect();
    let at = |file: &str, line, column| (file.to_string(), line, column);
    assert_eq!(places, [at("main.toml", 3, 1), at("a.toml", 4, 9), at("a.toml", 5, 1)]);
    assert!(report(&document).to_string().contains("4 | pages = 10"));
    let broken = Files::new("syntax", &[("main.toml", "include = ['a.toml']\n"), ("a.toml", "place = [1, 2\n")]);
    // What the text lacks may stand in the damaged part.
    assert!(found(&broken.read()).iter().all(|mistake| mistake.0 == "a.toml"), "{:?}", found(&broken.read()));
}

#[test]
fn a_cycle_is_a_mistake_with_its_chain() {
    let files = Files::new(
        "cycle",
        &[
            ("main.toml", "include = ['a.toml']\nplace = [1, 2]\n"),
            ("a.toml", "include = ['b.toml']\n"),
            ("b.toml", "include = ['./a.toml']\n"),
        ],
    );
    let (file, line, column, words) = one(&files.read());
    assert_eq!((file.as_str(), line, column), ("b.toml", 1, 12));
    let chain: Vec<_> = words.split(" → ").map(|path| path.rsplit(['/', '\\']).next()).collect();
    assert_eq!(chain, ["main.toml", "a.toml", "b.toml", "a.toml"].map(Some), "{words}");
    assert!(words.starts_with("the file includes itself"), "{words}");
    let itself = Files::new("itself", &[("main.toml", "include = ['main.toml']\nplace = [1, 2]\n")]);
    assert!(one(&itself.read()).3.starts_with("the file includes itself"));
}

#[test]
fn a_file_that_cannot_be_read_is_a_mistake_where_it_is_named() {
    let files = Files::new("missing", &[("main.toml", "# parts\ninclude = ['nowhere.toml']\n"), ("sub/x.toml", "")]);
    let (file, line, column, words) = one(&files.read());
    assert_eq!((file.as_str(), line, column), ("main.toml", 2, 12));
    assert!(words.starts_with("cannot read `") && words.contains("nowhere.toml"), "{words}");
    std::fs::write(files.0.join("main.toml"), "include = ['sub']\n").unwrap_or_else(|error| panic!("{error}"));
    assert!(one(&files.read()).3.contains("is a folder"));
    std::fs::write(files.0.join("bad.toml"), b"\xff").unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(files.0.join("main.toml"), "include = ['bad.toml']\n").unwrap_or_else(|error| panic!("{error}"));
    assert!(one(&files.read()).3.contains("is not a text file"));
}

#[test]
fn eight_files_deep_are_read_and_nine_are_a_mistake() {
    let chain = |last: usize| {
        let mut files = vec![("main.toml".to_string(), format!("include = ['f1.toml']\n{PLACE}"))];
        for level in 1..last {
            files.push((format!("f{level}.toml"), format!("include = ['f{}.toml']\n", level + 1)));
        }
        files.push((format!("f{last}.toml"), "[[book]]\nname = 'last'\n".to_string()));
        let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        Files::new(&format!("depth-{last}"), &files)
    };
    assert_eq!(found(&chain(8).read()), []);
    let (file, _, _, words) = one(&chain(9).read());
    assert_eq!(file, "f8.toml");
    assert!(words.starts_with("files are included too deep") && words.matches(" → ").count() == 9, "{words}");
}

#[test]
fn thirty_two_files_are_read_and_one_more_is_a_mistake() {
    let many = |count: usize| {
        let names: Vec<String> = (0..count).map(|i| format!("f{i}.toml")).collect();
        let main = format!("include = {names:?}\n{PLACE}");
        let mut files = vec![("main.toml", main.as_str())];
        files.extend(names.iter().map(|name| (name.as_str(), "")));
        Files::new(&format!("many-{count}"), &files)
    };
    assert_eq!(found(&many(32).read()), []);
    assert!(one(&many(33).read()).3.starts_with("too many files are included"));
}

#[test]
fn settings_change_included_values_and_cannot_include() {
    let files = Files::new(
        "set",
        &[("main.toml", "include = ['a.toml']\nplace = [1, 2]\n"), ("a.toml", "[[book]]\nname = 'a'\npages = 3\n")],
    );
    let (record, mistakes) = files.read_with(&["book.a.pages=5", "cover.width=2 cm"]).records(&LIBRARY);
    assert_eq!(mistakes, Vec::<Mistake>::new());
    assert_eq!(record.records("book")[0].count("pages"), Some(5));
    let (file, _, _, words) = one(&files.read_with(&["include=['a.toml']"]));
    assert_eq!((file.as_str(), words.as_str()), ("--set", "only a file can include files"));
}

#[test]
fn a_text_without_a_file_cannot_include() {
    let document = Document::parse("text", "include = ['a.toml']\n");
    let (file, line, column, words) = one(&document);
    assert_eq!((file.as_str(), line, column, words.as_str()), ("text", 1, 1, "only a file can include files"));
    assert!(matches!(&document.root().value, Value::Table(entries) if entries.is_empty()));
}

#[test]
fn what_is_no_list_of_paths_is_a_mistake() {
    for (text, column, words) in [
        ("include = 'a.toml'\n", 11, "`include` is the text \"a.toml\""),
        ("include = [3]\n", 12, "an entry of `include` is the number 3"),
        ("include = ['']\n", 12, "an entry of `include` is the text \"\""),
    ] {
        let files = Files::new("kinds", &[("main.toml", text)]);
        let mistake = one(&files.read());
        assert_eq!((mistake.2, mistake.3.as_str()), (column, words));
    }
    let document = Document::parse("text", "place = [1, 2]\naliases = ['a', 3]\n");
    assert_eq!(one(&document).3, "`aliases` is a list with the number 3");
}

#[test]
fn a_newer_format_is_the_only_mistake_wherever_it_stands() {
    let words = "this program reads format 1: a newer Piola is needed";
    let text = Document::parse("text", "format = 2\ncolour = 'new'\nplace = 3\n");
    assert_eq!(one(&text), ("text".into(), 1, 10, words.into()));
    let files = Files::new(
        "format",
        &[("main.toml", "format = 1\ninclude = ['a.toml']\nplace = [1, 2]\n"), ("a.toml", "format = 3\nshape = 1\n")],
    );
    assert_eq!(one(&files.read()), ("a.toml".into(), 1, 10, words.into()));
    // An older one there never was, and other values are wrong as any.
    let zero = Document::parse("text", "format = 0\nplace = [1, 2]\n");
    assert_eq!(one(&zero).3, "`format` is the number 0");
    std::fs::write(files.0.join("a.toml"), "format = 'x'\n").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(one(&files.read()).3, "`format` is the text \"x\"");
    let (record, _) = Document::parse("text", PLACE).records(&LIBRARY);
    assert_eq!(record.count("format"), Some(1));
}

#[test]
fn lists_of_texts_stand_in_the_json_schema_and_in_markdown() {
    let schema = json_schema(&LIBRARY);
    assert_eq!(schema["properties"]["include"]["type"], "array");
    assert_eq!(schema["properties"]["include"]["items"]["type"], "string");
    assert!(markdown(&LIBRARY).contains("| `include` | list of texts |  | Files with parts of it. |"));
}
