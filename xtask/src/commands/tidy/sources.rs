//! Rules for single files.

use std::path::Path;

use crate::source::{code_only, without_tests};
use crate::workspace::{Workspace, read};

/// Every violation, as `file:line: what`.
pub(super) fn check(workspace: &Workspace) -> Vec<String> {
    let mut problems = Vec::new();
    for path in workspace.files() {
        let Ok(text) = read(&path) else { continue }; // not text
        let place = workspace.relative(&path).to_string();
        let found = if path.extension().is_some_and(|extension| extension == "rs") {
            let mut found = in_rust(&text, is_library_code(Path::new(&place)));
            found.extend(in_text(&text));
            found
        } else if path.extension().is_some_and(|extension| extension == "lock") {
            Vec::new()
        } else {
            in_text(&text)
        };
        problems.extend(found.into_iter().map(|(line, what)| format!("{place}:{line}: {what}")));
    }
    problems
}

/// `crates/*/src`, but not the test kit, whose purpose is to panic.
fn is_library_code(place: &Path) -> bool {
    let parts: Vec<_> = place.iter().filter_map(|part| part.to_str()).collect();
    matches!(parts[..], ["crates", folder, "src", ..] if folder != "testkit") && !place.ends_with("tests.rs")
}

type Found = Vec<(usize, String)>;

fn in_rust(text: &str, is_library: bool) -> Found {
    let mut found = Found::new();
    // Attributes of the crate may stand before.
    if !text.lines().find(|line| !line.starts_with("#![")).is_some_and(|line| line.starts_with("//!")) {
        found.push((1, "no `//!` at the top: say in one line what this file is".into()));
    }
    let code = code_only(text);
    let anywhere = [
        ("#[should_panic", "a test states the error it expects; it does not wait for a panic"),
        ("#[ignore", "a test that does not run is no test"),
        ("todo!", "left open"),
        ("unimplemented!", "left open"),
    ];
    find(&code, &anywhere, &mut found);
    if is_library {
        let in_libraries = [
            (".unwrap()", "library code returns an error"),
            (".expect(", "library code returns an error"),
            ("panic!", "library code returns an error"),
            (
                "#[inline(always)]",
                "#[cfg_attr(not(debug_assertions), inline(always))]: debug builds gain nothing by it",
            ),
        ];
        find(&without_tests(&code), &in_libraries, &mut found);
    }
    found
}

fn find(code: &str, forbidden: &[(&str, &str)], found: &mut Found) {
    for (number, line) in (1..).zip(code.lines()) {
        for (pattern, why) in forbidden {
            if line.contains(pattern) {
                found.push((number, format!("`{pattern}`: {why}")));
            }
        }
    }
}

fn in_text(text: &str) -> Found {
    let mut found = Found::new();
    let machine_paths = machine_paths();
    for (number, line) in (1..).zip(text.lines()) {
        if line.ends_with([' ', '\t']) {
            found.push((number, "white space at the end of the line".into()));
        }
        if let Some(path) = machine_paths.iter().find(|path| line.contains(path.as_str())) {
            found.push((number, format!("`{path}`: a path of one machine, which a user has none of")));
        }
    }
    found
}

/// Put together here so that this file does not contain what it forbids.
fn machine_paths() -> Vec<String> {
    let absolute = ["work", "tmp", "home", "root", "Users"].map(|folder| format!("/{folder}/"));
    absolute.into_iter().chain([["..", "shared"].join("/")]).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{in_rust, in_text, is_library_code};

    #[test]
    fn library_code_is_the_sources_of_crates_but_the_test_kit() {
        assert!(is_library_code(Path::new("crates/lagrangian/src/metric.rs")));
        assert!(!is_library_code(Path::new("crates/lagrangian/tests/it/main.rs")));
        assert!(!is_library_code(Path::new("crates/testkit/src/lib.rs")));
        assert!(!is_library_code(Path::new("xtask/src/main.rs")));
    }

    #[test]
    fn each_rule_finds_its_violation_and_no_mention_of_it() {
        let panics = "//! File.\nfn a() { b.unwrap(); c.expect(\"d\"); }\n";
        assert_eq!(in_rust(panics, true).len(), 2);
        assert_eq!(in_rust(panics, false).len(), 0);
        let open = ["//! File.\nfn a() { to", "do!() }\n#[ign", "ore]\nfn b() {}\n"].concat();
        assert_eq!(in_rust(&open, false).len(), 2);
        assert_eq!(in_rust("fn a() {}\n", false).len(), 1);
        assert_eq!(in_rust("#![forbid(unsafe_code)]\n//! Crate.\n", false).len(), 0);
        assert_eq!(in_rust("//! `x.unwrap()` in words, \"panic!\" too.\n", true).len(), 0);
        let tested = "//! File.\n#[cfg(test)]\nmod tests { fn a() { b.unwrap() } }\n";
        assert_eq!(in_rust(tested, true).len(), 0);
    }

    #[test]
    fn white_space_and_machine_paths_are_found() {
        assert_eq!(in_text("a \n").len(), 1);
        assert_eq!(in_text(&format!("see /{}/x\n", "work")).len(), 1);
        assert_eq!(in_text("network/x, tmp\n").len(), 0);
    }
}
